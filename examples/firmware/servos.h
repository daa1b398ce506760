/* Hobby servos: from a joint's angle to a pulse. */
#ifndef SERVOS_H
#define SERVOS_H

#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

/* One joint's servo. `joint N`, `zero`, `at`, `least`, `most` of the calibration find the numbers. */
typedef struct {
  uint8_t pin;                /* GPIO, or channel of a PCA9685 */
  int8_t sign;                /* 1; -1 if pulses get shorter as the angle grows */
  int16_t zero_us;            /* pulse at angle 0, the start pose */
  int16_t least_us, most_us;  /* the joint goes no further than these */
  int16_t slew_us_per_s;      /* pulses change no faster: about what the servo can do */
  int16_t us_per_rad;         /* pulse per angle, about 637: 1000 us for 90 degrees */
} servo;

/* The nearest pulse within the servo's limits. */
int16_t servo_limited_us(const servo *s, int32_t pulse_us);
/* Pulse of an angle in 2^-fraction_bits rad, rounded to the nearest, within the limits. */
int16_t servo_goal_us(const servo *s, int32_t angle, int fraction_bits);
/* One tick on the way from a pulse to another, no faster than the slew. */
int16_t servo_towards_us(const servo *s, int16_t from_us, int16_t goal_us, int32_t tick_us);

#ifdef __cplusplus
}
#endif

#endif
