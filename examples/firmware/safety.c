#include "safety.h"

void safety_init(safety *s) {
  int leg;
  s->reason = STOP_POWER_ON;
  s->last_us = 0;
  s->silent = s->airborne = 0;
  for (leg = 0; leg < SAFETY_LEGS; ++leg) s->same[leg] = 0, s->touch[leg] = 0;
}

int safety_arm(safety *s, const safety_inputs *in) {
  if (in->stop) return 0;
  safety_init(s);
  s->reason = STOP_NONE;
  s->last_us = in->now_us;
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
    count(&s->same[leg], in->walks && in->touch[leg] == s->touch[leg]);
    s->touch[leg] = in->touch[leg];
    stuck = stuck || reached(s->same[leg], limits->stuck_ticks);
  }
  return stuck;
}

static int all_airborne(const safety_inputs *in) {
  int leg;
  for (leg = 0; leg < in->legs; ++leg)
    if (in->touch[leg]) return 0;
  return in->legs > 0;
}

stop_reason safety_check(safety *s, const safety_limits *limits, int32_t tick_us, const safety_inputs *in) {
  const uint32_t since_us = in->now_us - s->last_us;
  const int stuck = any_stuck(s, limits, in);
  s->last_us = in->now_us;
  count(&s->silent, !in->answered);
  count(&s->airborne, in->walks && all_airborne(in));
  if (s->reason != STOP_NONE) return s->reason;
  if (in->stop)
    s->reason = STOP_SWITCH;
  else if (in->timed && since_us > (uint32_t)tick_us + limits->late_us)
    s->reason = STOP_LATE;
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
    case STOP_SILENT: return "sensors are silent";
    case STOP_STUCK: return "a foot switch is stuck";
    case STOP_FALLEN: return "fallen";
  }
  return "";
}
