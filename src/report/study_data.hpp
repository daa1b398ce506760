#pragma once

#include <algorithm>
#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "amble/ledger/measures.hpp"
#include "amble/ledger/record.hpp"
#include "amble/ledger/study_spec.hpp"

namespace amble::report {

/// Confidence of every interval in a report, but for claims of a value, which have theirs at 1 − alpha.
inline constexpr double confidence = 0.95;

/// Bootstrap intervals are given from so many runs on. Resamples cannot leave the range of a sample, and the
/// whole range of n values holds the median with a probability of 1 − 2^(1 − n): below six not even that is
/// an interval of 95 %.
inline constexpr std::size_t fewest_resampled = 6;

/// Fewer runs of a condition decide no claim, whatever its test says. Five against five are the fewest with
/// which a rank test can reach the paper's level of 0.01 (0.008; four against four 0.029).
inline constexpr std::size_t fewest_judged = 5;

/// The fewest runs of each condition with which a claim of that kind is judged.
constexpr std::size_t fewest_runs(ledger::ClaimKind kind) {
  const bool resampled = kind == ledger::ClaimKind::ratio || kind == ledger::ClaimKind::plateau;
  return resampled ? std::max(fewest_judged, fewest_resampled) : fewest_judged;
}

/// A study and those of its runs that are finished.
struct StudyData {
  ledger::StudySpec study;
  std::vector<ledger::Record> records;     ///< by condition and seed in the order of the study
  std::vector<std::string> unknown_files;  ///< in the ledger, of no run of the study; names, printable

  std::size_t planned() const;                            ///< runs of all conditions
  std::size_t planned(std::string_view condition) const;  ///< a condition of the study
  std::vector<const ledger::Record*> runs(std::string_view condition) const;
  /// The run's result of a test that the study has for its condition; nothing of other tests, which a study
  /// may have had before, and of those that the run lacks. Everything in a report comes by this and value().
  const ledger::TestResult* result(const ledger::Record& run, std::string_view test) const;
  /// A measure (ledger/measures.hpp) of the run, or of such a result.
  std::optional<double> value(const ledger::Record& run, std::string_view measure) const;
  /// The values of all finished runs that have the measure (ledger/measures.hpp), in the order of seeds.
  std::vector<double> values(std::string_view condition, std::string_view measure) const;
  /// The objective of a condition's finished runs, or of all: a distance, or in m, if that of every one is.
  record::Objective objective(std::string_view condition = {}) const;
  /// " m", " s" or "" of a measure in a condition, or in all.
  std::string unit_of(std::string_view measure, std::string_view condition = {}) const;
};

/// Reads DIR/study.toml and DIR/ledger. Throws UserError: no study, a damaged record.
StudyData load_study_data(const std::filesystem::path& folder);

/// Names of all measures that the study's records have: those of runs, of maps, of its tests.
std::vector<std::string> measures_of(const StudyData& data);
/// Those of them in which all pairs of conditions are compared: of runs and tests some, of maps all.
std::vector<std::string> compared_measures_of(const StudyData& data);

/// Under which rules the claims were written that the records' runs were made for.
struct ClaimsWritten {
  struct Records {
    ledger::JudgingRules rules;
    std::size_t count = 0;
  };
  std::vector<Records> under;   ///< records whose claims are the study's, word for word
  std::size_t differently = 0;  ///< records whose claims were others
};
ClaimsWritten claims_written(const StudyData& data);
/// "verdict rules 2 and stop rule 1".
std::string rules_text(const ledger::JudgingRules& rules);

/// What a reader must know before the numbers: runs that are missing or lack tests, a condition whose records
/// differ in config, engine or generations, scores that differ, tests of another length than in the study or
/// of several settings, records of other studies, unknown files. Empty if there is nothing to remark.
std::vector<std::string> remarks(const StudyData& data);

}  // namespace amble::report
