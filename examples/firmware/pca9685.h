/* The PCA9685: 16 channels of pulses at 50 Hz over I2C. NXP's data sheet, revision 4, section 7.3. */
#ifndef PCA9685_H
#define PCA9685_H

#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

enum { PCA9685_CHANNELS = 16 };

/* Sends bytes to the chip in one transfer; the first is the register. 0: the chip did not take them. */
typedef int (*pca9685_write)(const uint8_t *bytes, uint8_t count);

/* All channels off, 50 Hz. 0: the chip did not take it. */
int pca9685_init(pca9685_write write);
/* 0 us: no pulse. Returns 0: the chip did not take it, or has no such channel. */
int pca9685_pulse(pca9685_write write, uint8_t channel, int16_t pulse_us);
/* A pulse as the chip counts: 122 periods of its 25 MHz clock, 4.88 us. Clocks are some percent off from chip to chip,
 * which calibration takes with it. */
int16_t pca9685_counts(int16_t pulse_us);

#ifdef __cplusplus
}
#endif

#endif
