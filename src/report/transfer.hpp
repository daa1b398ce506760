#pragma once

#include <optional>
#include <string>
#include <vector>

#include "amble/report/study_data.hpp"
#include "amble/statistics/bootstrap.hpp"

namespace amble::report {

/// Champions of one condition in an engine other than that of their evolution.
struct Transfer {
  std::string test, condition;
  std::string home, engine;  ///< where they evolved, and where they were tried
  double trial_s = 0.0;
  /// The measure that the distance is compared with: a test of the same length in the home engine, or train_m
  /// if that is a distance and the test as long as the trials of evolution. Empty if there is neither.
  std::string reference;
  std::size_t n = 0;  ///< runs with the test
  double median_m = 0.0;
  std::size_t n_share = 0;  ///< runs with a reference above 0
  /// Median over runs of distance / reference; with at least one such run.
  std::optional<double> share;
  std::optional<statistics::BootstrapInterval> share_interval;  ///< BCa; from fewest_resampled runs on
};

/// Every test in another engine, condition by condition.
std::vector<Transfer> transfers(const StudyData& data);

}  // namespace amble::report
