#pragma once

#include <optional>
#include <string>
#include <vector>

#include "amble/report/study_data.hpp"
#include "amble/statistics/bootstrap.hpp"
#include "amble/statistics/descriptive.hpp"

namespace amble::report {

/// What a condition's champions typically do at one amount of disturbance. The sample is each champion's
/// typical distance, m: the median of its trials.
struct TypicalPoint {
  std::size_t column = 0;           ///< of TypicalTable::columns
  std::string measure;              ///< the one of the column's that the condition has
  std::vector<double> distances_m;  ///< by run
  statistics::Summary summary;
  std::optional<statistics::BootstrapInterval> median;  ///< BCa; from fewest_resampled runs on
  std::optional<double> fell_share;  ///< of all trials, those that fell or diverged; none of `train_m`
};

struct TypicalCurve {
  std::string condition;
  std::vector<TypicalPoint> points;  ///< by rising disturbance; at least one at a level

  const TypicalPoint* at(std::size_t column) const;
};

/// Tests that differ in nothing but their level of disturbance (TestSpec::level).
struct TypicalTable {
  struct Column {
    std::string level;  ///< empty: undisturbed
    /// "milli.distance_m", …, of which a condition has one; undisturbed: of tests without noise, or
    /// "train_m".
    std::vector<std::string> measures;
  };

  std::string engine;  ///< empty: that of the runs
  double trial_s = 0.0;
  /// The first of its tests, if they have a ground, damage, command or settings of the engine of their own.
  std::string as_in;
  std::vector<Column> columns;       ///< undisturbed first, if that was measured; then the weakest level on
  std::vector<TypicalCurve> curves;  ///< in the order of the study; of conditions with a level

  /// "typical-15s", "typical-15s-ode", "typical-15s-uphill": for files.
  std::string name() const;
};

/// Name of a column: its level, or "none".
std::string_view disturbance_name(const TypicalTable::Column& column);

/// Empty for studies without tests at a level. `train_m` stands for the undisturbed trial where evolution had
/// neither noise nor uneven ground, trials of that length, and distance as its score.
std::vector<TypicalTable> typical_tables(const StudyData& data);

}  // namespace amble::report
