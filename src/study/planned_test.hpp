#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

#include "amble/damage/settings.hpp"
#include "amble/experiment/problem.hpp"
#include "amble/experiment/steering.hpp"
#include "amble/ground/settings.hpp"
#include "amble/io/own_settings.hpp"
#include "amble/ledger/record.hpp"
#include "amble/ledger/study_spec.hpp"
#include "amble/trial/noise_settings.hpp"

namespace amble::study {

/// A test with the files that it names read.
struct PlannedTest {
  ledger::TestSpec spec;
  trial::NoiseSettings noise;                          ///< that of TestSpec::noise
  io::OwnSettings engine_own = {};                     ///< that of TestSpec::engine_own
  std::optional<ground::Settings> ground = {};         ///< that of TestSpec::ground
  std::optional<damage::Settings> damage = {};         ///< that of TestSpec::damage
  std::optional<trial::CommandSettings> command = {};  ///< that of TestSpec::command
  /// ConditionSpec::steering, in tests with a command.
  std::optional<experiment::HandSteering> steering = {};

  /// The commit of a program: a result that another one measured is to be measured again. Empty: any will do.
  std::string measured_by = {};

  /// Whether the record of a run still needs the test.
  bool is_due(const ledger::Record& record) const;
  /// What a champion of `home` does in the test. Throws UserError if it cannot: a length that is no whole
  /// number of timesteps, a ground or damage that does not fit the robot.
  experiment::Problem problem(experiment::Problem home) const;
  /// Hash of what defines the test for runs that evolve in `home`; a result fits if its hash is the same.
  std::string settings_hash(std::string_view home) const;
};

/// Reads and checks the test of that index. Throws UserError, with its place in the study file: an engine
/// that there is not, a file without what it is named for, trials that would all be the same.
PlannedTest plan_test(const ledger::StudySpec& study, std::size_t index);

}  // namespace amble::study
