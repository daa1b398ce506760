/* When to stop. A stop stays until somebody arms the robot again. */
#ifndef SAFETY_H
#define SAFETY_H

#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

typedef enum {
  STOP_NONE,     /* it may move */
  STOP_POWER_ON, /* never armed since power came */
  STOP_SWITCH,   /* the emergency stop */
  STOP_COMMAND,  /* by the serial port */
  STOP_LATE,     /* a tick came late */
  STOP_SLOW,     /* ticks came late, all together */
  STOP_SILENT,   /* sensors do not answer */
  STOP_LOST,     /* pulses do not get to the servos */
  STOP_STUCK,    /* a foot switch has not changed for long, while walking, not told to stand */
  STOP_FALLEN    /* no foot on the ground for long, once one was, or the trunk is tilted, while walking */
} stop_reason;

/* 0: not watched, but for late_us. */
typedef struct {
  uint32_t late_us;        /* a tick this much later than it is due */
  uint16_t silent_ticks;   /* in a row without an answer of the sensors */
  uint16_t stuck_ticks;    /* without a change of one foot's touch */
  uint16_t airborne_ticks; /* without any foot on the ground, after one was there */
  uint16_t lost_ticks;     /* in a row in which a pulse did not get to its servo */
  uint32_t slow_us;        /* so late in all, within a second of ticks */
} safety_limits;

/* Legs that are watched at most. */
enum { SAFETY_LEGS = 8 };

typedef struct {
  stop_reason reason;
  uint32_t last_us, second_us; /* the last tick, and that with which the running second began */
  uint16_t second_ticks, silent, lost, airborne, same[SAFETY_LEGS];
  uint8_t landed, touch[SAFETY_LEGS];
} safety;

/* What a tick knows. */
typedef struct {
  uint32_t now_us;    /* goes round */
  uint8_t stop;       /* 1: the emergency stop is pressed, or its wire is broken */
  uint8_t answered;   /* 1: the sensors are of this tick */
  uint8_t pulsed;     /* 1: the last tick's pulses got to the servos */
  uint8_t timed;      /* 1: late ticks stop */
  uint8_t walks;      /* 1: feet and trunk are watched */
  uint8_t stands;     /* 1: feet need not change */
  uint8_t tilted;     /* 1: the trunk is not upright */
  uint8_t legs;       /* with switches; 0: none */
  uint8_t touch[SAFETY_LEGS];
} safety_inputs;

/* Stopped: STOP_POWER_ON. */
void safety_init(safety *s);
/* Lifts the stop: 1. While the emergency stop is pressed it does not: 0. */
int safety_arm(safety *s, const safety_inputs *in);
/* To be called once per tick: the reason of the stop, the first one since it was armed. */
stop_reason safety_check(safety *s, const safety_limits *limits, int32_t tick_us, const safety_inputs *in);
const char *stop_words(stop_reason reason);

#ifdef __cplusplus
}
#endif

#endif
