#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "amble/experiment/config.hpp"
#include "amble/experiment/problem.hpp"
#include "amble/ledger/ledger.hpp"
#include "amble/ledger/record.hpp"
#include "amble/ledger/study_spec.hpp"
#include "amble/robot/spec.hpp"
#include "amble/study/planned_test.hpp"

namespace amble::study {

/// A condition with its config read and checked.
struct PlannedCondition {
  ledger::ConditionSpec spec;
  experiment::Config config;  ///< of any seed
  robot::RobotSpec robot;
  std::vector<PlannedTest> tests;
  std::string hash;  ///< config_hash() of it

  /// The hash that records have: with ConditionSpec::gaits another one.
  std::string recorded_hash() const;

  /// Whether a record of the condition has all that the tests are to measure.
  bool has_all_tests(const ledger::Record& record) const;
};

/// One run of a study.
struct PlannedRun {
  std::size_t condition = 0;
  std::int64_t seed = 0;
};

/// Which part of a study a process takes: the runs whose number is index − 1 modulo count.
struct Shard {
  int index = 1;  ///< 1 … count
  int count = 1;

  /// "2/8". Throws UserError.
  static Shard parse(std::string_view text);
};

/// All runs of a study, in the order in which they are begun: seed by seed, conditions in turn, so that a
/// study that is stopped early has about as many runs of each condition. Each seed begins with another
/// condition, so that a shard's runs are not all of one.
struct Plan {
  ledger::StudySpec study;
  ledger::StudyPaths paths;
  std::vector<PlannedCondition> conditions;
  std::vector<PlannedRun> runs;

  const PlannedCondition& condition(const PlannedRun& run) const { return conditions[run.condition]; }
  std::filesystem::path folder(const PlannedRun& run) const;
  /// "supg-novelty, seed 7".
  std::string name(const PlannedRun& run) const;
  experiment::Config config(const PlannedRun& run) const;
  /// Makes results of these tests that another build than this one measured due again, for engines that
  /// have changed since. Throws UserError if no condition has a test of that name.
  void retest(const std::vector<std::string>& tests);
  /// Indices of its runs.
  std::vector<std::size_t> shard(const Shard& shard) const;
};

/// Reads every config. Throws UserError: what load_study() and load_config() throw, an engine that cannot
/// simulate a robot, a test of an unknown engine.
Plan make_plan(const ledger::StudySpec& study, const std::filesystem::path& folder);

/// Hash of all settings but the seed, the generations and the name, and of the robot: hexadecimal. Two
/// configs of one hash give the same run for the same seed and generations.
std::string config_hash(const experiment::Config& config, const robot::RobotSpec& robot);

enum class RunStatus {
  missing,   ///< neither record nor run folder
  begun,     ///< a run folder that can be resumed
  untested,  ///< a record that lacks a test of the study
  done       ///< a record with all tests
};

/// The state of each run, in the order of Plan::runs, from the folders alone.
///
/// Throws UserError, and changes nothing, if a record or a run folder does not fit the study any more (other
/// settings, robot, generations or tests): one line that names all of them and why. A file that cannot be
/// read is reported likewise.
std::vector<RunStatus> survey(const Plan& plan);

}  // namespace amble::study
