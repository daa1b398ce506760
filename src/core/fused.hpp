#pragma once

#include <bit>
#include <cstdint>

namespace amble {

/// a b + c, rounded once, for processors that have no instruction for it. The product is exact in double. The
/// sum is rounded to odd, so that rounding it once more, to float, gives what rounding the exact sum gives
/// (Boldo and Melquiond 2008, "Emulation of FMA and correctly rounded sums").
inline float fused(float a, float b, float c) {
  const double product = static_cast<double>(a) * static_cast<double>(b);
  const double addend = static_cast<double>(c);
  double sum = product + addend;
  const double part = sum - product;
  const double error = (product - (sum - part)) + (addend - part);
  const auto bits = std::bit_cast<std::uint64_t>(sum);
  if ((error > 0.0 || error < 0.0) && (bits & 1) == 0)
    sum = std::bit_cast<double>((error > 0.0) == (sum > 0.0) ? bits + 1 : bits - 1);
  return static_cast<float>(sum);
}

}  // namespace amble
