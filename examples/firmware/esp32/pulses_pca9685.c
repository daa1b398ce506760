/* Pulses by a PCA9685 on the I2C bus, as the Arduino has it; a servo's pin is a channel of the chip. */
#include "driver/gpio.h"
#include "driver/i2c_master.h"

#include "pca9685.h"
#include "pulses.h"
#include "robot.h"

enum { chip_address = 0x40, sda_pin = 21, scl_pin = 22, output_enable_pin = 4, longest_ms = 20 };

typedef char a_channel_for_each_joint[WALKER_JOINTS <= PCA9685_CHANNELS ? 1 : -1];

static i2c_master_dev_handle_t chip;

/* A bus that hangs is given up after two ticks of FreeRTOS at 100 Hz, the first of which may be over at once. */
static int write_chip(const uint8_t *bytes, uint8_t count) {
  return i2c_master_transmit(chip, bytes, count, longest_ms) == 0;
}

int board_pulse(uint8_t pin, int16_t pulse_us) { return pca9685_pulse(write_chip, pin, pulse_us); }

/* The chip may have lost power, so it begins anew. */
int board_outputs(int on) {
  const int ready = on && pca9685_init(write_chip);
  gpio_set_level((gpio_num_t)output_enable_pin, !ready);
  return ready || !on;
}

/* After a reset a resistor pulls OE up, and no servo has a pulse; nor has one until the robot is armed. */
static void configure_output_enable(void) {
  const gpio_config_t output = {.pin_bit_mask = 1ull << output_enable_pin, .mode = GPIO_MODE_OUTPUT};
  board_outputs(0);
  gpio_config(&output);
}

void pulses_begin(void) {
  i2c_master_bus_handle_t bus;
  const i2c_master_bus_config_t bus_config = {.i2c_port = I2C_NUM_0,
                                              .sda_io_num = (gpio_num_t)sda_pin,
                                              .scl_io_num = (gpio_num_t)scl_pin,
                                              .clk_source = I2C_CLK_SRC_DEFAULT,
                                              .glitch_ignore_cnt = 7};
  const i2c_device_config_t device = {
      .dev_addr_length = I2C_ADDR_BIT_LEN_7, .device_address = chip_address, .scl_speed_hz = 400000};
  configure_output_enable();
  i2c_new_master_bus(&bus_config, &bus);
  i2c_master_bus_add_device(bus, &device, &chip);
  pca9685_init(write_chip);
}
