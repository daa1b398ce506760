#include "robot.h"

/* Ticks from a servo's first pulse to that of the next, so that not all start at once, and of the ramp from the start
 * pose to the first pose. */
enum { stagger_ticks = 100000 / WALKER_TICK_US, rise_ticks = 2000000 / WALKER_TICK_US, slow_us_per_s = 500 };

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
  r->arm_was_pressed = 1; /* a button that is held while power comes arms nothing */
  r->line_length = r->line_is_long = 0;
}

static void say(const char *before, const char *words) {
  board_print(before);
  board_print(words);
  board_print("\n");
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
  r->mode = ROBOT_STOPPED;
  be_limp(r);
  say("stopped: ", stop_words(reason));
}

static void arm(robot *r, const safety_inputs *in) {
  if (r->mode != ROBOT_STOPPED) return;
  if (!safety_arm(&r->safety, in)) {
    say("not armed: ", "the emergency stop is pressed");
    return;
  }
  r->mode = ROBOT_RAMPS;
  r->ramp_ticks = 0;
  say("ramp", "");
}

static int same(const char *a, const char *b) {
  while (*a && *a == *b) ++a, ++b;
  return *a == *b;
}

static void go(robot *r) {
#ifdef WALKER_OBEYS
  if (r->mode != ROBOT_WALKS)
    say("not obeyed: ", "it does not walk");
  else if (!command_take(&r->command, r->line))
    say("expected go SPEED TURN, m/s and rad/s, e.g. go 0.2 -0.35, not ", r->line);
#else
  (void)r;
  say("not obeyed: ", "this controller takes no commands");
#endif
}

static void obey(robot *r, const safety_inputs *in) {
  if (same(r->line, "stop") ||
      (r->mode == ROBOT_CALIBRATES && !calibrate_line(&r->calibration, r->line))) {
    r->safety.reason = STOP_COMMAND;
    if (r->mode != ROBOT_STOPPED) stop(r, STOP_COMMAND);
  } else if (r->mode == ROBOT_CALIBRATES) {
    return;
  } else if (same(r->line, "arm")) {
    arm(r, in);
  } else if (same(r->line, "calibrate") && r->mode == ROBOT_STOPPED && safety_arm(&r->safety, in)) {
    r->mode = ROBOT_CALIBRATES;
    calibrate_begin(&r->calibration);
  } else if (command_begins(r->line)) {
    go(r);
  } else if (r->line[0]) {
    say("expected arm, stop, go SPEED TURN or, while stopped, calibrate, not ", r->line);
  }
}

static void listen(robot *r, const safety_inputs *in) {
  int character;
  while ((character = board_get_character()) >= 0) {
    if (character == '\n' || character == '\r') {
      r->line[r->line_length] = 0;
      r->line_length = 0;
      if (r->line_is_long)
        say("too long, not obeyed: ", r->line);
      else
        obey(r, in);
      r->line_is_long = 0;
    } else if (r->line_length + 1 < (int)sizeof r->line) {
      r->line[r->line_length++] = (char)character;
    } else {
      r->line_is_long = 1;
    }
  }
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
  in.walks = r->mode == ROBOT_WALKS;
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
  const uint8_t arm_is_pressed = board_arm_pressed() != 0;
  const stop_reason reason = safety_check(&r->safety, &robot_safety_limits, WALKER_TICK_US, &in);
  int joint;
  if (reason != STOP_NONE && r->mode != ROBOT_STOPPED) stop(r, reason);
  listen(r, &in);
  if (arm_is_pressed && !r->arm_was_pressed) arm(r, &in);
  r->arm_was_pressed = arm_is_pressed;
  if (r->mode == ROBOT_RAMPS)
    ramp(r);
  else if (r->mode == ROBOT_WALKS)
    walk(r);
  else if (r->mode == ROBOT_CALIBRATES)
    calibrate(r);
  for (joint = 0; joint < WALKER_JOINTS; ++joint) board_pulse(r->servos[joint].pin, r->pulse_us[joint]);
}
