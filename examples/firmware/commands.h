/* What a walker is told by the serial port: `go SPEED TURN`, m/s along its own forward axis and rad/s to the left. */
#ifndef COMMANDS_H
#define COMMANDS_H

#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

typedef struct {
  float speed_m_s, turn_rad_s;
  uint16_t ticks; /* in which it has been in effect */
} command;

/* To stand: 0 and 0. */
void command_begin(command *c);
/* 1: the line's first word is `go`. */
int command_begins(const char *line);
/* Takes the command of a line, `go 0.2 -0.35`: at most two digits and four decimals each. 0: it is none, and changes nothing. */
int command_take(command *c, const char *line);
/* To be called once per tick. 1: it has been in effect for so many ticks without another line, and is now to stand. 0 ticks: it
 * stays. */
int command_runs_out(command *c, uint16_t ticks);

#ifdef __cplusplus
}
#endif

#endif
