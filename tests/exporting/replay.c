/* Feeds the exported controller "walker" what is on the standard input and writes what it answers, tick by
 * tick, as float32. Input: angles of all joints, touches of all legs, roll, pitch, yaw. Output: targets of
 * all joints (rad), then the state: of SUPGs timers and triggers by leg, else the neurons' values. */
#include "walker.h"

#include <stdio.h>

enum { inputs = WALKER_JOINTS + WALKER_LEGS + 3 };

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
    walker_step(&state, &sensors, &targets);
    for (i = 0; i < WALKER_JOINTS; ++i) {
#ifdef WALKER_FRACTION_BITS
      put((float)targets.angle[i] / (float)(1L << WALKER_FRACTION_BITS));
#else
      put(targets.angle_rad[i]);
#endif
    }
#ifdef WALKER_NEURONS
    for (i = 0; i < WALKER_NEURONS; ++i) put(state.neuron[i]);
#else
    for (i = 0; i < WALKER_LEGS; ++i) put((float)state.timer[i]);
    for (i = 0; i < WALKER_LEGS; ++i) put((float)state.trigger[i]);
#endif
  }
  return 0;
}
