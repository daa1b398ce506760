#include "amble/cppn/activation.hpp"

#include <cmath>
#include <cstdint>
#include <numbers>

#include "amble/cppn/activation_constants.hpp"
#include "amble/cppn/kernels.hpp"

namespace amble::cppn {

void activate(neat::Activation function, Linear linear, std::span<float> values) {
  activate_array(function, linear, values.data(), values.size());
}

float sine_angle_of_large(float x) {
  if (std::isinf(x)) return 0.0f;
  // |x| = significand × 2^exponent, the significand an integer of 24 bits, the exponent from −11 to 104.
  int exponent = 0;
  const auto significand = static_cast<std::uint64_t>(std::ldexp(std::frexp(std::fabs(x), &exponent), 24));
  exponent -= 24;

  // sin(2|x|) makes |x|/π turns. Digits of 2^exponent/π left of the point are whole turns and fall away, as
  // do those of the product.
  const int position = 64 + exponent, word = position / 64, shift = position % 64;
  std::uint64_t window = constants::one_over_pi_digits[word] << shift;
  if (shift != 0) window |= constants::one_over_pi_digits[word + 1] >> (64 - shift);
  std::uint64_t turns = significand * window;  // in units of 2^−64 turns

  // The nearest half turn is taken off; an odd one changes the sign.
  const bool odd = ((turns + (std::uint64_t{1} << 62)) >> 63) != 0;
  if (odd) turns -= std::uint64_t{1} << 63;
  const double angle =
      static_cast<double>(static_cast<std::int64_t>(turns)) * (2.0 * std::numbers::pi * 0x1p-64);
  return static_cast<float>((x < 0.0f) != odd ? -angle : angle);
}

}  // namespace amble::cppn
