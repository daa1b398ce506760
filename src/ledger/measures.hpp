#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

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

struct StudySpec;
struct TestSpec;

// Numbers that figures, tests and claims take from a record, by name: train_m, hidden, links, those of maps,
// and TEST.NAME of a test. docs/STUDIES.md lists them and says what each is; the table is in measures.cpp.

/// Whether a study's records have a measure of that name.
bool is_measure(const StudySpec& study, std::string_view name);

/// The test that a measure is of; null for one of runs and maps, and where there is no such test.
const TestSpec* test_of(const StudySpec& study, std::string_view measure);

/// Whether a measure is of what targets do from cycle to cycle (TestSpec::seam), which controllers without
/// timers never give.
bool is_of_seam(std::string_view measure);

/// Whether a measure is of the map that a run fills.
bool is_of_map(std::string_view measure);

/// Whether a measure is a share, 0 … 1 whatever happens.
bool is_share(std::string_view measure);

/// All names that is_measure() can know, for messages: "train_m, hidden, …, TEST.distance_m, .upright_s, …".
std::string measure_names();

/// Names of the measures that every run has: train_m, hidden, links.
std::vector<std::string> measures_of_runs();
/// Names of the measures that a test gives.
std::vector<std::string> measures_of(const TestSpec& test);
/// Those of them in which all pairs of conditions are compared.
std::vector<std::string> compared_measures_of_runs();
std::vector<std::string> compared_measures_of(const TestSpec& test);

/// Nothing if the record has no such test, or the test no such measure.
std::optional<double> measure(const Record& record, std::string_view name);

/// "distance in evolution, m"; for axes and tables.
std::string measure_label(std::string_view name);
/// " m", " s" or "", where champions were chosen by this objective.
std::string measure_unit(std::string_view name, const record::Objective& objective);

}  // namespace amble::ledger
