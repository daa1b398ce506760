/* What robot.c promises whatever comes by its pins, its serial port and its bus, tried on a board that is made up here.
 * Prints a table of claims; exit code 1: one does not hold. A controller that cannot be told a speed, or has no foot
 * switches, has fewer of them. */
#include <stdio.h>
#include <string.h>

#include "robot.h"
#include "script.h"

enum { transmit_buffer = 64 }; /* an Arduino's; an ESP32 has more */
static const double characters_per_us = 0.01152; /* 115200 baud */

static struct {
  robot walker;
  uint32_t tick;
  double now_us, sent_at_us; /* when all that was printed is sent */
  int pressed, stops, steps, touches, bus_is_lost, outputs;
  double tick_takes_us, longest_tick_us;
  const char *flood, *typed; /* again and again, and once */
  uint32_t flood_read;
  double tick_since_us;
  int16_t pulse_us; /* of the first servo */
  char said[4096];
} board;

static int bad_claims;

/* ---- the board ---- */

int board_read(walker_sensors *sensors) {
#if WALKER_READS_TOUCH
  uint32_t leg;
  for (leg = 0; leg < WALKER_LEGS; ++leg)
    sensors->touch[leg] = (uint8_t)(board.steps ? script_touch(board.tick, leg) : board.touches);
#else
  (void)sensors;
#endif
  return 1;
}

#if ROBOT_READS_MORE
int robot_sense(walker_sensors *sensors) {
  memset(sensors, 0, sizeof *sensors);
  return board_read(sensors);
}
#endif

int board_stop_pressed(void) { return board.stops; }
int board_arm_pressed(void) { return board.pressed; }

int board_outputs(int on) {
  board.outputs = on && !board.bus_is_lost;
  return board.outputs || !on;
}

int board_pulse(uint8_t pin, int16_t pulse_us) {
  if (board.bus_is_lost) return 0;
  if (pin == robot_servos[0].pin) board.pulse_us = pulse_us;
  return 1;
}

int board_get_character(void) {
  board.now_us += 2;
  if (board.typed && *board.typed) return (unsigned char)*board.typed++;
  if (!board.flood || board.now_us > board.tick_since_us + 1e6) return -1; /* whoever reads on for 1 s is caught */
  return (unsigned char)board.flood[board.flood_read++ % strlen(board.flood)];
}

/* Waits while the buffer is full. */
void board_print(const char *text) {
  double room_us;
  if (board.sent_at_us < board.now_us) board.sent_at_us = board.now_us;
  board.sent_at_us += (double)strlen(text) / characters_per_us;
  room_us = board.sent_at_us - transmit_buffer / characters_per_us;
  if (board.now_us < room_us) board.now_us = room_us;
  if (strlen(board.said) + strlen(text) < sizeof board.said) strcat(board.said, text);
}

static void power_on(void) {
  memset(&board, 0, sizeof board);
  board.steps = 1;
  robot_init(&board.walker);
}

static void run(double seconds) {
  const double until_us = board.now_us + seconds * 1e6;
  while (board.now_us < until_us) {
    const double start_us = board.tick_since_us = board.now_us;
    robot_tick(&board.walker, (uint32_t)start_us);
    ++board.tick;
    if (board.now_us - start_us > board.longest_tick_us) board.longest_tick_us = board.now_us - start_us;
    if (board.now_us < start_us + board.tick_takes_us) board.now_us = start_us + board.tick_takes_us;
    if (board.now_us < start_us + WALKER_TICK_US) board.now_us = start_us + WALKER_TICK_US;
  }
}

static void press(double seconds) {
  board.pressed = 1;
  run(seconds);
  board.pressed = 0;
  run(0.05);
}

static void type(const char *text) {
  board.typed = text;
  run(0.2);
}

static void begin_walk(void) {
  power_on();
  run(0.1);
  press(0.4);
  run(2.5 + 0.1 * WALKER_JOINTS);
  board.said[0] = 0;
}

static int walks(void) { return board.walker.mode == ROBOT_WALKS; }

/* Cut off, and said why. */
static int stopped(const char *words) {
  return board.walker.mode == ROBOT_STOPPED && !board.outputs && strstr(board.said, words) != 0;
}

static void claim(int holds, const char *what) {
  printf("| %s | %s |\n", what, holds ? "yes" : "**no**");
  bad_claims += !holds;
}

/* ---- claims ---- */

static void check_button(void) {
  static const double too_short_s[] = {0.001, 0.05, 0.2}, too_long_s[] = {5, 60};
  unsigned i;
  int armed = 0;
  for (i = 0; i < 5; ++i) {
    power_on();
    run(0.1);
    press(i < 3 ? too_short_s[i] : too_long_s[i - 3]);
    armed += board.outputs || board.walker.mode != ROBOT_STOPPED;
  }
  power_on();
  press(1);
  armed += board.outputs || board.walker.mode != ROBOT_STOPPED;
  claim(!armed, "a spike at the button's pin, 0.2 s, 5 s, and a button held while power comes arm nothing");
  power_on();
  run(0.1);
  board.pressed = 1;
  run(0.5);
  armed = board.walker.mode != ROBOT_STOPPED;
  board.pressed = 0;
  run(0.05);
  claim(!armed && board.walker.mode == ROBOT_RAMPS && board.outputs, "pressed for 0.5 s it arms, once let go");
}

