#pragma once

#include <span>

#include "amble/cppn/settings.hpp"
#include "amble/neat/genome.hpp"

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
