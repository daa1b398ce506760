#include "amble/exporting/c_neural_text.hpp"

#include "amble/controllers/logistic_constants.hpp"

namespace amble::exporting {

float controllers_log2_e() {
  return controllers::constants::log2_e;
}

float largest_exponent() {
  return controllers::constants::largest_exponent;
}

const std::string_view c_rounding =
    R"(/* Every operation is rounded by itself, or results differ from amble's in the last bit. */
#ifdef __FAST_MATH__
#error "compile without -ffast-math"
#endif
#ifdef __clang__
#pragma STDC FP_CONTRACT OFF
#endif

)";

const std::string_view c_float_bits = R"(typedef union {
  float number;
  uint32_t bits;
} float_bits;

)";

const std::string_view c_fused = R"(/* a b + c, rounded once to nearest, of finite numbers. */
#ifdef __FP_FAST_FMAF
static float fused(float a, float b, float c) { return __builtin_fmaf(a, b, c); }
#else
/* The 24 binary digits of a |x| that is not 0, the first of them 1; |x| = digits 2^(result - 150). */
static int32_t split(uint32_t bits, uint32_t *digits) {
  int32_t exponent = (int32_t)((bits >> 23) & 255u);
  *digits = bits & 0x7fffffu;
  if (exponent > 0)
    *digits |= 0x800000u;
  else
    for (exponent = 1; *digits < 0x800000u; --exponent) *digits <<= 1;
  return exponent;
}

/* x / 2^count; the last digit is 1 where digits are lost. */
static uint64_t shifted_right(uint64_t x, int32_t count) {
  if (count <= 0) return x;
  if (count > 63) return x != 0 ? 1u : 0u;
  return x >> count | ((x << (64 - count)) != 0 ? 1u : 0u);
}

static float fused(float a, float b, float c) {
  uint32_t a_digits, b_digits, c_digits, high, sign;
  uint64_t product, addend, sum;
  int32_t unit, shift; /* all three are in 2^unit */
  float_bits x, y, z;
  x.number = a, y.number = b, z.number = c;
  if (x.bits << 1 == 0 || y.bits << 1 == 0) return a * b + c;
  if (z.bits << 1 == 0) return a * b;
  unit = split(x.bits, &a_digits) + split(y.bits, &b_digits) - 314;
  shift = split(z.bits, &c_digits) - 150 - unit;
  product = ((uint64_t)a_digits * b_digits) << 14;
  if (shift > 38) {
    product = shifted_right(product, shift - 38);
    unit += shift - 38;
    shift = 38;
  }
  addend = shift >= 0 ? (uint64_t)c_digits << shift : shifted_right(c_digits, -shift);

  sign = (x.bits ^ y.bits) & 0x80000000u;
  if (((sign ^ z.bits) & 0x80000000u) == 0) {
    sum = product + addend;
  } else if (product >= addend) {
    sum = product - addend;
  } else {
    sum = addend - product;
    sign ^= 0x80000000u;
  }
  if (sum == 0) return 0.0f;
  while (sum < (uint64_t)1 << 46) {
    sum <<= 16;
    unit -= 16;
  }
  while (sum < (uint64_t)1 << 62) {
    sum <<= 1;
    --unit;
  }

  /* The exponent as floats have it; 0 and less: the result has fewer digits. */
  unit += 189;
  if (unit > 254) return a * b + c;
  if (unit < 1) {
    sum = shifted_right(sum, 1 - unit);
    unit = 1;
  }
  high = (uint32_t)(sum >> 32) | ((uint32_t)sum != 0 ? 1u : 0u);
  x.bits = (high >> 7) + ((uint32_t)(unit - 1) << 23);
  if ((high & 127u) > 64u || ((high & 127u) == 64u && (x.bits & 1u) != 0)) ++x.bits;
  x.bits |= sign;
  return x.number;
}
#endif

)";

