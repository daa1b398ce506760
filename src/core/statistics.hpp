#pragma once

#include <algorithm>
#include <vector>

#include "amble/core/check.hpp"

namespace amble {

/// Median of at least one value; the mean of the two middle ones if their number is even.
inline double median(std::vector<double> values) {
  AMBLE_CHECK(!values.empty(), "a median needs a value");
  std::ranges::sort(values);
  const std::size_t n = values.size();
  return 0.5 * (values[(n - 1) / 2] + values[n / 2]);
}

}  // namespace amble
