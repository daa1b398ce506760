#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "amble/ledger/record.hpp"
#include "amble/record/objective.hpp"

namespace amble::ledger {

struct StudySpec;
struct TestSpec;

/// What the champion of a run was chosen by: what train_m, its curve and `map_best` are.
/// By the champion in the record. Throws UserError if its score cannot be read.
record::Objective objective_of(const Record& record);

/// Numbers that figures, tests and claims take from a record, by name:
///
/// train_m            objective of the champion in evolution: its distance, m, or its score
/// hidden, links      hidden nodes and enabled links of its CPPN
/// coverage, qd_score, map_best, entering_share    of runs that fill a map (Record::map_figures)
/// corrected_coverage, corrected_qd_score, staying_share    likewise, in studies with `map_trials`
/// TEST.distance_m    in the test of that name (median of its episodes), m
/// TEST.upright_s     until the robot fell or the test ended, s
/// TEST.walking_s     until it fell, stopped (score/walking.hpp) or the test ended, s
/// TEST.moving_s      in motion, also after pauses (TestResult::moving_s), s; of trials of 10 s or more
/// TEST.kept          distance in the test / distance in evolution; none if the objective is another
///
/// and of a test with several episodes:
///
/// TEST.lower_quartile_m, TEST.upper_quartile_m, TEST.best_m    of their distances, m
/// TEST.fell_share    share of them in which the robot fell, or its simulation diverged
///
/// and of a test that looks for the first best that gets as far as `reach_m`; infinite if none does:
///
/// TEST.reached_s           wall time of the evolution until then, s
/// TEST.reached_generation  its generation
/// TEST.reached_evaluations evaluations until then
///
/// and of a test with `mutants`:
///
/// TEST.viable_share    share of the mutants that are viable (record::Mutant::viable)
/// TEST.mutants_kept    share of the champion's score that a mutant keeps, the median
/// TEST.gait_change     change of the gait of the viable mutants, the mean; 0 if there is none
///
/// Whether a study's records have a measure of that name.
bool is_measure(const StudySpec& study, std::string_view name);

/// All names that is_measure() can know, for messages: "train_m, hidden, …, TEST.distance_m, .upright_s, …".
std::string measure_names();

/// Names of the measures that a test gives.
std::vector<std::string> measures_of(const TestSpec& test);
/// Those of them in which conditions are compared pair by pair: distance_m, viable_share, gait_change.
std::vector<std::string> compared_measures_of(const TestSpec& test);

/// Nothing if the record has no such test, or the test no such measure.
std::optional<double> measure(const Record& record, std::string_view name);

/// "distance in evolution, m"; for axes and tables.
std::string measure_label(std::string_view name);
/// " m", " s" or "", where champions were chosen by this objective.
std::string measure_unit(std::string_view name, const record::Objective& objective);

}  // namespace amble::ledger