const std::string_view c_logistic = R"(  const float rounder = 0x1.8p23f;
  float_bits sum, power;
  float r, p;
  x = x < largest ? x : largest;
  x = x > -largest ? x : -largest;
  /* k + r = -slope log2(e) x, k whole: e^(-slope x) = 2^k 2^r. */
  sum.number = fused(x, scale, rounder);
  r = fused(x, scale, -(sum.number - rounder));
  p = fused(0x1.5b6d42p-10f, r, 0x1.3cc99p-7f);
  p = fused(p, r, 0x1.c6b7bp-5f);
  p = fused(p, r, 0x1.ebfa54p-3f);
  p = fused(p, r, 0x1.62e42ap-1f);
  p = fused(p, r, 0x1.fffffep-1f);
  /* The low bits of the sum are k: they are added to the exponent of p. */
  power.number = p;
  power.bits += sum.bits << 23;
  return 1.0f / (1.0f + power.number);
}

)";

const std::string_view c_sum = R"(/* x + the weighted values of the links [from, to). */
static float sum_links(float x, const float *values, unsigned from, unsigned to) {
  unsigned k;
  for (k = from; k < to; ++k) x = fused(weight[k], values[source[k]], x);
  return x;
}

)";

const std::string_view c_sense =
    R"(/* A reading, kept within what the sums can bear; where it is not finite, the one before. */
static float sense(float reading, float before) {
  float_bits f;
  f.number = reading;
  if ((f.bits & 0x7f800000u) == 0x7f800000u) return before;
  return reading > 1e6f ? 1e6f : reading < -1e6f ? -1e6f : reading;
}

)";

const std::string_view c_negative_arc_tangent =
    R"(/* The arc tangent of the tangent of -angle, for an angle within +- 3/2 pi. */
static float negative_arc_tangent(float angle_rad) {
  const float half_turn = 3.14159265f, quarter_turn = 1.57079633f;
  const float above = angle_rad > quarter_turn ? half_turn : 0.0f;
  const float below = angle_rad < -quarter_turn ? half_turn : 0.0f;
  return above - below - angle_rad;
}

)";

const std::string_view c_clock_sine = R"(  const float rounder = 0x1.8p23f;
  float_bits sum, angle;
  float x, y, k, r2, p;
  x = (float)((turns - (double)(uint64_t)(turns + 0.5)) * 3.141592653589793);
  /* 2 x = k pi + r, |r| <= pi/2; the sign of an odd k goes to r. */
  y = x + x;
  sum.number = y * 0x1.45f306p-2f + rounder;
  k = sum.number - rounder;
  angle.number = y - k * 0x1.922p1f;
  angle.number = angle.number - k * -0x1.2aep-17f;
  angle.number = angle.number - k * -0x1.de973ep-30f;
  angle.bits ^= sum.bits << 31;
  r2 = angle.number * angle.number;
  p = 0x1.5dbceap-19f * r2 + -0x1.9f6feep-13f;
  p = p * r2 + 0x1.110ed4p-7f;
  p = p * r2 + -0x1.55554cp-3f;
  return p * r2 * angle.number + angle.number;
}

)";

const std::string_view c_levels = R"(/* Sources are before the neurons that they feed. */
static void update($p_state *s) {
  int n;
  for (n = 0; n < $P_NEURONS; ++n) {
    s->sensed[n] = sum_links(0.0f, s->sensor, first[2 * n], first[2 * n + 1]);
    s->neuron[n] = logistic(sum_links(s->sensed[n], s->neuron, first[2 * n + 1], first[2 * n + 2]));
  }
}

)";

const std::string_view c_passes = R"(/* All neurons together, from 0, until nothing changes any more. */
static void update($p_state *s) {
  int n, done, changed = 1;
  for (n = 0; n < $P_NEURONS; ++n) {
    s->sensed[n] = sum_links(0.0f, s->sensor, first[2 * n], first[2 * n + 1]);
    s->neuron[n] = logistic(s->sensed[n]);
  }
  for (done = 1; done < steps && changed; ++done) {
    for (n = 0; n < $P_NEURONS; ++n)
      s->next[n] = logistic(sum_links(s->sensed[n], s->neuron, first[2 * n + 1], first[2 * n + 2]));
    changed = 0;
    for (n = 0; n < $P_NEURONS; ++n) {
      if (s->next[n] != s->neuron[n]) changed = 1;
      s->neuron[n] = s->next[n];
    }
  }
}

)";

