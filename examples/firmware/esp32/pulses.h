/* Where the servos' pulses come from: `make esp32` takes pulses_ledc.c, `make esp32-pca9685` pulses_pca9685.c. Each has
 * board_outputs and board_pulse (board.h), too. */
#ifndef PULSES_H
#define PULSES_H

/* All servos without pulses. */
void pulses_begin(void);

#endif
