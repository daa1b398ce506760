/* Feeds the exported controller "walker" what is on the standard input and writes what it answers, tick by
 * tick, as float32. Input: angles of all joints, touches of all legs, roll, pitch, yaw, and where they are read
 * speeds and torques of all joints, the yaw rate, loads of all legs, and speed and turn commanded. Output: targets of
 * all joints (rad), then the state: of SUPGs timers and triggers by leg, and then the neurons' values,
 * or the neurons' values alone; of oscillators the first phase, then, where they read touches, triggers by leg. Of one that
 * is steered by hand its factors as well. */
#include "walker.h"

#include <stdio.h>

#ifdef WALKER_READS_SPEEDS
enum { speeds = WALKER_JOINTS };
#else
enum { speeds = 0 };
#endif
#ifdef WALKER_READS_TORQUES
enum { torques = WALKER_JOINTS };
#else
enum { torques = 0 };
#endif
#ifdef WALKER_READS_YAW_RATE
enum { yaw_rates = 1 };
#else
enum { yaw_rates = 0 };
#endif
#ifdef WALKER_READS_LOADS
enum { loads = WALKER_LEGS };
#else
enum { loads = 0 };
#endif
#ifdef WALKER_OBEYS
enum { commands = 2 };
#else
enum { commands = 0 };
#endif
enum { usual = WALKER_JOINTS + WALKER_LEGS + 3, told = usual + speeds + torques + yaw_rates + loads, inputs = told + commands };

static void put(float value) { fwrite(&value, sizeof value, 1, stdout); }

int main(void) {
  float in[inputs];
  walker_state state;
  int i;
  walker_init(&state);
  while (fread(in, sizeof in[0], inputs, stdin) == inputs) {
    walker_sensors sensors;
    walker_targets targets;
#if WALKER_READS_ANGLES
    for (i = 0; i < WALKER_JOINTS; ++i) sensors.angle_rad[i] = in[i];
#endif
#if WALKER_READS_TOUCH
    for (i = 0; i < WALKER_LEGS; ++i) {
#ifdef WALKER_FRACTION_BITS
      sensors.touch[i] = in[WALKER_JOINTS + i] > 0.5f;
#else
      sensors.touch[i] = in[WALKER_JOINTS + i];
#endif
    }
#endif
#if WALKER_READS_ATTITUDE
    sensors.roll_rad = in[WALKER_JOINTS + WALKER_LEGS];
    sensors.pitch_rad = in[WALKER_JOINTS + WALKER_LEGS + 1];
    sensors.yaw_rad = in[WALKER_JOINTS + WALKER_LEGS + 2];
#endif
#ifdef WALKER_READS_SPEEDS
    for (i = 0; i < WALKER_JOINTS; ++i) sensors.speed_rad_s[i] = in[usual + i];
#endif
#ifdef WALKER_READS_TORQUES
    for (i = 0; i < WALKER_JOINTS; ++i) sensors.torque_nm[i] = in[usual + speeds + i];
#endif
#ifdef WALKER_READS_LOADS
    for (i = 0; i < WALKER_LEGS; ++i) sensors.load_n[i] = in[usual + speeds + torques + yaw_rates + i];
#endif
#ifdef WALKER_READS_YAW_RATE
    sensors.yaw_rate_rad_s = in[usual + speeds + torques];
#endif
#ifdef WALKER_OBEYS
    walker_set_command(&state, in[told], in[told + 1]);
#endif
    walker_step(&state, &sensors, &targets);
    for (i = 0; i < WALKER_JOINTS; ++i) {
#ifdef WALKER_FRACTION_BITS
      put((float)targets.angle[i] / (float)(1L << WALKER_FRACTION_BITS));
#else
      put(targets.angle_rad[i]);
#endif
    }
#if defined(WALKER_OSCILLATORS)
    put(state.phase[0]);
#if WALKER_READS_TOUCH
    for (i = 0; i < WALKER_LEGS; ++i) put((float)state.trigger[i]);
#endif
#elif defined(WALKER_NEURONS) && !defined(WALKER_TICK_PARTS)
    for (i = 0; i < WALKER_NEURONS; ++i) put(state.neuron[i]);
#else
#ifdef WALKER_TICK_PARTS
    for (i = 0; i < WALKER_LEGS; ++i)
      put(state.timer[i] < 0 ? -1.0f : (float)state.timer[i] * (1.0f / WALKER_TICK_PARTS));
#else
    for (i = 0; i < WALKER_LEGS; ++i) put((float)state.timer[i]);
#endif
    for (i = 0; i < WALKER_LEGS; ++i) put((float)state.trigger[i]);
#ifdef WALKER_FIRST_NEURON
    for (i = 0; i < WALKER_NEURONS; ++i) put(state.value[WALKER_FIRST_NEURON + i]);
#endif
#endif
#ifdef WALKER_IS_STEERED
    for (i = 0; i < 4; ++i) put(state.factor[i]);
#endif
  }
  return 0;
}
