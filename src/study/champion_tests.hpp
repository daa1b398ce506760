#pragma once

#include <atomic>
#include <optional>
#include <vector>

#include "amble/experiment/champion.hpp"
#include "amble/ledger/record.hpp"
#include "amble/study/plan.hpp"

namespace amble::study {

/// Runs a test of a champion. Nothing if `stop` was set before it was done. Throws UserError.
std::optional<ledger::TestResult> run_test(const PlannedTest& test, const experiment::Champion& champion,
                                           const std::atomic<bool>& stop);

/// A champion as in records: its file's document without traces; and back.
io::Json champion_to_json(experiment::Champion champion);
/// Throws UserError naming `what`.
experiment::Champion champion_from_json(const io::Json& json, const std::string& what);

}  // namespace amble::study
