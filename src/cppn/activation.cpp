#include "amble/cppn/activation.hpp"

#include <bit>
#include <cstddef>
#include <cstdint>

#include "amble/cppn/kernels.hpp"

namespace amble::cppn {

void activate(neat::Activation function, Linear linear, std::span<float> values) {
  activate_array(function, linear, values.data(), values.size());
}

float sine_angle_of_large(float x) {
  const auto bits = std::bit_cast<std::uint32_t>(x) & 0x7fffffffu;  // of |x|
  // |x| = significand × 2^(exponent − 150), the significand an integer of 24 bits. 2|x| is |x|/π turns (Payne
  // and Hanek 1983), of which the product keeps the fraction.
  const std::uint64_t significand = (bits & 0x7fffffu) | 0x800000u;
  const auto exponent = static_cast<std::size_t>(bits >> 23);
  std::uint64_t turns = significand * constants::turn_digits[exponent - constants::first_large_exponent];

  // The nearest multiple of half a turn is subtracted; an odd one changes the sign.
  const bool odd = ((turns + (std::uint64_t{1} << 62)) >> 63) != 0;
  if (odd) turns -= std::uint64_t{1} << 63;
  const double angle = static_cast<double>(static_cast<std::int64_t>(turns)) * constants::turn_unit_rad;
  return static_cast<float>((x < 0.0f) != odd ? -angle : angle);
}

}  // namespace amble::cppn
