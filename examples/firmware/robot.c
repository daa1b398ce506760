#include "robot.h"

/* Ticks from a servo's first pulse to that of the next, so that not all start at once, and of the ramp from the start
 * pose to the first pose. */
enum { stagger_ticks = 100000 / WALKER_TICK_US, rise_ticks = 2000000 / WALKER_TICK_US, slow_us_per_s = 500 };

/* The button arms when it is let go after 0.3 to 3 s: not by a spike, nor by a wire that is pulled down for long, as by
 * the circuit that flashes an ESP32. */
enum { least_arm_ticks = 300000 / WALKER_TICK_US, most_arm_ticks = 3000000 / WALKER_TICK_US };

/* As many characters as 115200 baud bring in a tick; from one answer to the next 0.1 s. */
enum { most_characters = WALKER_TICK_US / 80, answer_ticks = 100000 / WALKER_TICK_US };

#ifdef WALKER_FRACTION_BITS
enum { bits = WALKER_FRACTION_BITS };
#else
enum { bits = 15 };
#endif

#define ANGLE(rad) ((int32_t)((rad) * (float)((int32_t)1 << bits) + ((rad) < 0 ? -0.5f : 0.5f)))
#define FIRST(joint, name, leg, least, most, first) ANGLE(first),
static const int32_t first_pose[WALKER_JOINTS] = {WALKER_EACH_JOINT(FIRST)};
#define JOINT(joint, name, leg, least, most, first) {#joint, ANGLE(least), ANGLE(most)},
static const calibrated_joint joints[WALKER_JOINTS] = {WALKER_EACH_JOINT(JOINT)};

void robot_init(robot *r) {
  int joint;
  r->mode = ROBOT_STOPPED;
  r->ramp_ticks = 0;
  for (joint = 0; joint < WALKER_JOINTS; ++joint) {
    r->servos[joint] = robot_servos[joint];
    r->pulse_us[joint] = 0;
  }
  walker_init(&r->controller);
  safety_init(&r->safety);
  r->calibration.servos = r->servos;
  r->calibration.joints = joints;
  r->calibration.count = WALKER_JOINTS;
  r->calibration.fraction_bits = bits;
  r->calibration.joint = -1;
  r->calibration.print = board_print;
  command_begin(&r->command);
  r->arm_ticks = UINT16_MAX;
  r->pulsed = 1;
  r->quiet_ticks = r->stop_letters = r->line_stops = r->line_is_long = r->line_length = 0;
}

static void say(const char *before, const char *words) {
  board_print(before);
  board_print(words);
  board_print("\n");
}

/* To somebody who may send without a pause: what does not fit in is not said. */
static void answer(robot *r, const char *before, const char *words) {
  if (r->quiet_ticks > 0) return;
  say(before, words);
  r->quiet_ticks = answer_ticks + 1;
}

static void be_limp(robot *r) {
  int joint;
  for (joint = 0; joint < WALKER_JOINTS; ++joint) r->pulse_us[joint] = 0;
}

/* The first pulse makes the servo jump to it, as it does not say where it is. */
static void go_to(robot *r, int joint, int16_t goal_us) {
  int16_t *pulse_us = &r->pulse_us[joint];
  *pulse_us = *pulse_us ? servo_towards_us(&r->servos[joint], *pulse_us, goal_us, WALKER_TICK_US) : goal_us;
}

static void ramp(robot *r) {
  const int32_t tick = r->ramp_ticks, risen = tick - WALKER_JOINTS * stagger_ticks;
  int joint;
  for (joint = 0; joint < WALKER_JOINTS; ++joint) {
    const int32_t angle = risen <= 0 ? 0 : first_pose[joint] * risen / rise_ticks;
    if (tick >= joint * stagger_ticks) go_to(r, joint, servo_goal_us(&r->servos[joint], angle, bits));
  }
  ++r->ramp_ticks;
  if (risen < rise_ticks) return;
  r->mode = ROBOT_WALKS;
  walker_init(&r->controller);
  command_begin(&r->command);
  say("walks", "");
}

