/* What sensors beyond foot switches say in an emulated run, in place of robot_sense of my_robot.c: a trunk that sways a little
 * and turns, joints that swing, feet that bear 3 N. Each reading changes, so that one that gets lost is seen. */
#ifndef SENSE_H
#define SENSE_H

#include "robot.h"
#include "script.h"

/* From -1 to 1 and back in 1 s. */
static inline float script_sway(uint32_t tick) {
  const int32_t at = (int32_t)(tick % 100u);
  return (float)(at < 50 ? at - 25 : 75 - at) / 25.0f;
}

static inline void script_sense(walker_sensors *sensors, uint32_t tick) {
  uint32_t i;
  (void)sensors, (void)tick, (void)i;
#if WALKER_READS_ATTITUDE
  sensors->roll_rad = 0.1f * script_sway(tick);
  sensors->pitch_rad = 0.2f * script_sway(tick + 20u);
  sensors->yaw_rad = 0.3f * script_sway(tick + 40u);
#endif
#ifdef WALKER_READS_YAW_RATE
  sensors->yaw_rate_rad_s = 0.5f * script_sway(tick + 60u);
#endif
#if WALKER_READS_ANGLES
  for (i = 0; i < WALKER_JOINTS; ++i) sensors->angle_rad[i] = 0.4f * script_sway(tick + 7u * i);
#endif
#ifdef WALKER_READS_SPEEDS
  for (i = 0; i < WALKER_JOINTS; ++i) sensors->speed_rad_s[i] = script_sway(tick + 11u * i);
#endif
#ifdef WALKER_READS_TORQUES
  for (i = 0; i < WALKER_JOINTS; ++i) sensors->torque_nm[i] = 0.5f * script_sway(tick + 13u * i);
#endif
#ifdef WALKER_READS_LOADS
  for (i = 0; i < WALKER_LEGS; ++i) sensors->load_n[i] = script_touch(tick, i) ? 3.0f + script_sway(tick + 17u * i) : 0.0f;
#endif
}

#endif
