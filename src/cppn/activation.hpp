#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <span>

#include "amble/cppn/settings.hpp"
#include "amble/neat/genome.hpp"

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
/// The biased exponent of the smallest |x| above near_sine; those of infinities are the largest, 255.
inline constexpr int first_large_exponent = 139;
/// 64 digits of 2^(e − 150)/π each, e being the biased exponent, from first_large_exponent on: those left of
/// the point that are whole turns for every significand are dropped. None for infinities.
inline constexpr auto turn_digits = [] {
  std::array<std::uint64_t, 256 - first_large_exponent> digits{};
  for (std::size_t i = 0; i + 1 < digits.size(); ++i) {
    const std::size_t position = 64 + first_large_exponent - 150 + i, word = position / 64,
                      shift = position % 64;
    digits[i] = one_over_pi_digits[word] << shift;
    if (shift != 0) digits[i] |= one_over_pi_digits[word + 1] >> (64 - shift);
  }
  return digits;
}();
/// The angle of the least turn that is told apart, 2^−64 of one.
inline constexpr double turn_unit_rad = 2.0 * std::numbers::pi * 0x1p-64;

}  // namespace amble::cppn::constants

namespace amble::cppn {

/// Where the function `linear` is cut off.
inline constexpr float largest_linear = 0x1p64f;

/// The activation functions of CPPN nodes (the authors' code), in single precision:
///
/// | name            | formula                              | absolute error, all finite x |
/// |-----------------|--------------------------------------|------------------------------|
/// | bipolar_sigmoid | 2 / (1 + e^−x) − 1                   | below 1.0e−7                 |
/// | gaussian        | 2 e^−(2.5 x)² − 1                    | below 2.0e−7                 |
/// | sine            | sin(2 x)                             | below 1.5e−7                 |
/// | linear          | |x|, or x (Settings::linear)         | none up to 2^64              |
///
/// The first three lie in [−1, 1]; sigmoid and sine are exactly odd, and gaussian exactly even. Linear is
/// clamped to ±2^64, so that sums in a network that feeds on itself stay finite. Infinities have values too:
/// sigmoid ±1, gaussian −1, sine 0, linear ±2^64.
///
/// The range of the sine is reduced in two ways. Up to |x| = 4096 the nearest multiple of π is subtracted in
/// three parts, the first two of 12 bits, so that their products are exact. Beyond, the turn's fraction x/π
/// is the product of the 24-bit significand with a 64-bit window of the digits of 1/π, modulo 2^64: off by at
/// most 2^−40 turns. So the error does not grow with |x|. (Above 2^23 neighbouring arguments lie more than a
/// radian apart, and the value is only a reproducible hash of x.)
///
/// Made of additions, multiplications and divisions that IEEE 754 rounds correctly, in a fixed order and
/// never fused: the same bits on every CPU and for every vector width.
///
/// Replaces every value x, which must not be NaN, by the function of it.
void activate(neat::Activation function, Linear linear, std::span<float> values);

/// For |x| > 4096 an angle a in [−π/2, π/2] with sin(a) = sin(2x); 0 for infinities.
float sine_angle_of_large(float x);

}  // namespace amble::cppn
