/* What happens in the 60 s of an emulated run, by tick. The emulators act it, check_run.c judges by it. */
#ifndef SCRIPT_H
#define SCRIPT_H

#include <stdint.h>

#include "walker.h"

/* The tick at hundredths of a second. */
#define AT(hundredths) ((hundredths) * 10000 / WALKER_TICK_US)

enum {
  script_ticks = AT(6000),
  brushed = AT(50), /* the button, for too short a time */
  armed_first = AT(100),
  told_first = AT(700), /* a line each half a second, then none */
  told_last = AT(1150),
  told_again = AT(1500), /* one line */
  told_in_vain = AT(1920), /* it does not walk */
  told_before_stuck = AT(3900), /* lines again, as a robot that is told to stand may keep a foot where it is */
  told_while_stuck = AT(4450),
  stop_pressed = AT(1800),
  armed_in_vain = AT(1900), /* the stop is still pressed */
  stop_released = AT(1950),
  armed_after_stop = AT(2000),
  late_tick = AT(3200),
  late_by_us = 70000,
  armed_after_late = AT(3300),
  stuck_from = AT(4000), /* leg 0's switch stays closed */
  stuck_to = AT(4600),
  armed_after_stuck = AT(4600),
  fallen_from = AT(5300), /* no foot touches */
  fallen_to = AT(5500),
  armed_after_fall = AT(5500),
  button_ticks = AT(40), /* as long as the button is pressed; it arms when it is let go */
  brush_ticks = AT(20),
  /* In a run that loses its bus, which is shorter. */
  bus_lost = AT(1000),
  bus_back = AT(2500),
  bus_over = AT(4000)
};

static inline int script_pressed(uint32_t tick, uint32_t until) { return tick < until && tick + button_ticks >= until; }

static inline int script_arms(uint32_t tick) {
  return (tick >= brushed && tick < brushed + brush_ticks) || script_pressed(tick, armed_first) ||
         script_pressed(tick, armed_in_vain) || script_pressed(tick, armed_after_stop) ||
         script_pressed(tick, armed_after_late) || script_pressed(tick, armed_after_stuck) ||
         script_pressed(tick, armed_after_fall);
}

static inline int script_stops(uint32_t tick) { return tick >= stop_pressed && tick < stop_released; }
static inline int script_loses_bus(uint32_t tick) { return tick >= bus_lost && tick < bus_back; }

/* What somebody types while a tick goes on; the program reads it in the next one. 0: nothing. */
static inline const char *script_line(uint32_t tick) {
  if (tick >= told_first && tick <= told_last && (tick - told_first) % (uint32_t)AT(50) == 0) return "go 0.2 0.3\n";
  if (tick >= told_before_stuck && tick <= told_while_stuck && (tick - told_before_stuck) % (uint32_t)AT(50) == 0)
    return "go 0.2 0\n";
  if (tick == told_again) return "go 0.1 -0.3\n";
  return tick == told_in_vain ? "go 0.3 0\n" : 0;
}

/* Feet come down after 0.8 s and a little, each in its own time, and stay for half of it. */
static inline int script_touch(uint32_t tick, uint32_t leg) {
  if (tick >= fallen_from && tick < fallen_to) return 0;
  if (leg == 0 && tick >= stuck_from && tick < stuck_to) return 1;
  return (tick + AT(40u) * (leg == 1u || leg == 2u)) % AT(80u + 3u * leg) < (uint32_t)AT(42);
}

#endif
