/* Controller exported by amble 0.1.0 (376e36476d9b): single-unit pattern generators (SUPG).
 *
 * experiment  amble demo, seed 1, generation 116, number 72
 * robot       quadruped (authors)
 * engine      batch
 * result      3.733425195643953 m in 15 s, completed
 * settings    XXH3 3f5ad92b4c2975b9
 * genome      XXH3 95196b2f7ad40dde
 *
 * Rate: 100 steps per second, one every 0.01 s. The robot starts in its start pose; its motors hold
 *   the joints where they are for one tick, then the first step.
 *
 * Sensors, read before each step:
 *   touch[leg]        not 0 while the foot is on the ground, else 0
 *
 * Joints: angle 0 is the start pose; positive angles turn the body by the right-hand rule about the
 *   axis, which is in the body's own frame.
 *   WALKER_JOINT_FL_KNEE  'FL_knee', body 'FL_lower', axis 0 1 0: targets from -0.8 to 0 rad
 *   WALKER_JOINT_FL_HIP_FB  'FL_hip_fb', body 'FL_upper', axis 0 1 0: targets from -0.8 to 0.8 rad
 *   WALKER_JOINT_FL_HIP_IO  'FL_hip_io', body 'FL_upper', axis 1 0 0: targets from 0 to 0.4 rad
 *   WALKER_JOINT_FR_KNEE  'FR_knee', body 'FR_lower', axis 0 1 0: targets from -0.8 to 0 rad
 *   WALKER_JOINT_FR_HIP_FB  'FR_hip_fb', body 'FR_upper', axis 0 1 0: targets from -0.8 to 0.8 rad
 *   WALKER_JOINT_FR_HIP_IO  'FR_hip_io', body 'FR_upper', axis -1 0 0: targets from 0 to 0.4 rad
 *   WALKER_JOINT_BL_KNEE  'BL_knee', body 'BL_lower', axis 0 1 0: targets from 0 to 0.8 rad
 *   WALKER_JOINT_BL_HIP_FB  'BL_hip_fb', body 'BL_upper', axis 0 1 0: targets from -0.8 to 0.8 rad
 *   WALKER_JOINT_BL_HIP_IO  'BL_hip_io', body 'BL_upper', axis 1 0 0: targets from 0 to 0.4 rad
 *   WALKER_JOINT_BR_KNEE  'BR_knee', body 'BR_lower', axis 0 1 0: targets from 0 to 0.8 rad
 *   WALKER_JOINT_BR_HIP_FB  'BR_hip_fb', body 'BR_upper', axis 0 1 0: targets from -0.8 to 0.8 rad
 *   WALKER_JOINT_BR_HIP_IO  'BR_hip_io', body 'BR_upper', axis -1 0 0: targets from 0 to 0.4 rad
 *
 * First step of its own trial, for a look:
 *   touch      0 0 0 0
 *   targets    -0.063373014 0.04159931 0.13596329 -0.14266756 0.07051812 0.039357174 0.4780719
 *     -0.30180365 0.037795044 0.6268537 0.47768474 0.03524394
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
  WALKER_JOINT_FL_KNEE = 0,
  WALKER_JOINT_FL_HIP_FB = 1,
  WALKER_JOINT_FL_HIP_IO = 2,
  WALKER_JOINT_FR_KNEE = 3,
  WALKER_JOINT_FR_HIP_FB = 4,
  WALKER_JOINT_FR_HIP_IO = 5,
  WALKER_JOINT_BL_KNEE = 6,
  WALKER_JOINT_BL_HIP_FB = 7,
  WALKER_JOINT_BL_HIP_IO = 8,
  WALKER_JOINT_BR_KNEE = 9,
  WALKER_JOINT_BR_HIP_FB = 10,
  WALKER_JOINT_BR_HIP_IO = 11
};

enum {
  WALKER_LEG_FL = 0,
  WALKER_LEG_FR = 1,
  WALKER_LEG_BL = 2,
  WALKER_LEG_BR = 3
};

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
