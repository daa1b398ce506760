/* A robot that walks, in one call per tick: servos without pulses, ramp to the first pose, controller, stop. */
#ifndef ROBOT_H
#define ROBOT_H

#include "board.h"
#include "calibrate.h"
#include "commands.h"
#include "safety.h"
#include "servos.h"
#include "walker.h"

#ifdef __cplusplus
extern "C" {
#endif

/* The builder's numbers: my_robot.c. Servos by joint, GPIOs of foot switches by leg. */
extern const servo robot_servos[];
extern const uint8_t robot_switch_pins[];
extern const safety_limits robot_safety_limits;
extern const uint16_t robot_command_ticks; /* a command holds for so long without another line; 0: until the next */

/* Whether the controller reads more than foot switches. */
#if WALKER_READS_ANGLES || WALKER_READS_ATTITUDE || defined WALKER_READS_SPEEDS || defined WALKER_READS_TORQUES || \
    defined WALKER_READS_YAW_RATE || defined WALKER_READS_LOADS
#define ROBOT_READS_MORE 1
/* The builder's function, my_robot.c: what board_read does not know of. 0: a sensor did not answer. */
int robot_sense(walker_sensors *sensors);
#endif

typedef enum { ROBOT_STOPPED, ROBOT_RAMPS, ROBOT_WALKS, ROBOT_CALIBRATES } robot_mode;

typedef struct {
  robot_mode mode;
  uint16_t ramp_ticks;             /* since the ramp began */
  int16_t pulse_us[WALKER_JOINTS]; /* 0: none */
  servo servos[WALKER_JOINTS];     /* those of my_robot.c, as calibration has changed them */
  walker_state controller;
  walker_sensors sensors;
  safety safety;
  calibration calibration;
  command command;
  uint16_t arm_ticks;   /* for which the button has been pressed; UINT16_MAX: too long, or since power came */
  uint8_t pulsed;       /* 1: the last pulses got to the servos */
  uint16_t quiet_ticks; /* for so long no line is answered */
  uint8_t stop_letters; /* of `stop`, that came last */
  uint8_t line_stops;   /* `stop` is in it */
  uint8_t line_is_long; /* so that the rest of it was dropped */
  uint8_t line_length;
  char line[24];
} robot;

/* Stopped, no pulses. Once the board is ready. */
void robot_init(robot *r);
/* Once per tick, every WALKER_TICK_US. */
void robot_tick(robot *r, uint32_t now_us);

#ifdef __cplusplus
}
#endif

#endif
