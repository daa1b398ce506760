#pragma once

#include <string_view>

namespace amble::search {

/// A number that a search tells of a generation: one cell of generations.csv, under the column `name`.
struct Reading {
  std::string_view name;  ///< lives as long as the program
  double value = 0.0;
};

}  // namespace amble::search