/* The stop is pressed while characters come without a pause. */
static int stops_under(const char *flood, const char *first) {
  begin_walk();
  if (first) {
    type("stop\n");
    type(first);
  }
  board.longest_tick_us = 0;
  board.flood = flood;
  run(3);
  if (!first && !strstr(flood, "arm") && !walks()) return 0;
  board.stops = 1;
  run(0.001); /* a tick, however long */
  return board.walker.mode == ROBOT_STOPPED && !board.outputs && board.longest_tick_us < (first ? 250e3 : WALKER_TICK_US);
}

static void check_floods(void) {
  static const char *const floods[] = {"x\n", "\n", "x", "\xff", "go 0.2 0.3\n", "go\n", "arm\n", "too long for a line, and then some\n"};
  unsigned i;
  int bad = 0;
  for (i = 0; i < sizeof floods / sizeof *floods; ++i) bad += !stops_under(floods[i], 0);
  claim(!bad, "characters without a pause: it walks on, no tick is longer, and the emergency stop stops in its tick");
  bad = !stops_under("stop\narm\n", 0) || !stops_under("table\n", "calibrate\n") || !stops_under("x\n", "calibrate\n") ||
        !stops_under("joint 0\n+20\n-20\n", "calibrate\n");
  claim(!bad, "so it does under lines that arm and stop, or calibrate, whose ticks are shorter than 0.25 s");
}

static void check_word(void) {
  static const char *const stops[] = {"stop\n",  "stop",   "stop \n",  " stop\n", "\tStop\r\n", "STOP\n",
                                      "sstop\n", "ststop", "stop!!\n", "\xffstop\n", "go 0.2 0.3stop\n",
                                      "a line that is too long to be obeyed at all, stop\n"};
  static const char *const others[] = {"sto p\n", "st\nop\n", "go 0.2 0\n", "halt\n", "\n"};
  unsigned i;
  int bad = 0;
  for (i = 0; i < sizeof stops / sizeof *stops; ++i) {
    begin_walk();
    type(stops[i]);
    bad += !stopped("stopped: by command") || strstr(board.said, "expected") != 0;
  }
  claim(!bad, "`stop` stops in large and small letters, with anything around it, and without an end of its line");
  for (i = 0, bad = 0; i < sizeof others / sizeof *others; ++i) {
    begin_walk();
    type(others[i]);
    bad += !walks();
  }
  claim(!bad, "other lines do not");
}

static void check_bus(void) {
  int good;
  begin_walk();
  board.bus_is_lost = 1;
  run(0.05);
  good = walks();
  board.bus_is_lost = 0;
  run(1);
  claim(good && walks(), "a bus that is lost for 0.05 s stops nothing");
  board.bus_is_lost = 1;
  run(0.15);
  claim(stopped("stopped: pulses do not get to the servos"), "lost for 0.15 s it stops, and the servos are cut off without the bus");
  press(0.5);
  good = board.walker.mode == ROBOT_STOPPED && !board.outputs && strstr(board.said, "not armed: pulses do not get") != 0;
  board.bus_is_lost = 0;
  press(0.5);
  claim(good && board.walker.mode == ROBOT_RAMPS && board.outputs, "it is not armed before the bus is back, and then it is");
  begin_walk();
  board.bus_is_lost = board.stops = 1;
  run(0.001);
  claim(stopped("emergency stop"), "the emergency stop cuts the servos off while the bus is lost");
}

static void check_time(void) {
  begin_walk();
  board.tick_takes_us = 1.05 * WALKER_TICK_US;
  run(20);
  claim(walks(), "ticks that take 1.05 times their time walk on");
  board.tick_takes_us = 1.2 * WALKER_TICK_US;
  run(2);
  claim(stopped("stopped: too slow for its ticks"), "those that take 1.2 times it stop");
  begin_walk();
  board.tick_takes_us = WALKER_TICK_US + 49000;
  run(1);
  claim(stopped("stopped: too slow for its ticks"), "so do those that are each 49 ms late");
}

#if WALKER_READS_TOUCH
static void check_feet(void) {
  int good;
  power_on();
  board.steps = 0;
  run(0.1);
  press(0.4);
  run(2.5 + 0.1 * WALKER_JOINTS + 3);
  good = walks();
  board.touches = 1;
  run(0.5);
  board.touches = 0;
  run(0.8);
  claim(good && walks(), "in the air it walks, too, and for less than 1 s after a foot has touched");
  run(0.3);
  claim(stopped("stopped: fallen"), "after 1 s it has fallen");
  begin_walk();
  board.steps = 0, board.touches = 1;
#ifdef WALKER_OBEYS
  run(30);
  claim(walks(), "told to stand it stays armed, whatever its feet do");
  for (good = 0; good < 20 && walks(); ++good) {
    type("go 0.2 0\n");
    run(0.2);
  }
  claim(stopped("stopped: a foot switch is stuck") && good > 10, "told to go it stops 5 s later, as its switches are stuck");
#else
  run(4.5);
  good = walks();
  run(1);
  claim(good && stopped("stopped: a foot switch is stuck"), "switches that are stuck stop it after 5 s");
#endif
}
#else
static void check_feet(void) {}
#endif

int main(void) {
  printf("| claim | holds |\n|---|---|\n");
  check_button();
  check_floods();
  check_word();
  check_bus();
  check_time();
  check_feet();
  return bad_claims > 0;
}
