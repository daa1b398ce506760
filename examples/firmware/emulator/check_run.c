/* Judges the log of an emulated run (esp_idf_fake.c says its lines; an Arduino's has counts of a PCA9685, lines
 * "C channel counts", instead of P) by script.h, by the numbers of my_robot.c, and by the exported controller, which
 * walks here once more. What a pulse should be is computed here anew. Prints a table; exit code 1: a row is bad. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "robot.h"
#include "script.h"
#include "sense.h"

enum { stagger = 100000 / WALKER_TICK_US, rise = 2000000 / WALKER_TICK_US, ramp_length = WALKER_JOINTS * stagger + rise + 1, most_events = 64 };

static int pulses[script_ticks][WALKER_JOINTS]; /* as the log has them */
static double times_s[script_ticks];
static int seen[script_ticks];
static struct {
  int tick;
  char text[64];
} events[most_events];
static int event_count, in_counts, bad_rows;

static int joint_of(int pin) {
  int joint;
  for (joint = 0; joint < WALKER_JOINTS; ++joint)
    if (robot_servos[joint].pin == pin) return joint;
  fprintf(stderr, "check_run: no servo is at pin %d\n", pin);
  exit(2);
}

static void read_log(void) {
  char line[128];
  int tick = -1, a, b;
  while (fgets(line, sizeof line, stdin)) {
    if (sscanf(line, "T %d %d", &a, &b) == 2 && a >= 0 && a < script_ticks) {
      tick = a;
      times_s[tick] = b / 1e6;
    } else if (tick >= 0 && (sscanf(line, "P %d %d", &a, &b) == 2 || sscanf(line, "C %d %d", &a, &b) == 2)) {
      in_counts = line[0] == 'C';
      pulses[tick][joint_of(a)] = b;
      ++seen[tick];
    } else if (tick >= 0 && line[0] == 'S' && event_count < most_events) {
      line[strcspn(line, "\n")] = 0;
      events[event_count].tick = tick;
      snprintf(events[event_count++].text, sizeof events[0].text, "%.60s", line + 2);
    }
  }
}

/* A pulse as the log counts it. */
static int logged(int us) { return in_counts ? (int)floor(us / 4.88 + 0.5) : us; }
static double in_us(int number) { return in_counts ? number * 4.88 : number; }

static void row(int good, const char *what, const char *wanted, const char *found) {
  printf("| %s | %s | %s%s |\n", what, wanted, found, good ? "" : " **(not as wanted)**");
  bad_rows += !good;
}

/* ---- what should be ---- */

static int goal_us(int joint, double angle_rad) {
  const servo *s = &robot_servos[joint];
  const double us = s->zero_us + s->sign * copysign(floor(fabs(angle_rad * s->us_per_rad) + 0.5), angle_rad);
  return (int)fmin(fmax(us, s->least_us), s->most_us);
}

static int largest_step_us(int joint) {
  return (int)floor(robot_servos[joint].slew_us_per_s * (WALKER_TICK_US / 1e6) + 1e-9);
}

static int slewed_us(int joint, int from_us, int to_us) {
  const int step_us = largest_step_us(joint);
  return to_us > from_us + step_us ? from_us + step_us : to_us < from_us - step_us ? from_us - step_us : to_us;
}

#define FIRST_RAD(joint, name, leg, least, most, first) first,
static const double first_rad[] = {WALKER_EACH_JOINT(FIRST_RAD)};

/* Angles are rounded to 2^-15 rad, a fiftieth of a microsecond, or as the controller has them. */
#ifdef WALKER_FRACTION_BITS
enum { bits = WALKER_FRACTION_BITS };
#else
enum { bits = 15 };
#endif
static double rounded_rad(double angle_rad) {
  return copysign(floor(fabs(angle_rad) * (1 << bits) + 0.5) / (1 << bits), angle_rad);
}

static double target_rad(const walker_targets *targets, int joint) {
#ifdef WALKER_FRACTION_BITS
  return targets->angle[joint] / (double)(1 << WALKER_FRACTION_BITS);
#else
  return rounded_rad((double)targets->angle_rad[joint]);
#endif
}

typedef struct {
  int armed, ends; /* ticks: the first of the ramp, and the first without pulses */
} stretch;

