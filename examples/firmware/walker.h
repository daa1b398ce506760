/* Controller exported by amble 0.2.0-dev-g528ae25 (528ae25f51e5+): single-unit pattern generators (SUPG).
 *
 * experiment  servo, seed 1, generation 373, number 116
 * robot       servo
 * engine      batch
 * result      7.644926738057483 m in 15 s, completed
 * settings    XXH3 b1307ae9c1727499
 * genome      XXH3 5a055efed17c7a4e
 *
 * Rate: 100 steps per second, one every 0.01 s. The robot starts in its start pose; its motors hold
 *   the joints where they are for one tick, then the first step.
 *
 * Sensors, read before each step:
 *   touch[leg]        not 0 while the foot is on the ground, else 0
 *
 * Joints: angle 0 is the start pose; positive angles turn the body by the right-hand rule about the
 *   axis, which is in the body's own frame.
 *   WALKER_JOINT_FRONT_LEFT_KNEE  'front_left_knee', body 'front_left_shank', axis 0 1 0: targets
 *     from -0.8 to 0.7 rad
 *   WALKER_JOINT_FRONT_LEFT_HIP  'front_left_hip', body 'front_left_thigh', axis 0 1 0: targets
 *     from -0.8 to 0.8 rad
 *   WALKER_JOINT_FRONT_LEFT_ROLL  'front_left_roll', body 'front_left_shoulder', axis 1 0 0:
 *     targets from -0.4 to 0.8 rad
 *   WALKER_JOINT_FRONT_RIGHT_KNEE  'front_right_knee', body 'front_right_shank', axis 0 1 0:
 *     targets from -0.8 to 0.7 rad
 *   WALKER_JOINT_FRONT_RIGHT_HIP  'front_right_hip', body 'front_right_thigh', axis 0 1 0: targets
 *     from -0.8 to 0.8 rad
 *   WALKER_JOINT_FRONT_RIGHT_ROLL  'front_right_roll', body 'front_right_shoulder', axis -1 0 0:
 *     targets from -0.4 to 0.8 rad
 *   WALKER_JOINT_REAR_LEFT_KNEE  'rear_left_knee', body 'rear_left_shank', axis 0 1 0: targets from
 *     -0.8 to 0.7 rad
 *   WALKER_JOINT_REAR_LEFT_HIP  'rear_left_hip', body 'rear_left_thigh', axis 0 1 0: targets from
 *     -0.8 to 0.8 rad
 *   WALKER_JOINT_REAR_LEFT_ROLL  'rear_left_roll', body 'rear_left_shoulder', axis 1 0 0: targets
 *     from -0.4 to 0.8 rad
 *   WALKER_JOINT_REAR_RIGHT_KNEE  'rear_right_knee', body 'rear_right_shank', axis 0 1 0: targets
 *     from -0.8 to 0.7 rad
 *   WALKER_JOINT_REAR_RIGHT_HIP  'rear_right_hip', body 'rear_right_thigh', axis 0 1 0: targets
 *     from -0.8 to 0.8 rad
 *   WALKER_JOINT_REAR_RIGHT_ROLL  'rear_right_roll', body 'rear_right_shoulder', axis -1 0 0:
 *     targets from -0.4 to 0.8 rad
 *
 * First step of its own trial, for a look:
 *   touch      0 0 0 0
 *   targets    -0.635256 0.66691047 0.027321976 -0.63190114 0.6732296 0.03867217 -0.6291394
 *     0.6760412 0.04635472 -0.6356843 0.6744301 0.043228082
 */
#ifndef WALKER_H
#define WALKER_H

#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

#define WALKER_JOINTS 12
#define WALKER_LEGS 4
#define WALKER_TICK_US 10000 /* time from step to step, microseconds */
#define WALKER_FRACTION_BITS 15
#define WALKER_READS_TOUCH 1
#define WALKER_READS_ANGLES 0
#define WALKER_READS_ATTITUDE 0

enum {
  WALKER_JOINT_FRONT_LEFT_KNEE = 0,
  WALKER_JOINT_FRONT_LEFT_HIP = 1,
  WALKER_JOINT_FRONT_LEFT_ROLL = 2,
  WALKER_JOINT_FRONT_RIGHT_KNEE = 3,
  WALKER_JOINT_FRONT_RIGHT_HIP = 4,
  WALKER_JOINT_FRONT_RIGHT_ROLL = 5,
  WALKER_JOINT_REAR_LEFT_KNEE = 6,
  WALKER_JOINT_REAR_LEFT_HIP = 7,
  WALKER_JOINT_REAR_LEFT_ROLL = 8,
  WALKER_JOINT_REAR_RIGHT_KNEE = 9,
  WALKER_JOINT_REAR_RIGHT_HIP = 10,
  WALKER_JOINT_REAR_RIGHT_ROLL = 11
};

