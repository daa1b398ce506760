/* ESP-IDF as esp32/main.c sees it, with a clock that stands still but for waits, switches that script.h works, and
 * servos whose pulses are written down:
 *   T tick microseconds     a tick begins
 *   P pin microseconds      a pulse, 0: none
 *   C channel counts        a pulse of a PCA9685, 0: none
 *   S text                  what the robot prints
 * On a bare processor in QEMU the log goes to the host by semihosting, on the host to the standard output. With
 * -DSERIAL the standard input is the serial port, a line each second; nothing else happens, and nothing is logged but
 * lines and answers. With -DLOSES_BUS the PCA9685 does not answer for a while, and the log is of what is printed and of
 * OE alone, with times. */
#include "esp_idf.h"
#include "robot.h"
#include "script.h"
#include "sense.h"

enum { stop_pin = 32, arm_pin = 0, output_enable_pin = 4, all_channels = 16, line_ticks = 100 };
#ifdef LOSES_BUS
enum { loses_bus = 1, last_tick = bus_over };
#else
enum { loses_bus = 0, last_tick = script_ticks };
#endif

static uint32_t tick;
static int64_t now_us;
static int pin_of[all_channels];
static uint32_t duty_of[all_channels];

#ifdef __riscv
#include "semihosting.h"
static void put_now(const char *text) { semihosting_print(text); }
static void exit_good(void) { semihosting_exit(1); }
#else
#include <stdio.h>
#include <stdlib.h>
static void put_now(const char *text) { fputs(text, stdout); }
static void exit_good(void) { exit(0); }
#endif

static char waiting[1024];
static uint32_t filled;

static void flush(void) {
  waiting[filled] = 0;
  put_now(waiting);
  filled = 0;
}

static void put(const char *text) {
  for (; *text; ++text) {
    if (filled + 1 == sizeof waiting) flush();
    waiting[filled++] = *text;
  }
}

static void put_number(uint32_t number) {
  char text[11];
  int at = 10;
  text[at] = 0;
  do {
    text[--at] = (char)('0' + number % 10u);
    number /= 10u;
  } while (number > 0);
  put(text + at);
}

static void log_numbers(const char *kind, uint32_t a, uint32_t b) {
#ifndef SERIAL
  if (loses_bus) return;
  put(kind);
  put_number(a);
  put(" ");
  put_number(b);
  put("\n");
#else
  (void)kind, (void)a, (void)b, (void)put_number;
#endif
}

/* What the robot prints, and OE. */
static void begin_line(void) {
  const uint32_t hundredths = tick > 0 ? (tick - 1) * (WALKER_TICK_US / 100) / 100 : 0;
  if (!loses_bus) {
    put("S ");
    return;
  }
  put_number(hundredths / 100);
  put(hundredths % 100 < 10 ? ".0" : ".");
  put_number(hundredths % 100);
  put(" s: ");
}

/* ---- time ---- */

int64_t esp_timer_get_time(void) { return now_us; }

/* The only timer, and how often it has woken the only task. */
static esp_timer_create_args_t timer_calls;
static int64_t due_us;
static uint64_t timer_period_us;
static uint32_t notified;

TaskHandle_t xTaskGetCurrentTaskHandle(void) { return &notified; }

int xTaskNotifyGive(TaskHandle_t task) {
  ++*(uint32_t *)task;
  return 1;
}

esp_err_t esp_timer_create(const esp_timer_create_args_t *args, esp_timer_handle_t *timer) {
  timer_calls = *args;
  *timer = 0;
  return 0;
}

esp_err_t esp_timer_start_periodic(esp_timer_handle_t timer, uint64_t period_us) {
  timer_period_us = period_us;
  due_us = now_us;
  return timer != 0;
}

uint32_t ulTaskNotifyTake(int clears_count, TickType_t ticks) {
  due_us += (int64_t)timer_period_us;
  if (now_us < due_us) now_us = due_us;
#ifndef SERIAL
  if (tick == last_tick) {
    flush();
    exit_good();
  }
  if (tick == late_tick) now_us += late_by_us;
#endif
  timer_calls.callback(timer_calls.arg);
  log_numbers("T ", tick++, (uint32_t)now_us);
  if (clears_count == 0 && ticks == portMAX_DELAY) --notified;
  return notified + 1;
}

esp_err_t esp_task_wdt_add(TaskHandle_t task) { return task != 0; }
esp_err_t esp_task_wdt_reset(void) { return 0; }

/* ---- switches; `tick` is already the next one's ---- */

esp_err_t gpio_config(const gpio_config_t *config) { return config->pin_bit_mask == 0; }

/* The only output is OE of a PCA9685. */
static int outputs_are_on;
esp_err_t gpio_set_level(gpio_num_t pin, uint32_t level) {
  if (loses_bus && outputs_are_on != (level == 0)) {
    begin_line();
    put(level ? "OE cuts the servos off\n" : "OE lets pulses through\n");
  }
  outputs_are_on = level == 0;
  return pin != output_enable_pin;
}