/* The ticks in which the robot should stand or walk, by script.h alone. */
static int stretches(stretch found[8]) {
  int change = 0, tick;
  found[0] = (stretch){armed_first, stop_pressed};
  found[1] = (stretch){armed_after_stop, late_tick};
  /* Without switches nobody notices that one sticks, or a fall. */
  found[2] = (stretch){armed_after_late, script_ticks};
  if (!WALKER_READS_TOUCH) return 3;
  for (tick = armed_after_late + ramp_length + 1; tick < stuck_from + 2; ++tick)
    if (script_touch((uint32_t)tick, 0) != script_touch((uint32_t)tick - 1, 0)) change = tick;
  found[2] = (stretch){armed_after_late, change + robot_safety_limits.stuck_ticks};
  found[3] = (stretch){armed_after_stuck, fallen_from + robot_safety_limits.airborne_ticks - 1};
  found[4] = (stretch){armed_after_fall, script_ticks};
  return 5;
}

/* The exported controller, and the servos behind it. */
typedef struct {
  walker_state state;
  int wanted_us[WALKER_JOINTS], now_us[WALKER_JOINTS];
} follower;

static void follower_begin(follower *f) {
  int joint;
  walker_init(&f->state);
  for (joint = 0; joint < WALKER_JOINTS; ++joint) f->now_us[joint] = goal_us(joint, rounded_rad(first_rad[joint]));
}

static void follower_step(follower *f, int tick) {
  walker_sensors sensors;
  walker_targets targets;
  int joint;
#if WALKER_READS_TOUCH
  int leg;
#endif
  memset(&sensors, 0, sizeof sensors);
#if WALKER_READS_TOUCH
  for (leg = 0; leg < WALKER_LEGS; ++leg) sensors.touch[leg] = (uint8_t)script_touch((uint32_t)tick, (uint32_t)leg);
#endif
  script_sense(&sensors, (uint32_t)tick);
  walker_step(&f->state, &sensors, &targets);
  for (joint = 0; joint < WALKER_JOINTS; ++joint) {
    f->wanted_us[joint] = goal_us(joint, target_rad(&targets, joint));
    f->now_us[joint] = slewed_us(joint, f->now_us[joint], f->wanted_us[joint]);
  }
}

#ifdef WALKER_OBEYS
/* Whether a command is in effect in a tick, and which: the last line that was read since it walks and is not too old. */
static int told(int tick, int walks_from, float *speed_m_s, float *turn_rad_s) {
  int read_in;
  for (read_in = tick; read_in >= walks_from; --read_in) {
    const char *line = script_line((uint32_t)read_in - 1);
    if (robot_command_ticks > 0 && tick - read_in >= robot_command_ticks) break;
    if (line) return sscanf(line, "go %f %f", speed_m_s, turn_rad_s) == 2;
  }
  *speed_m_s = *turn_rad_s = 0.0f;
  return 0;
}

static void tell(follower *f, int tick, int walks_from) {
  float speed_m_s, turn_rad_s;
  told(tick, walks_from, &speed_m_s, &turn_rad_s);
  walker_set_command(&f->state, speed_m_s, turn_rad_s);
}
#else
static void tell(follower *f, int tick, int walks_from) { (void)f, (void)tick, (void)walks_from; }
#endif

/* ---- rows ---- */

/* The number of pulses that commands changed. */
static long check_targets(const stretch *found, int count) {
  long same = 0, all = 0, limited = 0, changed = 0;
  int i, joint, tick;
  char text[128], wanted[64];
  for (i = 0; i < count; ++i) {
    const int walks_from = found[i].armed + ramp_length;
    follower obeys, deaf;
    follower_begin(&obeys);
    follower_begin(&deaf);
    for (tick = walks_from; tick < found[i].ends; ++tick) {
      tell(&obeys, tick, walks_from);
      follower_step(&obeys, tick);
      follower_step(&deaf, tick);
      for (joint = 0; joint < WALKER_JOINTS; ++joint, ++all) {
        limited += obeys.now_us[joint] != obeys.wanted_us[joint];
        changed += obeys.now_us[joint] != deaf.now_us[joint];
        same += pulses[tick][joint] == logged(obeys.now_us[joint]);
      }
    }
  }
  snprintf(wanted, sizeof wanted, "%ld", all);
  snprintf(text, sizeof text, "%ld", same);
  row(same == all && all > 0, "pulses of walking that are those of the exported controller", wanted, text);
  snprintf(text, sizeof text, "%.1f %%", 100.0 * (double)limited / (double)all);
  row(1, "of them held back by the slew", "–", text);
  return changed;
}

