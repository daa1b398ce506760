#pragma once

#include <array>
#include <cstddef>
#include <limits>
#include <string>
#include <string_view>
#include <vector>

#include "amble/io/settings.hpp"

namespace amble::ledger {

struct StudySpec;

/// How a claim is judged (docs/STUDIES.md has the rules).
enum class ClaimKind {
  difference,  ///< the mean of `measure` in `condition` exceeds that in `against`, by a two-sample test
  ratio,       ///< a ratio of two means lies on the claimed side of a bound
  value,       ///< the mean of `measure` agrees with a published mean and standard deviation
  count,       ///< how many runs reach a threshold
  gaits,       ///< which gaits occur in a test
  plateau      ///< the share of the final distance that is gained after a generation
};
inline constexpr std::array<std::string_view, 6> claim_kind_names{"difference", "ratio", "value",
                                                                  "count",      "gaits", "plateau"};

enum class TwoSampleTest { student, welch, mann_whitney };
inline constexpr std::array<std::string_view, 3> two_sample_test_names{"student", "welch", "mann_whitney"};

/// What a difference has to be.
enum class Relation { greater, not_less };
inline constexpr std::array<std::string_view, 2> relation_names{"greater", "not_less"};

inline constexpr double unbounded = std::numeric_limits<double>::infinity();

/// A sentence about the results together with the rule by which it is judged, written down before the runs.
struct ClaimSpec {
  std::string text;    ///< the sentence
  std::string source;  ///< where it was claimed
  std::string figure;  ///< the published figure, as text
  ClaimKind kind = ClaimKind::difference;
  std::string measure = "train_m";  ///< ledger/measures.hpp
  std::string condition;
  std::string against;                          ///< difference; ratio between conditions
  std::string base_measure;                     ///< ratio within a condition
  Relation relation = Relation::greater;        ///< difference
  TwoSampleTest test = TwoSampleTest::student;  ///< difference
  double alpha = 0.05;                          ///< difference, value
  double margin = 0.0;  ///< difference that is not_less: how much less is no worse; 0: none was stated
  double at_least = -unbounded, at_most = unbounded;  ///< ratio, count, plateau
  double threshold = -unbounded;                      ///< count: a run counts from here on
  std::string threshold_condition;                    ///< count: the threshold is the mean of this condition
  double mean = 0.0, sd = 0.0;                        ///< value: as published
  double within = 0.25;  ///< value: means are equivalent within this share of the published one
  int runs = 0;          ///< value, count: runs behind the published figure
  int successes = 0;     ///< count: as published, of `runs`
  std::vector<std::string> includes, only;  ///< gaits: must occur; nothing else may occur
  int from_generation = 0;                  ///< plateau

  void describe(io::SettingsVisitor& visitor);
};

/// Throws UserError, with its place, if a study's claim lacks what its kind needs, or is about conditions,
/// tests or measures that the study does not have; unless it is recorded also if it says what has no effect.
void check_claim(const StudySpec& study, std::size_t index, bool is_recorded);

}  // namespace amble::ledger
