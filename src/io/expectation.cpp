#include "amble/io/expectation.hpp"

#include <fmt/format.h>

#include <cmath>
#include <limits>

namespace amble::io {
namespace {

constexpr double largest = std::numeric_limits<double>::max();

/// " from 0 to 1", or nothing if every value will do.
std::string bounds(Range range, bool infinity_is_a_value) {
  const bool below = std::abs(range.lowest) < largest, above = std::abs(range.highest) < largest;
  const bool infinity = std::isinf(range.lowest) || std::isinf(range.highest);
  if ((below && above) || (infinity_is_a_value && infinity && (below || above))) {
    return fmt::format(" from {} to {}", range.lowest, range.highest);
  }
  if (below) return fmt::format(" of at least {}", range.lowest);
  if (above) return fmt::format(" of at most {}", range.highest);
  return {};
}

}  // namespace

std::string expected_number(Range range) {
  const bool finite = range.lowest == -largest || range.highest == largest;
  return (finite ? "a finite number" : "a number") + bounds(range, true);
}
std::string expected_integer(Range range) {
  return "a whole number" + bounds(range, false);
}
std::string expected_numbers(Range range) {
  return "a list of numbers" + bounds(range, true);
}

std::string expected_choice(std::span<const std::string_view> names) {
  std::string text = "one of ";
  for (std::size_t i = 0; i < names.size(); ++i)
    text += fmt::format("{}\"{}\"", i == 0 ? "" : ", ", names[i]);
  return text;
}

bool in_range(Range range, double value) {
  return value >= range.lowest && value <= range.highest;
}

bool in_range(Range range, std::int64_t value) {
  // Bounds beyond ± 2^63 hold for every int64; the others compare exactly as long double.
  return static_cast<long double>(value) >= range.lowest && static_cast<long double>(value) <= range.highest;
}

}  // namespace amble::io
