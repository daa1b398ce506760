/* The builder's numbers: wiring, servos as calibration has found them, and sensors beyond foot switches. The only file to
 * edit. Joints and legs are in the order of walker.h. */
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

/* A tick 50 ms late, or ticks of a second 100 ms late in all; 0.1 s without an answer of sensors, or of what makes the
 * pulses; a switch that has not changed for 5 s; 1 s off the ground. */
const safety_limits robot_safety_limits = {.late_us = 50000,
                                           .slow_us = 100000,
                                           .silent_ticks = 100000 / WALKER_TICK_US,
                                           .lost_ticks = 100000 / WALKER_TICK_US,
                                           .stuck_ticks = 5000000 / WALKER_TICK_US,
                                           .airborne_ticks = 1000000 / WALKER_TICK_US};

/* A command, `go SPEED TURN`, holds for 1 s: whoever steers sends a line more often. 0: it holds until the next. */
const uint16_t robot_command_ticks = 1000000 / WALKER_TICK_US;

/* Errors here: walker.h has another number of joints or legs than the tables above. */
typedef char a_servo_for_each_joint[sizeof robot_servos == WALKER_JOINTS * sizeof(servo) ? 1 : -1];
typedef char a_switch_for_each_leg[sizeof robot_switch_pins == WALKER_LEGS ? 1 : -1];

#if ROBOT_READS_MORE && !defined ROBOT_EMULATED
/* Errors here: the controller reads more than foot switches. Put in place of each #error line what reads that sensor, as the
 * comment of walker.h has units and signs, e.g. from an IMU; and return 0 where it does not answer. Called once per tick. Or
 * evolve a controller that does without: docs/BUILDING.md, "Steering on the table". */
int robot_sense(walker_sensors *sensors) {
  (void)sensors;
#if WALKER_READS_ATTITUDE
#error "This controller reads ATTITUDE: set sensors->roll_rad, pitch_rad and yaw_rad here"
#endif
#ifdef WALKER_READS_YAW_RATE
#error "This controller reads YAW_RATE: set sensors->yaw_rate_rad_s here"
#endif
#if WALKER_READS_ANGLES
#error "This controller reads ANGLES: set sensors->angle_rad[joint] of all joints here"
#endif
#ifdef WALKER_READS_SPEEDS
#error "This controller reads SPEEDS: set sensors->speed_rad_s[joint] of all joints here"
#endif
#ifdef WALKER_READS_TORQUES
#error "This controller reads TORQUES: set sensors->torque_nm[joint] of all joints here"
#endif
#ifdef WALKER_READS_LOADS
#error "This controller reads LOADS: set sensors->load_n[leg] of all legs here"
#endif
  return 1;
}
#endif
