/* What the main loop needs of a board. */
#ifndef BOARD_H
#define BOARD_H

#include "walker.h"

/* Clocks, pins, servos; servos hold the start pose, all angles 0. */
void board_init(void);
/* Waits for the next tick, WALKER_TICK_US after the one before. 0: the end (a board that is switched off). */
int board_wait_for_tick(void);
/* The sensors of this moment. */
void board_read(walker_sensors *sensors);
/* Sends targets to the servos. */
void board_command(const walker_targets *targets);

void walk(void);

#endif
