#pragma once

#include <cstdint>

/// Constants of the activation functions; activation.hpp and activation-inl.hpp say how they are used.
namespace amble::cppn::constants {

/// Added and subtracted again, it rounds |x| < 2^22 to the nearest integer (ties to even), whose low bits are
/// then the sum's.
inline constexpr float rounder = 0x1.8p23f;

/// e^z = 2^k e^r with z = k ln 2 + r. ln2_high has 15 bits, so that k ln2_high is exact.
inline constexpr float log2_e = 0x1.715476p0f, ln2_high = 0x1.62e4p-1f, ln2_low = 0x1.7f7d1cp-20f;
/// e^r ≈ 1 + r + r² (e2 + e3 r + … + e6 r⁴) for |r| ≤ ln(2)/2: minimax, relative error 3.1e−9 before
/// rounding.
inline constexpr float e2 = 0x1.fffffcp-2f, e3 = 0x1.555492p-3f, e4 = 0x1.5558f2p-5f, e5 = 0x1.1239e2p-7f,
                       e6 = 0x1.6a2434p-10f;
/// e^−86 is the smallest power computed: nothing is lost below, and the exponent stays in range.
inline constexpr float lowest_exponent = -86.0f;

/// π in three parts; the first two have 12 bits, so that k times either is exact for |k| ≤ 2^12.
inline constexpr float one_over_pi = 0x1.45f306p-2f, pi_high = 0x1.922p1f, pi_middle = -0x1.2aep-17f,
                       pi_low = -0x1.de973ep-30f;
/// sin r ≈ r + r³ (s3 + s5 r² + s7 r⁴ + s9 r⁶) for |r| ≤ π/2: minimax, relative error 6.1e−9 before rounding.
inline constexpr float s3 = -0x1.55554cp-3f, s5 = 0x1.110ed4p-7f, s7 = -0x1.9f6feep-13f, s9 = 0x1.5dbceap-19f;
/// Up to here the sine's argument is reduced by the three parts of π.
inline constexpr float near_sine = 4096.0f;
/// 64 zeros and the first 192 binary digits of 1/π.
inline constexpr std::uint64_t one_over_pi_digits[4] = {0, 0x517cc1b727220a94, 0xfe13abe8fa9a6ee0,
                                                        0x6db14acc9e21c820};

}  // namespace amble::cppn::constants
