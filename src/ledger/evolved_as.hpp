#pragma once

#include <optional>
#include <string>

#include "amble/ledger/record.hpp"
#include "amble/record/objective.hpp"

namespace amble::ledger {

// How a champion was evolved, as its file in the record says (Record::champion, docs/FORMATS.md). Nothing
// else reads that file but what runs the champion again.

/// What it was chosen by: what train_m, its curve and `map_best` are. Throws UserError if its score cannot be
/// read.
record::Objective objective_of(const Record& record);

/// Tells scores apart; empty for the distance.
std::string score_of(const Record& record);

/// Length of its trials, s; none if the file does not say.
std::optional<double> evolution_trial_s(const Record& record);

/// Whether it was evolved without noise and on the plane.
bool evolved_undisturbed(const Record& record);

}  // namespace amble::ledger