enum {
  WALKER_LEG_FRONT_LEFT = 0,
  WALKER_LEG_FRONT_RIGHT = 1,
  WALKER_LEG_REAR_LEFT = 2,
  WALKER_LEG_REAR_RIGHT = 3
};

/* Tables for firmware: ROW(joint, name, leg or -1, least, greatest and first target, rad), and ROW(leg,
 * name). The first target is that of the first step of the controller's own trial. */
#define WALKER_EACH_JOINT(ROW) \
  ROW(WALKER_JOINT_FRONT_LEFT_KNEE, "front_left_knee", 0, -0.8f, 0.7f, -0.635256f) \
  ROW(WALKER_JOINT_FRONT_LEFT_HIP, "front_left_hip", 0, -0.8f, 0.8f, 0.66691047f) \
  ROW(WALKER_JOINT_FRONT_LEFT_ROLL, "front_left_roll", 0, -0.4f, 0.8f, 0.027321976f) \
  ROW(WALKER_JOINT_FRONT_RIGHT_KNEE, "front_right_knee", 1, -0.8f, 0.7f, -0.63190114f) \
  ROW(WALKER_JOINT_FRONT_RIGHT_HIP, "front_right_hip", 1, -0.8f, 0.8f, 0.6732296f) \
  ROW(WALKER_JOINT_FRONT_RIGHT_ROLL, "front_right_roll", 1, -0.4f, 0.8f, 0.03867217f) \
  ROW(WALKER_JOINT_REAR_LEFT_KNEE, "rear_left_knee", 2, -0.8f, 0.7f, -0.6291394f) \
  ROW(WALKER_JOINT_REAR_LEFT_HIP, "rear_left_hip", 2, -0.8f, 0.8f, 0.6760412f) \
  ROW(WALKER_JOINT_REAR_LEFT_ROLL, "rear_left_roll", 2, -0.4f, 0.8f, 0.04635472f) \
  ROW(WALKER_JOINT_REAR_RIGHT_KNEE, "rear_right_knee", 3, -0.8f, 0.7f, -0.6356843f) \
  ROW(WALKER_JOINT_REAR_RIGHT_HIP, "rear_right_hip", 3, -0.8f, 0.8f, 0.6744301f) \
  ROW(WALKER_JOINT_REAR_RIGHT_ROLL, "rear_right_roll", 3, -0.4f, 0.8f, 0.043228082f)
#define WALKER_EACH_LEG(ROW) \
  ROW(WALKER_LEG_FRONT_LEFT, "front_left") \
  ROW(WALKER_LEG_FRONT_RIGHT, "front_right") \
  ROW(WALKER_LEG_REAR_LEFT, "rear_left") \
  ROW(WALKER_LEG_REAR_RIGHT, "rear_right")

typedef struct {
  uint8_t touch[WALKER_LEGS];
} walker_sensors;

typedef struct {
  int16_t angle[WALKER_JOINTS]; /* in 2^-WALKER_FRACTION_BITS rad */
} walker_targets;

/* All memory of a controller. Its members are for reading, in tests and telemetry. */
typedef struct {
  int16_t timer[WALKER_LEGS];    /* ticks; -1: stopped */
  int16_t airborne[WALKER_LEGS]; /* ticks off the ground, as far as they matter */
  int16_t wait[WALKER_LEGS];     /* ticks before the first start; -1 once it was */
  uint8_t trigger[WALKER_LEGS];  /* 1 in the tick of a trigger */
} walker_state;

/* The controller before its first step. */
void walker_init(walker_state *state);
/* One step: from this tick's sensors to this tick's targets. To be called once per tick. */
void walker_step(walker_state *state, const walker_sensors *sensors, walker_targets *targets);

#ifdef WALKER_SELF_TEST
/* Runs the first ticks of the champion's own trial: the largest error of a target, rad, or -1 where
 * a target left its range, also with sensors that are NaN, infinite or huge. Unless WALKER_NO_MAIN is
 * defined there is a main() that prints it. */
float walker_self_test(void);
#endif

#ifdef __cplusplus
}
#endif

#endif
