/* A board of the ESP32 family under ESP-IDF: switches under the feet, hobby servos on the LED PWM controller (16
 * channels of the ESP32). Pins are examples. Without ESP-IDF (make esp32) it is only compiled, by the declarations
 * below. */
#include "board.h"

#ifdef ESP_PLATFORM
#include "driver/gpio.h"
#include "driver/ledc.h"
#include "freertos/FreeRTOS.h"
#include "freertos/task.h"
#else
typedef uint32_t TickType_t;
int gpio_get_level(int pin);
int ledc_set_duty(int speed_mode, int channel, uint32_t duty);
int ledc_update_duty(int speed_mode, int channel);
TickType_t xTaskGetTickCount(void);
int xTaskDelayUntil(TickType_t *previous, TickType_t ticks);
#define pdMS_TO_TICKS(ms) ((TickType_t)(ms) * 1000u / 1000u)
#endif

void board_configure_pins(void); /* gpio_config(), ledc_timer_config() at 50 Hz and 16 bits, ledc_channel_config() */

enum { channels = 8, pulse_middle_us = 1500, pulse_us_per_rad = 637, period_us = 20000 };

static const int foot_pin[WALKER_LEGS] = {34, 35, 36, 39};
static TickType_t last_wake;

static void set_pulse(int joint, int32_t pulse_us) {
  const uint32_t duty = (uint32_t)pulse_us * 65536u / period_us;
  ledc_set_duty(joint / channels, joint % channels, duty);
  ledc_update_duty(joint / channels, joint % channels);
}

void board_init(void) {
  int joint;
  board_configure_pins();
  for (joint = 0; joint < WALKER_JOINTS; ++joint) set_pulse(joint, pulse_middle_us);
  last_wake = xTaskGetTickCount();
}

int board_wait_for_tick(void) {
  xTaskDelayUntil(&last_wake, pdMS_TO_TICKS(WALKER_TICK_US / 1000));
  return 1;
}

void board_read(walker_sensors *sensors) {
  int leg;
  for (leg = 0; leg < WALKER_LEGS; ++leg) sensors->touch[leg] = gpio_get_level(foot_pin[leg]) == 0;
}

void board_command(const walker_targets *targets) {
  int joint;
  for (joint = 0; joint < WALKER_JOINTS; ++joint)
    set_pulse(joint, pulse_middle_us + targets->angle[joint] * pulse_us_per_rad / (1 << WALKER_FRACTION_BITS));
}

void app_main(void);
void app_main(void) { walk(); }
