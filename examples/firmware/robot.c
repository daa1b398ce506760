/* The main loop of a walking robot: sensors, controller, servos, once per tick. */
#include "board.h"

void walk(void) {
  static walker_state state;
  walker_sensors sensors;
  walker_targets targets;
  board_init();
  walker_init(&state);
  while (board_wait_for_tick()) {
    board_read(&sensors);
    walker_step(&state, &sensors, &targets);
    board_command(&targets);
  }
}
