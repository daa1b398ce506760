/* Pulses by the ESP32's LED PWM controller, 16 channels; a servo's pin is a GPIO. */
#include "driver/ledc.h"

#include "pulses.h"
#include "robot.h"

enum { channels = 8, period_us = 20000 };

typedef char a_channel_for_each_joint[WALKER_JOINTS <= 2 * channels ? 1 : -1];

/* Channels are in the order of the joints. */
static int joint_of(uint8_t pin) {
  int joint = 0;
  while (joint + 1 < WALKER_JOINTS && robot_servos[joint].pin != pin) ++joint;
  return joint;
}

/* Pulses come from the chip itself: without them its pins are low. */
int board_outputs(int on) {
  (void)on;
  return 1;
}

int board_pulse(uint8_t pin, int16_t pulse_us) {
  const int joint = joint_of(pin);
  const ledc_mode_t mode = joint < channels ? LEDC_HIGH_SPEED_MODE : LEDC_LOW_SPEED_MODE;
  const ledc_channel_t channel = (ledc_channel_t)(joint % channels);
  return ledc_set_duty(mode, channel, ((uint32_t)pulse_us * 65536u + period_us / 2) / period_us) == 0 &&
         ledc_update_duty(mode, channel) == 0;
}

void pulses_begin(void) {
  int mode, joint;
  for (mode = 0; mode < 2; ++mode) {
    const ledc_timer_config_t timer = {.speed_mode = mode ? LEDC_LOW_SPEED_MODE : LEDC_HIGH_SPEED_MODE,
                                       .duty_resolution = LEDC_TIMER_16_BIT,
                                       .timer_num = LEDC_TIMER_0,
                                       .freq_hz = 1000000 / period_us,
                                       .clk_cfg = LEDC_AUTO_CLK};
    ledc_timer_config(&timer);
  }
  for (joint = 0; joint < WALKER_JOINTS; ++joint) {
    const ledc_channel_config_t channel = {
        .gpio_num = robot_servos[joint].pin,
        .speed_mode = joint < channels ? LEDC_HIGH_SPEED_MODE : LEDC_LOW_SPEED_MODE,
        .channel = (ledc_channel_t)(joint % channels),
        .timer_sel = LEDC_TIMER_0};
    ledc_channel_config(&channel);
  }
}
