#include "calibrate.h"

/* Hobby servos bear pulses from 500 to 2500 us; a step is small, so that a wrong one breaks nothing. */
enum { shortest_us = 500, longest_us = 2500, largest_step_us = 100 };

static void print_number(const calibration *c, int32_t number) {
  char text[12];
  int at = 11;
  uint32_t left = number < 0 ? 0u - (uint32_t)number : (uint32_t)number;
  text[at] = 0;
  do {
    text[--at] = (char)('0' + left % 10u);
    left /= 10u;
  } while (left > 0);
  if (number < 0) text[--at] = '-';
  c->print(text + at);
}

static void print_with(const calibration *c, const char *before, int32_t number) {
  c->print(before);
  print_number(c, number);
}

/* What is behind a word at the beginning of a line, without spaces; 0: the line begins otherwise. */
static const char *after(const char *line, const char *word) {
  while (*word)
    if (*line++ != *word++) return 0;
  if (*line != 0 && *line != ' ') return 0;
  while (*line == ' ') ++line;
  return line;
}

/* A number with or without a sign, at most four digits. 0: it is none. */
static int read_number(const char *text, int16_t *number) {
  const int negative = *text == '-';
  int digits = 0;
  int16_t value = 0;
  if (*text == '-' || *text == '+') ++text;
  for (; *text >= '0' && *text <= '9' && digits < 4; ++text, ++digits) value = (int16_t)(value * 10 + *text - '0');
  *number = (int16_t)(negative ? -value : value);
  return digits > 0 && *text == 0;
}

static void say_where(const calibration *c) {
  print_number(c, c->joint);
  c->print(" ");
  c->print(c->joints[c->joint].enumerator);
  print_with(c, ": ", c->pulse_us);
  c->print(" us\n");
}

static void choose(calibration *c, const char *text) {
  int16_t joint;
  if (!read_number(text, &joint) || joint < 0 || joint >= c->count) {
    print_with(c, "expected a joint from 0 to ", c->count - 1);
    c->print("\n");
    return;
  }
  c->joint = joint;
  c->pulse_us = c->servos[joint].zero_us;
  say_where(c);
}

static void move(calibration *c, const char *text) {
  int16_t step_us;
  if (!read_number(text, &step_us) || step_us > largest_step_us || step_us < -largest_step_us) {
    c->print("expected a step of at most 100 us, e.g. +20\n");
    return;
  }
  c->pulse_us = (int16_t)(c->pulse_us + step_us);
  if (c->pulse_us < shortest_us) c->pulse_us = shortest_us;
  if (c->pulse_us > longest_us) c->pulse_us = longest_us;
  say_where(c);
}

/* 1 degree is pi / 180 = 0.0174533 rad. */
static void measure(calibration *c, servo *s, const char *text) {
  int16_t degrees;
  const int32_t from_zero_us = c->pulse_us - s->zero_us;
  int32_t us_per_rad;
  if (!read_number(text, &degrees) || degrees == 0) {
    c->print("expected degrees from the start pose, not 0, e.g. at 45\n");
    return;
  }
  us_per_rad = (from_zero_us * 572958 / degrees + (from_zero_us * degrees >= 0 ? 5000 : -5000)) / 10000;
  if (us_per_rad < 0) us_per_rad = -us_per_rad;
  if (us_per_rad < 200 || us_per_rad > 2000) {
    print_with(c, "expected 200 to 2000 us per rad, not ", us_per_rad);
    c->print(": move away from zero first\n");
    return;
  }
  s->sign = (from_zero_us >= 0) == (degrees >= 0) ? 1 : -1;
  s->us_per_rad = (int16_t)us_per_rad;
  print_with(c, "sign ", s->sign);
  print_with(c, ", us_per_rad ", s->us_per_rad);
  c->print("\n");
}

/* Whether the controller's targets are within what the joint can do. */
static void print_targets(const calibration *c, int joint) {
  servo free = c->servos[joint];
  int16_t least_us, most_us;
  free.least_us = 0, free.most_us = INT16_MAX;
  least_us = servo_goal_us(&free, c->joints[joint].least, c->fraction_bits);
  most_us = servo_goal_us(&free, c->joints[joint].most, c->fraction_bits);
  if (least_us > most_us) {
    const int16_t other = least_us;
    least_us = most_us;
    most_us = other;
  }
  print_with(c, " /* targets ", least_us);
  print_with(c, " to ", most_us);
  c->print(least_us < c->servos[joint].least_us || most_us > c->servos[joint].most_us ? " us: BEYOND THE LIMITS */\n"
                                                                                      : " us */\n");
}

static void print_table(const calibration *c) {
  int joint;
  c->print("/* pin, sign, zero_us, least_us, most_us, slew_us_per_s, us_per_rad */\n");
  for (joint = 0; joint < c->count; ++joint) {
    const servo *s = &c->servos[joint];
    c->print("[");
    c->print(c->joints[joint].enumerator);
    print_with(c, "] = {", s->pin);
    print_with(c, ", ", s->sign);
    print_with(c, ", ", s->zero_us);
    print_with(c, ", ", s->least_us);
    print_with(c, ", ", s->most_us);
    print_with(c, ", ", s->slew_us_per_s);
    print_with(c, ", ", s->us_per_rad);
    c->print("},");
    print_targets(c, joint);
  }
}

static void mark(calibration *c, const char *name, int16_t *number) {
  *number = c->pulse_us;
  c->print(name);
  print_with(c, " ", c->pulse_us);
  c->print(" us\n");
}

void calibrate_begin(calibration *c) {
  c->joint = -1;
  c->pulse_us = 0;
  c->print("calibration: joint N, +N, -N, zero, at DEGREES, least, most, table, quit\n");
}

int calibrate_line(calibration *c, const char *line) {
  const char *rest;
  servo *s = c->joint < 0 ? 0 : &c->servos[c->joint];
  if (after(line, "quit")) return 0;
  if ((rest = after(line, "joint")) != 0)
    choose(c, rest);
  else if (after(line, "table"))
    print_table(c);
  else if (!s)
    c->print("first choose a joint, e.g. joint 0\n");
  else if (*line == '+' || *line == '-')
    move(c, line);
  else if (after(line, "zero"))
    mark(c, "zero", &s->zero_us);
  else if ((rest = after(line, "at")) != 0)
    measure(c, s, rest);
  else if (after(line, "least"))
    mark(c, "least", &s->least_us);
  else if (after(line, "most"))
    mark(c, "most", &s->most_us);
  else
    c->print("expected joint N, +N, -N, zero, at DEGREES, least, most, table or quit\n");
  return 1;
}
