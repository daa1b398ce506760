#pragma once

#include <cstddef>
#include <span>

#include "amble/record/trajectory.hpp"

namespace amble::score {

/// What a walker typically does: several disturbed trials in a few numbers, in the unit of their values
/// (distance, m, or score). One trial is a trajectory; this describes the gait.
struct Typical {
  std::size_t trials = 0;
  double median = 0.0;          ///< the typical value
  double lower_quartile = 0.0;  ///< quantiles of type 7 (statistics/descriptive.hpp)
  double upper_quartile = 0.0;
  double best = 0.0;        ///< the luckiest trial
  double fell_share = 0.0;  ///< of the trials that fell, or diverged; 0 … 1

  friend bool operator==(const Typical&, const Typical&) = default;
};

/// What at least one trial tells: its value, finite, and how it ended.
Typical typical(std::span<const double> values, std::span<const record::Outcome> outcomes);

}  // namespace amble::score
