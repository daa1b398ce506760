#pragma once

#include <algorithm>
#include <limits>
#include <string>
#include <vector>

#include "amble/core/clock.hpp"

namespace amble::bench {

/// One measured figure.
struct Figure {
  std::string name;  ///< with its unit, e.g. "raw_steps_per_s_ode"
  double value = 0.0;
  std::string unit;  ///< "1" for ratios
  std::string note;  ///< description
};

/// What a figure depends on besides the program: processor, compiler.
struct Circumstance {
  std::string name, text;
};

/// Ratios first, then the rest, as aligned text.
std::string to_text(const std::vector<Figure>& figures);
/// Columns name,value,unit; circumstances come last, as text in quotes without a unit.
std::string to_csv(const std::vector<Figure>& figures, const std::vector<Circumstance>& circumstances);

/// The least seconds per call of `work` in `stretches` stretches of at least `least_s` seconds, after one
/// call to warm up: what it takes where nothing else runs, also on a computer that is shared, as long as some
/// stretches are left alone.
template <typename Work>
double seconds_per_call(Work work, double least_s = 0.02, int stretches = 75) {
  work();
  double least = std::numeric_limits<double>::infinity();
  for (int i = 0; i < stretches; ++i) {
    int calls = 0;
    const double start_s = now_s();
    double spent_s = 0.0;
    do {
      work();
      ++calls;
      spent_s = now_s() - start_s;
    } while (spent_s < least_s);
    least = std::min(least, spent_s / calls);
  }
  return least;
}

}  // namespace amble::bench
