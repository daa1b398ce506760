/* A walking robot on an ESP32 under ESP-IDF. Where the servos' pulses come from: pulses_ledc.c or pulses_pca9685.c. */
#include "driver/gpio.h"
#include "driver/uart.h"
#include "esp_task_wdt.h"
#include "esp_timer.h"
#include "freertos/FreeRTOS.h"
#include "freertos/task.h"

#include "pulses.h"
#include "robot.h"

/* The button BOOT is at GPIO 0. */
enum { stop_pin = 32, arm_pin = 0, serial_buffer = 2048 };

static robot walker;

int board_read(walker_sensors *sensors) {
#if WALKER_READS_TOUCH
  int leg;
  for (leg = 0; leg < WALKER_LEGS; ++leg)
    sensors->touch[leg] = gpio_get_level((gpio_num_t)robot_switch_pins[leg]) == 0;
#else
  (void)sensors;
#endif
  return 1;
}

int board_stop_pressed(void) { return gpio_get_level((gpio_num_t)stop_pin) == 1; }
int board_arm_pressed(void) { return gpio_get_level((gpio_num_t)arm_pin) == 0; }

int board_get_character(void) {
  uint8_t character;
  return uart_read_bytes(UART_NUM_0, &character, 1, 0) == 1 ? character : -1;
}

void board_print(const char *text) {
  size_t length = 0;
  while (text[length]) ++length;
  uart_write_bytes(UART_NUM_0, text, length);
}

/* GPIOs from 34 on have no pull-ups: there resistors do it. */
static void configure_input(int pin) {
  const gpio_config_t config = {.pin_bit_mask = 1ull << pin,
                                .mode = GPIO_MODE_INPUT,
                                .pull_up_en = pin < 34 ? GPIO_PULLUP_ENABLE : GPIO_PULLUP_DISABLE};
  gpio_config(&config);
}

static void wake(void *task) { xTaskNotifyGive((TaskHandle_t)task); }

/* By a timer of microseconds, as ticks of FreeRTOS are too coarse for some controllers. */
static void begin_ticks(void) {
  const esp_timer_create_args_t calls = {.callback = wake, .arg = xTaskGetCurrentTaskHandle(), .name = "walker"};
  esp_timer_handle_t timer;
  esp_timer_create(&calls, &timer);
  esp_timer_start_periodic(timer, WALKER_TICK_US);
}

void app_main(void);
void app_main(void) {
  int leg;
  pulses_begin();
  for (leg = 0; leg < WALKER_LEGS; ++leg) configure_input(robot_switch_pins[leg]);
  configure_input(stop_pin);
  configure_input(arm_pin);
  uart_driver_install(UART_NUM_0, serial_buffer, serial_buffer, 0, 0, 0);
  robot_init(&walker);
  esp_task_wdt_add(0); /* with CONFIG_ESP_TASK_WDT_PANIC a program that hangs is reset, which leaves pins without pulses */
  begin_ticks();
  for (;;) {
    ulTaskNotifyTake(pdFALSE, portMAX_DELAY); /* ticks that were missed are caught up */
    esp_task_wdt_reset();
    robot_tick(&walker, (uint32_t)esp_timer_get_time());
  }
}
