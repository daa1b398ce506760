#pragma once

/// Elementary functions by + − × ÷ alone, in one order, so that they have the same bits on every processor
/// and with every C library. Those of the C library have not: glibc rounds otherwise where there is no fused
/// multiply-add. For what decides on results and is not called often. Within 2 units in the last place.
namespace amble::portable {

/// The natural logarithm of a normal number > 0 (AMBLE_CHECK).
double log(double x);

/// e^x. Infinity above 709.78, 0 below −745; NaN of NaN.
double exp(double x);

/// base^exponent, `exponent` ≥ 0 (AMBLE_CHECK), by repeated squaring: its error grows with the exponent.
double power(double base, int exponent);

struct SineCosine {
  double sine, cosine;
};
/// Of so many whole turns, that is of 2π × turns, −1e6 … 1e6 (AMBLE_CHECK).
SineCosine of_turns(double turns);

}  // namespace amble::portable
