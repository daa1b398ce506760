#pragma once

/// Numbers of the logistic function; how they are used is explained in logistic-inl.hpp.
namespace amble::controllers::constants {

inline constexpr float log2_e = 0x1.715476p0f;
/// Added and subtracted again, it rounds |x| < 2^22 to the nearest integer (ties to even), whose low bits are
/// then the sum's.
inline constexpr float rounder = 0x1.8p23f;
/// Exponents are cut off at ±126, where powers of two are normal numbers and 1 + 2^−126 is 1.
inline constexpr float largest_exponent = 126.0f;
/// 2^r ≈ e0 + e1 r + … + e5 r⁵ for |r| ≤ 1/2: minimax with this e0, relative error 1.2e−7 before rounding, of
/// which at most a quarter is left in 1/(1 + 2^r).
inline constexpr float e0 = 0x1.fffffep-1f, e1 = 0x1.62e42ap-1f, e2 = 0x1.ebfa54p-3f, e3 = 0x1.c6b7bp-5f,
                       e4 = 0x1.3cc99p-7f, e5 = 0x1.5b6d42p-10f;

}  // namespace amble::controllers::constants