/* What was told to it goes on until there is another line, or for as long as my_robot.c has it. */
static void tell(robot *r) {
#ifdef WALKER_OBEYS
  if (command_runs_out(&r->command, robot_command_ticks)) say("no line for long: ", "told to stand");
  walker_set_command(&r->controller, r->command.speed_m_s, r->command.turn_rad_s);
#else
  (void)r;
#endif
}

static void walk(robot *r) {
  walker_targets targets;
  int joint;
  tell(r);
  walker_step(&r->controller, &r->sensors, &targets);
  for (joint = 0; joint < WALKER_JOINTS; ++joint) {
#ifdef WALKER_FRACTION_BITS
    const int32_t angle = targets.angle[joint];
#else
    const int32_t angle = ANGLE(targets.angle_rad[joint]);
#endif
    go_to(r, joint, servo_goal_us(&r->servos[joint], angle, bits));
  }
}

/* Slower than walking, and beyond least and most, which are being found. */
static void calibrate(robot *r) {
  const int chosen = r->calibration.joint;
  int joint;
  for (joint = 0; joint < WALKER_JOINTS; ++joint) {
    if (joint == chosen && r->pulse_us[joint]) {
      servo slow = r->servos[joint];
      slow.slew_us_per_s = slow_us_per_s;
      r->pulse_us[joint] =
          servo_towards_us(&slow, r->pulse_us[joint], r->calibration.pulse_us, WALKER_TICK_US);
    } else {
      r->pulse_us[joint] = joint == chosen ? r->calibration.pulse_us : 0;
    }
  }
}

static void stop(robot *r, stop_reason reason) {
  board_outputs(0);
  r->mode = ROBOT_STOPPED;
  be_limp(r);
  r->safety.reason = reason;
  say("stopped: ", stop_words(reason));
}

static int may_move(robot *r, const safety_inputs *in) {
  if (!safety_arm(&r->safety, in)) {
    answer(r, "not armed: ", "the emergency stop is pressed");
    return 0;
  }
  if (board_outputs(1)) return 1;
  r->safety.reason = STOP_LOST;
  answer(r, "not armed: ", stop_words(STOP_LOST));
  return 0;
}

static void arm(robot *r, const safety_inputs *in) {
  if (r->mode != ROBOT_STOPPED || !may_move(r, in)) return;
  r->mode = ROBOT_RAMPS;
  r->ramp_ticks = 0;
  say("ramp", "");
}

static int is(const char *line, const char *word) {
  while (*word && *line == *word) ++line, ++word;
  while (*line == ' ') ++line;
  return *line == 0 && *word == 0;
}

static void go(robot *r) {
#ifdef WALKER_OBEYS
  if (r->mode != ROBOT_WALKS)
    answer(r, "not obeyed: ", "it does not walk");
  else if (!command_take(&r->command, r->line))
    answer(r, "expected go SPEED TURN, m/s and rad/s, e.g. go 0.2 -0.35, not ", r->line);
#else
  answer(r, "not obeyed: ", "this controller takes no commands");
#endif
}

static void obey(robot *r, const safety_inputs *in) {
  if (r->mode == ROBOT_CALIBRATES) {
    if (!calibrate_line(&r->calibration, r->line)) stop(r, STOP_COMMAND);
  } else if (is(r->line, "arm")) {
    arm(r, in);
  } else if (is(r->line, "calibrate") && r->mode == ROBOT_STOPPED) {
    if (!may_move(r, in)) return;
    r->mode = ROBOT_CALIBRATES;
    calibrate_begin(&r->calibration);
  } else if (command_begins(r->line)) {
    go(r);
  } else {
    answer(r, "expected arm, stop, go SPEED TURN or, while stopped, calibrate, not ", r->line);
  }
}

/* `stop` stops as soon as its letters are there, large or small, whatever is before or behind them. */
static void look_for_stop(robot *r, int character) {
  static const char letters[] = "stop";
  const int small = character >= 'A' && character <= 'Z' ? character - 'A' + 'a' : character;
  r->stop_letters = (uint8_t)(small == letters[r->stop_letters] ? r->stop_letters + 1 : small == letters[0]);
  if (letters[r->stop_letters]) return;
  r->stop_letters = 0;
  r->line_stops = 1;
  if (r->mode != ROBOT_STOPPED) stop(r, STOP_COMMAND);
}

