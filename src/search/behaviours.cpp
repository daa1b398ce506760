#include "amble/search/behaviours.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "amble/core/check.hpp"

namespace amble::search {

Behaviours::Behaviours(std::size_t length, std::size_t capacity) : length_(length) {
  AMBLE_CHECK(length > 0, "a behaviour has at least one number");
  values_.reserve(length * capacity);
  squared_norms_.reserve(capacity);
}

void Behaviours::append(std::span<const float> row) {
  AMBLE_CHECK(row.size() == length_, "behaviours have one length");
  AMBLE_CHECK(std::ranges::all_of(row, [](float value) { return std::isfinite(value); }),
              "behaviours are finite");
  AMBLE_CHECK(rows() < squared_norms_.capacity(), "rows never move");
  values_.insert(values_.end(), row.begin(), row.end());
  double sum = 0.0;
  for (const float value : row) sum += static_cast<double>(value) * static_cast<double>(value);
  squared_norms_.push_back(sum);
}

double exact_squared_distance(std::span<const float> a, std::span<const float> b) {
  AMBLE_CHECK(a.size() == b.size(), "behaviours have one length");
  // Eight partial sums, so that the compiler may use vectors without changing the order.
  constexpr std::size_t width = 8;
  std::array<double, width> sums{};
  const auto add = [&](std::size_t i, std::size_t sum) {
    const double difference = static_cast<double>(a[i]) - static_cast<double>(b[i]);
    sums[sum] += difference * difference;
  };
  std::size_t i = 0;
  for (; i + width <= a.size(); i += width)
    for (std::size_t k = 0; k < width; ++k) add(i + k, k);
  for (std::size_t k = 0; i < a.size(); ++i, ++k) add(i, k);
  return ((sums[0] + sums[1]) + (sums[2] + sums[3])) + ((sums[4] + sums[5]) + (sums[6] + sums[7]));
}

}  // namespace amble::search
