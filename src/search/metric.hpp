#pragma once

#include <string_view>

/// Searches: which genomes to try next, by what those before were worth. Independent of robots.
namespace amble::search {

/// A statistic that a search reports for a generation: one cell of generations.csv, in column `name`.
struct Metric {
  std::string_view name;  ///< a string literal, without commas; no other column has it
  double value = 0.0;     ///< written so that it reads back to the same bits
};

}  // namespace amble::search