static void end_line(robot *r, const safety_inputs *in) {
  r->line[r->line_length] = 0;
  if (r->line_is_long && !r->line_stops)
    answer(r, "too long, not obeyed: ", r->line);
  else if (r->line_length > 0 && !r->line_stops)
    obey(r, in);
  r->line_length = r->line_is_long = r->line_stops = 0;
}

/* Not for longer than a tick has, however much is sent. What changes the mode, and what calibrates, is the last line of
 * its tick, as it is answered in any case. */
static void listen(robot *r, const safety_inputs *in) {
  const robot_mode mode = r->mode;
  int left, character;
  for (left = most_characters; left > 0 && (character = board_get_character()) >= 0; --left) {
    const int ends = character == '\n' || character == '\r';
    look_for_stop(r, character);
    if (ends)
      end_line(r, in);
    else if (r->line_length + 1 < (int)sizeof r->line)
      r->line[r->line_length++] = (char)character;
    else
      r->line_is_long = 1;
    if (r->mode != mode || (ends && mode == ROBOT_CALIBRATES)) return;
  }
}

static void look_at_button(robot *r, const safety_inputs *in) {
  const uint16_t ticks = r->arm_ticks;
  const int pressed = board_arm_pressed();
  if (!pressed)
    r->arm_ticks = 0;
  else if (ticks < most_arm_ticks)
    ++r->arm_ticks;
  else
    r->arm_ticks = UINT16_MAX;
  if (!pressed && ticks >= least_arm_ticks && ticks <= most_arm_ticks) arm(r, in);
}

static void send_pulses(robot *r) {
  int joint;
  r->pulsed = 1;
  for (joint = 0; joint < WALKER_JOINTS && r->pulsed; ++joint) /* a bus that hangs is waited for once in a tick */
    r->pulsed = board_pulse(r->servos[joint].pin, r->pulse_us[joint]) != 0;
}

static safety_inputs sense(robot *r, uint32_t now_us) {
  safety_inputs in;
  int leg;
  in.now_us = now_us;
  in.answered = board_read(&r->sensors) != 0;
#if ROBOT_READS_MORE
  in.answered = robot_sense(&r->sensors) != 0 && in.answered;
#endif
  in.stop = board_stop_pressed() != 0;
  in.timed = r->mode != ROBOT_CALIBRATES; /* its tables take long to print */
  in.pulsed = r->pulsed;
  in.walks = r->mode == ROBOT_WALKS;
  in.stands = 0;
#ifdef WALKER_OBEYS
  in.stands = r->command.speed_m_s == 0.0f && r->command.turn_rad_s == 0.0f;
#endif
  in.tilted = 0;
#if WALKER_READS_ATTITUDE
  in.tilted = !(r->sensors.roll_rad < 1.0f && r->sensors.roll_rad > -1.0f && r->sensors.pitch_rad < 1.0f &&
                r->sensors.pitch_rad > -1.0f);
#endif
  in.legs = 0;
  for (leg = 0; leg < SAFETY_LEGS; ++leg) in.touch[leg] = 0;
#if WALKER_READS_TOUCH
  in.legs = WALKER_LEGS < SAFETY_LEGS ? WALKER_LEGS : SAFETY_LEGS;
  for (leg = 0; leg < in.legs; ++leg) in.touch[leg] = r->sensors.touch[leg] > 0;
#endif
  return in;
}

void robot_tick(robot *r, uint32_t now_us) {
  const safety_inputs in = sense(r, now_us);
  const stop_reason reason = safety_check(&r->safety, &robot_safety_limits, WALKER_TICK_US, &in);
  if (reason != STOP_NONE && r->mode != ROBOT_STOPPED) stop(r, reason);
  if (r->quiet_ticks > 0) --r->quiet_ticks;
  listen(r, &in);
  look_at_button(r, &in);
  if (r->mode == ROBOT_RAMPS)
    ramp(r);
  else if (r->mode == ROBOT_WALKS)
    walk(r);
  else if (r->mode == ROBOT_CALIBRATES)
    calibrate(r);
  send_pulses(r);
}
