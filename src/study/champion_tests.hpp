#pragma once

#include <atomic>
#include <optional>
#include <vector>

#include "amble/experiment/champion.hpp"
#include "amble/experiment/run_folder.hpp"
#include "amble/io/json_file.hpp"
#include "amble/ledger/record.hpp"
#include "amble/neat/settings.hpp"
#include "amble/study/plan.hpp"

namespace amble::study {

/// Runs a test of a champion. Nothing if `stop` was set before it was done. Throws UserError.
std::optional<ledger::TestResult> run_test(const PlannedTest& test, const experiment::Champion& champion,
                                           const std::atomic<bool>& stop);

/// Adds TestSpec::mutants mutants of a champion, which mutate as in a run with these settings of NEAT, tried
/// in the same trials as the champion by run_test(). False if `stop` was set before it was done. Throws
/// UserError.
bool add_mutants(const PlannedTest& test, const experiment::Champion& champion, const neat::Settings& neat,
                 ledger::TestResult& result, const std::atomic<bool>& stop);

/// The first of a run's successive bests whose median trial in `test` gets as far as its `reach_m`.
struct FirstReach {
  std::optional<ledger::Reached> reached;  ///< nothing: none does
  double wall_s = 0.0;  ///< of the evolution until then, over all processes that worked on it
};
/// Tries the champions of a run folder in the order in which they were found. Nothing if `stop` was set
/// before it was done. Throws UserError.
std::optional<FirstReach> first_to_reach(const PlannedTest& test, const experiment::RunPaths& run,
                                         const std::atomic<bool>& stop);

/// A champion as in records: its file's document without traces; and back.
io::Json champion_to_json(experiment::Champion champion);
/// Throws UserError naming `what`.
experiment::Champion champion_from_json(const io::Json& json, const std::string& what);

}  // namespace amble::study
