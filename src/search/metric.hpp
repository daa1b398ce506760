#pragma once

#include <string_view>

namespace amble::search {

/// A statistic that a search reports for a generation: one cell of generations.csv, in column `name`.
struct Metric {
  std::string_view name;  ///< a string literal
  double value = 0.0;
};

}  // namespace amble::search
