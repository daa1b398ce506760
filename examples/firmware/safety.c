#include "safety.h"

void safety_init(safety *s) {
  int leg;
  s->reason = STOP_POWER_ON;
  s->last_us = s->second_us = 0;
  s->second_ticks = s->silent = s->lost = s->airborne = 0;
  s->landed = 0;
  for (leg = 0; leg < SAFETY_LEGS; ++leg) s->same[leg] = 0, s->touch[leg] = 0;
}

int safety_arm(safety *s, const safety_inputs *in) {
  if (in->stop) return 0;
  safety_init(s);
  s->reason = STOP_NONE;
  s->last_us = s->second_us = in->now_us;
  return 1;
}

/* Ticks in a row in which something held; counts no further than it can. */
static void count(uint16_t *ticks, int holds) {
  if (!holds)
    *ticks = 0;
  else if (*ticks < UINT16_MAX)
    ++*ticks;
}

static int reached(uint16_t ticks, uint16_t limit) { return limit > 0 && ticks >= limit; }

static int any_stuck(safety *s, const safety_limits *limits, const safety_inputs *in) {
  int leg, stuck = 0;
  for (leg = 0; leg < in->legs; ++leg) {
    count(&s->same[leg], in->walks && !in->stands && in->touch[leg] == s->touch[leg]);
    s->touch[leg] = in->touch[leg];
    stuck = stuck || reached(s->same[leg], limits->stuck_ticks);
  }
  return stuck;
}

/* A robot that walks in a hand, or on a box, has not landed yet. */
static int all_airborne(safety *s, const safety_inputs *in) {
  int leg, touches = 0;
  for (leg = 0; leg < in->legs; ++leg) touches = touches || in->touch[leg];
  s->landed = in->walks && (s->landed || touches);
  return s->landed && !touches;
}

/* Ticks none of which is late enough for a stop may be so all together. */
static int too_slow(safety *s, const safety_limits *limits, int32_t tick_us, const safety_inputs *in) {
  const int32_t ticks_us = ++s->second_ticks * tick_us;
  const int32_t late_us = (int32_t)(in->now_us - s->second_us) - ticks_us;
  if (!in->timed || ticks_us >= 1000000) s->second_us = in->now_us, s->second_ticks = 0;
  return in->timed && limits->slow_us > 0 && late_us > (int32_t)limits->slow_us;
}

stop_reason safety_check(safety *s, const safety_limits *limits, int32_t tick_us, const safety_inputs *in) {
  const uint32_t since_us = in->now_us - s->last_us;
  const int stuck = any_stuck(s, limits, in), slow = too_slow(s, limits, tick_us, in);
  s->last_us = in->now_us;
  count(&s->silent, !in->answered);
  count(&s->lost, !in->pulsed);
  count(&s->airborne, all_airborne(s, in));
  if (s->reason != STOP_NONE) return s->reason;
  if (in->stop)
    s->reason = STOP_SWITCH;
  else if (in->timed && since_us > (uint32_t)tick_us + limits->late_us)
    s->reason = STOP_LATE;
  else if (reached(s->lost, limits->lost_ticks))
    s->reason = STOP_LOST;
  else if (slow)
    s->reason = STOP_SLOW;
  else if (reached(s->silent, limits->silent_ticks))
    s->reason = STOP_SILENT;
  else if (reached(s->airborne, limits->airborne_ticks) || (in->walks && in->tilted))
    s->reason = STOP_FALLEN;
  else if (stuck)
    s->reason = STOP_STUCK;
  return s->reason;
}

const char *stop_words(stop_reason reason) {
  switch (reason) {
    case STOP_NONE: return "none";
    case STOP_POWER_ON: return "power on";
    case STOP_SWITCH: return "emergency stop";
    case STOP_COMMAND: return "by command";
    case STOP_LATE: return "a tick was late";
    case STOP_SLOW: return "too slow for its ticks";
    case STOP_SILENT: return "sensors are silent";
    case STOP_LOST: return "pulses do not get to the servos";
    case STOP_STUCK: return "a foot switch is stuck";
    case STOP_FALLEN: return "fallen";
  }
  return "";
}
