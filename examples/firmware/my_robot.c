/* The builder's numbers: wiring, and servos as calibration has found them. The only file to edit. Joints and legs are in
 * the order of walker.h. */
#include "robot.h"

/* pin, sign, zero_us, least_us, most_us, slew_us_per_s (6.5 rad/s), us_per_rad of a servo that nobody has calibrated.
 * Paste what `table` prints in place of the rows below. */
#define UNTRIED(pin) {pin, 1, 1500, 700, 2300, 4100, 637}

#if defined(__AVR__) || defined(ROBOT_PCA9685)
/* Channels of a PCA9685. */
const servo robot_servos[] = {UNTRIED(0), UNTRIED(1), UNTRIED(2), UNTRIED(3), UNTRIED(4),  UNTRIED(5),
                              UNTRIED(6), UNTRIED(7), UNTRIED(8), UNTRIED(9), UNTRIED(10), UNTRIED(11)};
#else
/* GPIOs of an ESP32. */
const servo robot_servos[] = {UNTRIED(13), UNTRIED(14), UNTRIED(16), UNTRIED(17), UNTRIED(18), UNTRIED(19),
                              UNTRIED(21), UNTRIED(22), UNTRIED(23), UNTRIED(25), UNTRIED(26), UNTRIED(27)};
#endif
#ifdef __AVR__
/* Pins of an Arduino Mega. */
const uint8_t robot_switch_pins[] = {22, 23, 24, 25};
#else
/* GPIOs of an ESP32. Those from 34 to 39 are inputs without pull-ups. */
const uint8_t robot_switch_pins[] = {34, 35, 36, 39};
#endif

/* A tick 50 ms late; 0.1 s without an answer of sensors; a switch that has not changed for 5 s; 1 s off the ground. */
const safety_limits robot_safety_limits = {50000, 100000 / WALKER_TICK_US, 5000000 / WALKER_TICK_US,
                                           1000000 / WALKER_TICK_US};

/* Errors here: walker.h has another number of joints or legs than the tables above. */
typedef char a_servo_for_each_joint[sizeof robot_servos == WALKER_JOINTS * sizeof(servo) ? 1 : -1];
typedef char a_switch_for_each_leg[sizeof robot_switch_pins == WALKER_LEGS ? 1 : -1];