const std::string_view c_pulls_rate = R"(/* What pulls neuron n: s(sum - bias) - y. */
static float pull($p_state *s, const float *y, int n) {
  return logistic(sum_links(s->sensed[n], y, first[2 * n + 1], first[2 * n + 2])) - y[n];
}

)";

const std::string_view c_pulls_potential = R"(/* The neurons' values s(y + bias). */
static void find_values($p_state *s, const float *y) {
  int n;
  for (n = 0; n < $P_NEURONS; ++n) s->neuron[n] = logistic(y[n] + bias[n]);
}

/* What pulls neuron n: sum - y. find_values() was called. */
static float pull($p_state *s, const float *y, int n) {
  return sum_links(s->sensed[n], s->neuron, first[2 * n + 1], first[2 * n + 2]) - y[n];
}

)";

const std::string_view c_euler_step = R"(static void integrate($p_state *s, float *y) {
  int n;
  $find_values  for (n = 0; n < $P_NEURONS; ++n) s->next[n] = fused(rate[n], pull(s, y, n), y[n]);
  for (n = 0; n < $P_NEURONS; ++n) y[n] = s->next[n];
}

)";

const std::string_view c_runge_kutta_step = R"(static void integrate($p_state *s, float *y) {
  static const float share[3] = {0.5f, 0.5f, 1.0f};
  int n, k;
  for (k = 0; k < 4; ++k) {
    const float *const at = k == 0 ? y : s->next;
  $find_values    for (n = 0; n < $P_NEURONS; ++n) s->change[k][n] = rate[n] * pull(s, at, n);
    if (k < 3)
      for (n = 0; n < $P_NEURONS; ++n) s->next[n] = fused(share[k], s->change[k][n], y[n]);
  }
  for (n = 0; n < $P_NEURONS; ++n) {
    float sum = fused(2.0f, s->change[1][n], s->change[0][n]);
    sum = fused(2.0f, s->change[2][n], sum) + s->change[3][n];
    y[n] = fused(sum, 1.0f / 6.0f, y[n]);
  }
}

)";

const std::string_view c_ctrnn_begin_rate = R"(  float *y = s->neuron;
  int n, step;
  for (n = 0; n < $P_NEURONS; ++n)
    s->sensed[n] = sum_links(minus_bias[n], s->sensor, first[2 * n], first[2 * n + 1]);
)";

const std::string_view c_ctrnn_begin_potential = R"(  float *y = s->y;
  int n, step;
  for (n = 0; n < $P_NEURONS; ++n)
    s->sensed[n] = sum_links(0.0f, s->sensor, first[2 * n], first[2 * n + 1]);
)";

const std::string_view c_ctrnn_clear = R"(  for (n = 0; n < $P_NEURONS; ++n) y[n] = 0.0f;
)";

const std::string_view c_ctrnn_steps = R"(  for (step = 0; step < steps; ++step) integrate(s, y);
)";

const std::string_view c_ctrnn_end_potential = R"(  find_values(s, y);
)";

const std::string_view c_step_begin =
    R"(void $p_step($p_state *state, const $p_sensors *sensors, $p_targets *targets) {
  int joint;
$heading  read_sensors(state, sensors);
  update(state);
)";

const std::string_view c_step_end = R"(  for (joint = 0; joint < $P_JOINTS; ++joint) {
    double command = 0.0;
    if (driver[joint] >= 0) command = (double)state->neuron[driver[joint]];
    command = command > 0.0 ? command : 0.0;
    command = command < 1.0 ? command : 1.0;
    targets->angle_rad[joint] = (float)(lower_rad[joint] + width_rad[joint] * command);
  }
}
)";

}  // namespace amble::exporting
