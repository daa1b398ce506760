#include "commands.h"

enum { whole_digits = 2, decimals = 4 };

void command_begin(command *c) {
  c->speed_m_s = c->turn_rad_s = 0.0f;
  c->ticks = 0;
}

static const char *past_spaces(const char *text) {
  while (*text == ' ') ++text;
  return text;
}

int command_begins(const char *line) {
  return line[0] == 'g' && line[1] == 'o' && (line[2] == 0 || line[2] == ' ');
}

/* What is behind a number, which ends with the line or a space; 0: there is none. */
static const char *read_decimal(const char *text, float *number) {
  const int negative = *text == '-';
  int32_t value = 0, scale = 1;
  int digits = 0, behind = 0;
  if (*text == '-' || *text == '+') ++text;
  for (; *text >= '0' && *text <= '9'; ++text, ++digits) {
    if (digits == whole_digits) return 0;
    value = value * 10 + *text - '0';
  }
  for (text += *text == '.'; *text >= '0' && *text <= '9'; ++text, ++behind, scale *= 10) {
    if (behind == decimals) return 0;
    value = value * 10 + *text - '0';
  }
  *number = (float)(negative ? -value : value) / (float)scale;
  return digits + behind > 0 && (*text == 0 || *text == ' ') ? text : 0;
}

int command_take(command *c, const char *line) {
  float speed_m_s, turn_rad_s;
  const char *rest = command_begins(line) ? read_decimal(past_spaces(line + 2), &speed_m_s) : 0;
  rest = rest ? read_decimal(past_spaces(rest), &turn_rad_s) : 0;
  if (!rest || *past_spaces(rest) != 0) return 0;
  c->speed_m_s = speed_m_s;
  c->turn_rad_s = turn_rad_s;
  c->ticks = 0;
  return 1;
}

int command_runs_out(command *c, uint16_t ticks) {
  if (ticks == 0 || (c->speed_m_s == 0.0f && c->turn_rad_s == 0.0f)) return 0;
  if (c->ticks++ < ticks) return 0;
  command_begin(c);
  return 1;
}