int gpio_get_level(gpio_num_t pin) {
#ifndef SERIAL
  uint32_t leg;
  if (pin == stop_pin) return script_stops(tick - 1);
  if (pin == arm_pin) return !script_arms(tick - 1);
  for (leg = 0; leg < WALKER_LEGS; ++leg)
    if (pin == robot_switch_pins[leg]) return !script_touch(tick - 1, leg);
#endif
  return pin != stop_pin;
}

#if ROBOT_READS_MORE
int robot_sense(walker_sensors *sensors) {
  script_sense(sensors, tick - 1);
  return 1;
}
#endif

/* ---- servos ---- */

static int index_of(ledc_mode_t mode, ledc_channel_t channel) { return (mode == LEDC_LOW_SPEED_MODE ? all_channels / 2 : 0) + channel; }

esp_err_t ledc_timer_config(const ledc_timer_config_t *config) {
  return config->freq_hz != 50 || config->duty_resolution != LEDC_TIMER_16_BIT;
}

esp_err_t ledc_channel_config(const ledc_channel_config_t *config) {
  pin_of[index_of(config->speed_mode, config->channel)] = config->gpio_num;
  return 0;
}

esp_err_t ledc_set_duty(ledc_mode_t mode, ledc_channel_t channel, uint32_t duty) {
  duty_of[index_of(mode, channel)] = duty;
  return 0;
}

esp_err_t ledc_update_duty(ledc_mode_t mode, ledc_channel_t channel) {
  const int i = index_of(mode, channel);
  log_numbers("P ", (uint32_t)pin_of[i], (duty_of[i] * 20000u + 32768u) / 65536u);
  return 0;
}

/* ---- PCA9685 ---- */

enum { mode1 = 0x00, pre_scale = 0xfe, asleep = 0x10, auto_increment = 0x20, at_50_hz = 121, led0 = 0x06, off = 0x10 };
static uint8_t registers[256];

esp_err_t i2c_new_master_bus(const i2c_master_bus_config_t *config, i2c_master_bus_handle_t *bus) {
  *bus = 0;
  return config->sda_io_num == config->scl_io_num || config->flags.enable_internal_pullup != 0;
}

esp_err_t i2c_master_bus_add_device(i2c_master_bus_handle_t bus, const i2c_device_config_t *config,
                                    i2c_master_dev_handle_t *device) {
  *device = 0;
  return bus != 0 || config->device_address != 0x40 || config->scl_speed_hz > 1000000;
}

/* Where the chip would not do what it is told, the log has no pulse, and the run is judged bad. Where OE cuts a servo
 * off, it has none, whatever the chip was told. */
esp_err_t i2c_master_transmit(i2c_master_dev_handle_t device, const uint8_t *bytes, size_t count, int longest_ms) {
  const uint32_t channel = (uint32_t)(bytes[0] - led0) / 4u;
  size_t i;
  if (loses_bus && script_loses_bus(tick - 1)) return 0x107;
  if (bytes[0] == pre_scale && !(registers[mode1] & asleep)) return 1; /* the divider is taken only while it sleeps */
  for (i = 1; i < count; ++i) registers[(bytes[0] + i - 1) & 0xff] = bytes[i];
  if (count != 5 || channel >= all_channels || bytes[1] != 0 || bytes[2] != 0) return device != 0 || longest_ms < 20;
  if (registers[pre_scale] != at_50_hz || registers[mode1] != auto_increment) return 1;
  log_numbers("C ", channel, !outputs_are_on || bytes[4] & off ? 0u : bytes[3] + 256u * bytes[4]);
  return 0;
}

/* ---- serial port ---- */

esp_err_t uart_driver_install(uart_port_t port, int receives, int sends, int queue_size, void *queue, int flags) {
  return port != UART_NUM_0 || receives < 256 || sends < 256 || queue_size != 0 || queue != 0 || flags != 0;
}

int uart_read_bytes(uart_port_t port, void *to, uint32_t length, TickType_t ticks) {
#ifdef SERIAL
  static int begun = 0;
  int character;
  if (port != UART_NUM_0 || length != 1 || ticks != 0 || (!begun && tick % line_ticks != 0)) return 0;
  character = getchar();
  if (character == EOF) {
    flush();
    exit_good();
  }
  if (!begun) put("> ");
  begun = character != '\n';
  {
    const char echo[2] = {(char)character, 0};
    put(echo);
  }
  *(uint8_t *)to = (uint8_t)character;
  return 1;
#else
  static const char *line = 0;
  static uint32_t read_in = 0;
  if (port != UART_NUM_0 || length != 1 || ticks != 0) return 0;
  if (read_in != tick) line = script_line(tick - 2);
  read_in = tick;
  if (!line || !*line) return 0;
  *(uint8_t *)to = (uint8_t)*line++;
  return 1;
#endif
}

int uart_write_bytes(uart_port_t port, const void *from, size_t length) {
  const char *const text = from;
#ifndef SERIAL
  static int in_line = 0;
  size_t i;
  for (i = 0; i < length; ++i) {
    const char one[2] = {text[i], 0};
    if (!in_line) begin_line();
    put(one);
    in_line = text[i] != '\n';
  }
#else
  put(text);
#endif
  (void)port;
  return (int)length;
}

void app_main(void);
int main(void) {
  app_main();
  return 0;
}
