#include "amble/core/elementary.hpp"

#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

#include "amble/core/check.hpp"

namespace amble::portable {
namespace {

// ln 2 in two parts; a whole number below 2^20 times the first is exact.
constexpr double ln2_high = 0x1.62e42feep-1, ln2_low = 0x1.a39ef35793c76p-33;

}  // namespace

double log(double x) {
  AMBLE_CHECK(std::isnormal(x) && x > 0.0, "a logarithm is of a normal number above 0");
  // x = m 2^e with m in √½ … √2, and ln m = 2 artanh s.
  int exponent = 0;
  double m = std::frexp(x, &exponent);
  if (m < std::numbers::sqrt2 / 2.0) {
    m *= 2.0;
    --exponent;
  }
  const double s = (m - 1.0) / (m + 1.0), square = s * s;
  double sum = 0.0;
  for (int n = 21; n >= 3; n -= 2) sum = square * (sum + 1.0 / n);
  return exponent * ln2_high + (2.0 * s + (2.0 * s * sum + exponent * ln2_low));
}

double exp(double x) {
  if (std::isnan(x)) return x;
  if (x > 710.0) return std::numeric_limits<double>::infinity();
  if (x < -746.0) return 0.0;
  const double whole = std::round(x / std::numbers::ln2);
  const double rest = (x - whole * ln2_high) - whole * ln2_low;  // within ± ln 2 / 2
  double sum = 1.0;
  for (int n = 14; n >= 2; --n) sum = 1.0 + rest / n * sum;
  return std::ldexp(1.0 + rest * sum, static_cast<int>(whole));
}

double power(double base, int exponent) {
  AMBLE_CHECK(exponent >= 0, "a power is by a whole number of at least 0");
  double result = 1.0;
  for (double square = base; exponent > 0; exponent /= 2, square *= square)
    if (exponent % 2 != 0) result *= square;
  return result;
}

SineCosine of_turns(double turns) {
  AMBLE_CHECK(std::abs(turns) <= 1e6, "turns that can be told apart");
  // Less the nearest quarter, which is exact: within ± π/4.
  const double quarters = std::round(4.0 * turns);
  const double x = 2.0 * std::numbers::pi * (turns - quarters / 4.0), square = x * x;
  double sine = 1.0, cosine = 1.0;
  for (int n = 18; n >= 2; n -= 2) sine = 1.0 - square / (n * (n + 1)) * sine;
  for (int n = 17; n >= 1; n -= 2) cosine = 1.0 - square / (n * (n + 1)) * cosine;
  sine *= x;
  // Quarter by quarter the two change places and signs.
  const double place = quarters - 4.0 * std::floor(quarters / 4.0);
  if (place == 1.0 || place == 3.0) {
    std::swap(sine, cosine);
    cosine = -cosine;
  }
  if (place >= 2.0) {
    sine = -sine;
    cosine = -cosine;
  }
  return {sine, cosine};
}

}  // namespace amble::portable
