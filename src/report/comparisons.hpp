#pragma once

#include <optional>
#include <string>
#include <vector>

#include "amble/report/study_data.hpp"
#include "amble/statistics/bootstrap.hpp"
#include "amble/statistics/descriptive.hpp"
#include "amble/statistics/hypothesis_tests.hpp"

namespace amble::report {

/// A measure in one condition.
struct SampleSummary {
  std::string measure, condition;
  std::size_t planned = 0;      ///< runs of the condition
  statistics::Summary summary;  ///< of at least one run
  /// BCa intervals of median and interquartile mean; of distances only, and from fewest_resampled runs on.
  std::optional<statistics::BootstrapInterval> median, interquartile_mean;
};

/// Every measure in every condition that has it, measure by measure.
std::vector<SampleSummary> summarize(const StudyData& data);
/// Nothing if no run of the condition has the measure.
const SampleSummary* find_summary(const std::vector<SampleSummary>& summaries, std::string_view measure,
                                  std::string_view condition);

/// A test of two samples with its p value among the others of its family.
template <typename Test>
struct AdjustedTest {
  Test test;
  double p_holm = 1.0;
};

/// Two conditions compared in one measure. What needs more runs or more spread than there is, is absent.
struct Pair {
  std::string first, second;  ///< conditions
  std::size_t n_first = 0, n_second = 0;
  std::optional<AdjustedTest<statistics::TTest>> student, welch;
  std::optional<AdjustedTest<statistics::MannWhitney>> mann_whitney;
  std::optional<statistics::Superiority> superiority;
};

/// All pairs of conditions in one measure. For each of the three tests the p values of all its pairs are one
/// family for Holm's adjustment.
struct PairTable {
  std::string measure;
  std::vector<Pair> pairs;  ///< of conditions with at least two runs each, in the order of the study
};

/// For every measure of compared_measures_of() in which at least one pair can be compared.
std::vector<PairTable> compare_pairs(const StudyData& data);

}  // namespace amble::report
