// A walking robot on an Arduino Mega with a PCA9685. `make arduino` puts this and the other sources into a folder that
// the Arduino IDE opens, and compiles it.
#include <Wire.h>
#include <avr/sleep.h>
#include <avr/wdt.h>

#include "pca9685.h"
#include "robot.h"

enum { chip_address = 0x40, stop_pin = 2, arm_pin = 3, output_enable_pin = 4 };

typedef char a_channel_for_each_joint[WALKER_JOINTS <= PCA9685_CHANNELS ? 1 : -1];

static robot walker;
static uint32_t next_us;

static int write_chip(const uint8_t *bytes, uint8_t count) {
  Wire.beginTransmission(chip_address);
  Wire.write(bytes, count);
  return Wire.endTransmission() == 0;
}

int board_read(walker_sensors *sensors) {
#if WALKER_READS_TOUCH
  for (int leg = 0; leg < WALKER_LEGS; ++leg) sensors->touch[leg] = digitalRead(robot_switch_pins[leg]) == LOW;
#else
  (void)sensors;
#endif
  return 1;
}

int board_stop_pressed() { return digitalRead(stop_pin) == HIGH; }
int board_arm_pressed() { return digitalRead(arm_pin) == LOW; }
int board_pulse(uint8_t pin, int16_t pulse_us) { return pca9685_pulse(write_chip, pin, pulse_us); }
// The chip may have lost power, so it begins anew.
int board_outputs(int on) {
  const int ready = on && pca9685_init(write_chip);
  digitalWrite(output_enable_pin, ready ? LOW : HIGH);
  return ready || !on;
}
int board_get_character() { return Serial.read(); }
void board_print(const char *text) { Serial.print(text); }

void setup() {
  board_outputs(0);  // until the robot is armed
  pinMode(output_enable_pin, OUTPUT);
  Serial.begin(115200);
  Wire.begin();
  Wire.setClock(400000);
  Wire.setWireTimeout(10000, true);  // us; a bus that hangs is reset, and the tick is late
  pca9685_init(write_chip);
#if WALKER_READS_TOUCH
  for (int leg = 0; leg < WALKER_LEGS; ++leg) pinMode(robot_switch_pins[leg], INPUT_PULLUP);
#endif
  pinMode(stop_pin, INPUT_PULLUP);
  pinMode(arm_pin, INPUT_PULLUP);
  pinMode(LED_BUILTIN, OUTPUT);
  robot_init(&walker);
  wdt_enable(WDTO_250MS);  // a program that hangs is reset: then a resistor pulls OE up, and no servo has a pulse
  next_us = micros();
}

void loop() {
  const uint32_t now_us = micros();
  const int32_t left_us = static_cast<int32_t>(next_us - now_us);
  if (left_us > 0) {
    if (left_us > 1100) sleep_mode();  // until an interrupt: that of the clock comes after 1.024 ms
    return;
  }
  next_us = now_us - next_us < WALKER_TICK_US ? next_us + WALKER_TICK_US : now_us + WALKER_TICK_US;
  wdt_reset();
  digitalWrite(LED_BUILTIN, !digitalRead(LED_BUILTIN));  // half of the rate, for an oscilloscope
  robot_tick(&walker, now_us);
}