static void check_limits(void) {
  long outside = 0, sent = 0;
  int least = 1 << 20, most = 0, tick, joint;
  char text[128];
  for (tick = 0; tick < script_ticks; ++tick)
    for (joint = 0; joint < WALKER_JOINTS; ++joint) {
      const int pulse = pulses[tick][joint];
      if (pulse == 0) continue;
      ++sent;
      outside += pulse < logged(robot_servos[joint].least_us) || pulse > logged(robot_servos[joint].most_us);
      least = pulse < least ? pulse : least;
      most = pulse > most ? pulse : most;
    }
  snprintf(text, sizeof text, "%ld of %ld, all from %.0f to %.0f µs", outside, sent, in_us(least), in_us(most));
  row(outside == 0 && sent > 0, "pulses beyond `least_us` and `most_us`", "0", text);
}

static void check_slew(void) {
  long faster = 0;
  int most = 0, tick, joint;
  char text[128], wanted[64];
  for (tick = 1; tick < script_ticks; ++tick)
    for (joint = 0; joint < WALKER_JOINTS; ++joint) {
      const int before = pulses[tick - 1][joint], now = pulses[tick][joint], change = abs(now - before);
      if (before == 0 || now == 0) continue;
      /* Two rounded numbers of counts differ by one more at most. */
      faster += in_counts ? change > (int)ceil(largest_step_us(joint) / 4.88) : change > largest_step_us(joint);
      most = change > most ? change : most;
    }
  snprintf(wanted, sizeof wanted, in_counts ? "%d µs, rounded to counts of 4.88 µs" : "%d µs", largest_step_us(0));
  snprintf(text, sizeof text, "%.0f µs; faster %ld", in_us(most), faster);
  row(faster == 0 && most > 0, "largest change from tick to tick", wanted, text);
}

/* Servos go on one after another at zero, then each goes one way, to its first target. */
static int good_ramp(int armed) {
  int joint, i;
  for (joint = 0; joint < WALKER_JOINTS; ++joint) {
    const int zero = logged(goal_us(joint, 0.0)), first = logged(goal_us(joint, rounded_rad(first_rad[joint])));
    const int way = first > zero ? 1 : -1;
    for (i = 0; i < ramp_length; ++i) {
      const int now = pulses[armed + i][joint], before = i > 0 ? pulses[armed + i - 1][joint] : 0;
      if (i < joint * stagger ? now != 0 : i < WALKER_JOINTS * stagger ? now != zero : way * (now - before) < 0) return 0;
    }
    if (pulses[armed + ramp_length - 1][joint] != first) return 0;
  }
  return 1;
}

static void check_ramps(const stretch *found, int count) {
  int good = 0, i;
  char text[128];
  for (i = 0; i < count; ++i) good += good_ramp(found[i].armed);
  snprintf(text, sizeof text, "%d of %d, %.1f s each", good, count, ramp_length * (WALKER_TICK_US / 1e6));
  row(good == count, "ramps: servos on one by one at zero, then each one way to its first target", "all", text);
}

static int any_pulse(int tick) {
  int joint;
  for (joint = 0; joint < WALKER_JOINTS; ++joint)
    if (pulses[tick][joint]) return 1;
  return 0;
}

static void check_stop(const char *what, const char *words, int from, int until) {
  int tick, with = 0, i, event = -1;
  char text[128], wanted[64];
  for (tick = from; tick < until; ++tick) with += any_pulse(tick);
  for (i = 0; i < event_count; ++i)
    if (strcmp(events[i].text, words) == 0) event = events[i].tick;
  snprintf(wanted, sizeof wanted, "%.2f s", from * (WALKER_TICK_US / 1e6));
  snprintf(text, sizeof text, "%.2f s; until %.2f s ticks with a pulse: %d", event * (WALKER_TICK_US / 1e6),
           until * (WALKER_TICK_US / 1e6), with);
  row(event == from && with == 0 && any_pulse(from - 1) && (until == script_ticks || any_pulse(until)), what, wanted, text);
}

