/* The least program with the controller "walker", or without it: the difference is the controller's flash. */
#include "walker.h"

#ifdef WITH_WALKER
static walker_state state;
static walker_sensors sensors;
static walker_targets targets;
#endif

int main(void) {
#ifdef WITH_WALKER
  walker_init(&state);
  for (;;) walker_step(&state, &sensors, &targets);
#endif
  return 0;
}
