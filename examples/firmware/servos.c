#include "servos.h"

int16_t servo_limited_us(const servo *s, int32_t pulse_us) {
  if (pulse_us < s->least_us) return s->least_us;
  if (pulse_us > s->most_us) return s->most_us;
  return (int16_t)pulse_us;
}

int16_t servo_goal_us(const servo *s, int32_t angle, int fraction_bits) {
  const int32_t one = (int32_t)1 << fraction_bits, scaled = angle * s->us_per_rad;
  const int32_t from_zero_us = (scaled >= 0 ? scaled + one / 2 : scaled - one / 2) / one;
  return servo_limited_us(s, s->zero_us + s->sign * from_zero_us);
}

int16_t servo_towards_us(const servo *s, int16_t from_us, int16_t goal_us, int32_t tick_us) {
  int32_t step_us = (int32_t)((int64_t)s->slew_us_per_s * tick_us / 1000000);
  if (step_us < 1) step_us = 1;
  if (goal_us > from_us + step_us) return (int16_t)(from_us + step_us);
  if (goal_us < from_us - step_us) return (int16_t)(from_us - step_us);
  return goal_us;
}
