#include "amble/cppn/activation.hpp"

#include <bit>
#include <cstdint>
#include <numbers>

#include "amble/cppn/kernels.hpp"

namespace amble::cppn {

void activate(neat::Activation function, Linear linear, std::span<float> values) {
  activate_array(function, linear, values.data(), values.size());
}

float sine_angle_of_large(float x) {
  const auto bits = std::bit_cast<std::uint32_t>(x) & 0x7fffffffu;  // of |x|
  if (bits >= 0x7f800000u) return 0.0f;
  // |x| = significand × 2^exponent, the significand an integer of 24 bits, the exponent from −11 to 104.
  const std::uint64_t significand = (bits & 0x7fffffu) | 0x800000u;
  const int exponent = static_cast<int>(bits >> 23) - 150;

  // 2|x| is |x|/π turns (Payne and Hanek 1983). Digits of 2^exponent/π left of the point are whole turns and
  // are dropped, as are those of the product.
  const int position = 64 + exponent, word = position / 64, shift = position % 64;
  std::uint64_t window = constants::one_over_pi_digits[word] << shift;
  if (shift != 0) window |= constants::one_over_pi_digits[word + 1] >> (64 - shift);
  std::uint64_t turns = significand * window;  // in units of 2^−64 turns

  // The nearest multiple of half a turn is subtracted; an odd one changes the sign.
  const bool odd = ((turns + (std::uint64_t{1} << 62)) >> 63) != 0;
  if (odd) turns -= std::uint64_t{1} << 63;
  const double angle =
      static_cast<double>(static_cast<std::int64_t>(turns)) * (2.0 * std::numbers::pi * 0x1p-64);
  return static_cast<float>((x < 0.0f) != odd ? -angle : angle);
}

}  // namespace amble::cppn
