/* What happens in the 60 s of an emulated run, by tick of 10 ms. The emulators act it, check_run.c judges by it. */
#ifndef SCRIPT_H
#define SCRIPT_H

#include <stdint.h>

enum {
  script_ticks = 6000,
  armed_first = 100,
  told_first = 700, /* a line each half a second, then none */
  told_last = 1150,
  told_again = 1500, /* one line */
  told_in_vain = 1920, /* it does not walk */
  stop_pressed = 1800,
  armed_in_vain = 1900, /* the stop is still pressed */
  stop_released = 1950,
  armed_after_stop = 2000,
  late_tick = 3200,
  late_by_us = 70000,
  armed_after_late = 3300,
  stuck_from = 4000, /* leg 0's switch stays closed */
  stuck_to = 4600,
  armed_after_stuck = 4600,
  fallen_from = 5300, /* no foot touches */
  fallen_to = 5500,
  armed_after_fall = 5500,
  button_ticks = 10 /* as long as a button is pressed */
};

static inline int script_pressed(uint32_t tick, uint32_t from) { return tick >= from && tick < from + button_ticks; }

static inline int script_arms(uint32_t tick) {
  return script_pressed(tick, armed_first) || script_pressed(tick, armed_in_vain) ||
         script_pressed(tick, armed_after_stop) || script_pressed(tick, armed_after_late) ||
         script_pressed(tick, armed_after_stuck) || script_pressed(tick, armed_after_fall);
}

static inline int script_stops(uint32_t tick) { return tick >= stop_pressed && tick < stop_released; }

/* What somebody types while a tick goes on; the program reads it in the next one. 0: nothing. */
static inline const char *script_line(uint32_t tick) {
  if (tick >= told_first && tick <= told_last && (tick - told_first) % 50u == 0) return "go 0.2 0.3\n";
  if (tick == told_again) return "go 0.1 -0.3\n";
  return tick == told_in_vain ? "go 0.3 0\n" : 0;
}

/* Feet come down after 0.8 s and a little, each in its own time, and stay for half of it. */
static inline int script_touch(uint32_t tick, uint32_t leg) {
  if (tick >= fallen_from && tick < fallen_to) return 0;
  if (leg == 0 && tick >= stuck_from && tick < stuck_to) return 1;
  return (tick + 40u * (leg == 1u || leg == 2u)) % (80u + 3u * leg) < 42u;
}

#endif
