#include "pca9685.h"

enum { mode1 = 0x00, mode2 = 0x01, led0_on_l = 0x06, all_led_off_h = 0xfd, pre_scale = 0xfe };
enum { asleep = 0x10, auto_increment = 0x20, totem_pole = 0x04, full_off = 0x10, divider = 122, clock_mhz = 25 };

static int write_register(pca9685_write write, uint8_t where, uint8_t value) {
  uint8_t bytes[2];
  bytes[0] = where, bytes[1] = value;
  return write(bytes, 2);
}

/* The divider can be set only while the chip sleeps. */
int pca9685_init(pca9685_write write) {
  return write_register(write, all_led_off_h, full_off) && write_register(write, mode1, asleep) &&
         write_register(write, pre_scale, divider - 1) && write_register(write, mode2, totem_pole) &&
         write_register(write, mode1, auto_increment);
}

int16_t pca9685_counts(int16_t pulse_us) {
  return (int16_t)(((int32_t)pulse_us * clock_mhz + divider / 2) / divider);
}

int pca9685_pulse(pca9685_write write, uint8_t channel, int16_t pulse_us) {
  const int16_t counts = pca9685_counts(pulse_us);
  uint8_t bytes[5];
  if (channel >= PCA9685_CHANNELS) return 0;
  bytes[0] = (uint8_t)(led0_on_l + 4 * channel);
  bytes[1] = bytes[2] = 0;
  bytes[3] = (uint8_t)(counts & 0xff);
  bytes[4] = pulse_us > 0 ? (uint8_t)(counts >> 8) : (uint8_t)full_off;
  return write(bytes, 5);
}
