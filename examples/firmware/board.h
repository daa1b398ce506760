/* What the robot needs of a board. */
#ifndef BOARD_H
#define BOARD_H

#include "walker.h"

#ifdef __cplusplus
extern "C" {
#endif

/* The foot switches of this moment. 0: they did not answer. */
int board_read(walker_sensors *sensors);
/* 1: the emergency stop is pressed, or its wire is broken (a switch that opens, from the pin to ground). */
int board_stop_pressed(void);
/* 1: the button that arms the robot is pressed. */
int board_arm_pressed(void);
/* 0: cuts all servos off from pulses at once, whatever the bus does. 1: lets pulses get to them; none does so yet.
 * Returns 0: what makes the pulses does not answer, and they are cut off. */
int board_outputs(int on);
/* Sends a pulse to the servo at a pin of the table; 0 us: none, so that the servo is limp. Returns 0: it did not get
 * there. */
int board_pulse(uint8_t pin, int16_t pulse_us);
/* The next character of the serial port; -1: there is none. */
int board_get_character(void);
void board_print(const char *text);

#ifdef __cplusplus
}
#endif

#endif