/* How often the robot said something, and the tick in which it did so first; -1: never. */
static int said(const char *words, int *first) {
  int i, times = 0;
  *first = -1;
  for (i = 0; i < event_count; ++i)
    if (strcmp(events[i].text, words) == 0 && times++ == 0) *first = events[i].tick;
  return times;
}

static void check_said(const char *what, const char *words, int times, int from) {
  char text[128], wanted[64];
  int first;
  const int found = said(words, &first);
  snprintf(wanted, sizeof wanted, "%d from %.2f s on", times, from * (WALKER_TICK_US / 1e6));
  snprintf(text, sizeof text, "%d from %.2f s on", found, first * (WALKER_TICK_US / 1e6));
  row(found == times && first == from, what, wanted, text);
}

#ifdef WALKER_OBEYS
static void check_commands(const stretch *found, int count, long changed) {
  int i, tick, times = 0, from = -1;
  float speed_m_s, turn_rad_s;
  char text[128];
  snprintf(text, sizeof text, "%ld", changed);
  row(changed > 0, "of them changed by commands, `go 0.2 0.3` at 7.00 s and others", "some", text);
  for (i = 0; i < count; ++i) {
    const int walks_from = found[i].armed + ramp_length;
    for (tick = walks_from + 1; tick < found[i].ends; ++tick)
      if (told(tick - 1, walks_from, &speed_m_s, &turn_rad_s) && !told(tick, walks_from, &speed_m_s, &turn_rad_s) && times++ == 0)
        from = tick;
  }
  check_said("told to stand, as no line came for long", "no line for long: told to stand", times, from);
  check_said("refused: a command at 19.20 s, while it does not walk", "not obeyed: it does not walk", 1, told_in_vain + 1);
}
#else
static void check_commands(const stretch *found, int count, long changed) {
  int tick, lines = 0;
  (void)found, (void)count, (void)changed;
  for (tick = 0; tick < script_ticks; ++tick) lines += script_line((uint32_t)tick) != 0;
  check_said("refused: commands, from 7.00 s on, as this controller takes none", "not obeyed: this controller takes no commands",
             lines, told_first + 1);
}
#endif

static void check_before(void) {
  int tick, with = 0;
  char text[128];
  for (tick = 0; tick < armed_first; ++tick) with += any_pulse(tick);
  snprintf(text, sizeof text, "%d", with);
  row(with == 0 && any_pulse(armed_first), "ticks with a pulse before it is armed at 1.00 s", "0", text);
}

static void check_ticks(void) {
  int tick, whole = 0;
  char text[128], wanted[64];
  const double took_s = times_s[script_ticks - 1] - times_s[0], due_s = (script_ticks - 1) * (WALKER_TICK_US / 1e6);
  for (tick = 0; tick < script_ticks; ++tick) whole += seen[tick] == WALKER_JOINTS;
  snprintf(wanted, sizeof wanted, "%d", script_ticks);
  snprintf(text, sizeof text, "%d; the last at %.2f s", whole, took_s);
  /* Ticks begin anew after the late one, or are caught up. */
  row(whole == script_ticks && fabs(took_s - due_s) < 0.1, "ticks in which every servo got its pulse", wanted, text);
}

int main(void) {
  stretch found[8];
  const int count = stretches(found);
  read_log();
  printf("| what | wanted | found |\n|---|---|---|\n");
  check_ticks();
  check_before();
  check_ramps(found, count);
  check_commands(found, count, check_targets(found, count));
  check_limits();
  check_slew();
  check_stop("stop by the switch, pressed at 18.00 s; armed in vain at 19.00 s", "stopped: emergency stop", stop_pressed,
             armed_after_stop);
  check_stop("stop by the watchdog, a tick 70 ms late", "stopped: a tick was late", late_tick, armed_after_late);
  if (!WALKER_READS_TOUCH) return bad_rows > 0;
  check_stop("stop by a foot switch that sticks from 40.00 s on, after 5 s", "stopped: a foot switch is stuck",
             found[2].ends, armed_after_stuck);
  check_stop("stop by a fall, no foot on the ground from 53.00 s on, after 1 s", "stopped: fallen", found[3].ends,
             armed_after_fall);
  return bad_rows > 0;
}
