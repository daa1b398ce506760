/* The self-test of the exported controller "walker" on an ATmega2560, and the cycles of a step by its timer 1.
 * For simavr, which prints what the serial port sends and ends when the processor sleeps without interrupts. */
#include <avr/interrupt.h>
#include <avr/io.h>
#include <avr/sleep.h>

#include "walker.h"

static void print(const char *text) {
  for (; *text; ++text) {
    while (!(UCSR0A & (1 << UDRE0))) {
    }
    UDR0 = (uint8_t)*text;
  }
}

static void print_number(uint16_t number) {
  char text[6];
  uint8_t at = 5;
  text[at] = 0;
  do {
    text[--at] = (char)('0' + number % 10);
    number /= 10;
  } while (number > 0);
  print(text + at);
}

static walker_state state;
static walker_sensors sensors;
static walker_targets targets;

int main(void) {
  uint16_t most = 0;
  uint8_t tick;
  UCSR0B = 1 << TXEN0;
  TCCR1B = 1 << CS10; /* the processor's clock */
  walker_init(&state);
  for (tick = 0; tick < 100; ++tick) {
    uint16_t cycles;
    uint8_t leg;
    for (leg = 0; leg < WALKER_LEGS; ++leg) sensors.touch[leg] = (tick >> (leg + 2)) & 1;
    TCNT1 = 0;
    walker_step(&state, &sensors, &targets);
    cycles = TCNT1;
    if (cycles > most) most = cycles;
  }
  print(walker_self_test() == 0.0f ? "self-test passed, cycles " : "self-test failed, cycles ");
  print_number(most);
  print("\n");
  cli();
  sleep_enable();
  sleep_cpu();
  return 0;
}
