#pragma once

#include <string>
#include <vector>

#include "amble/report/report.hpp"

namespace amble::report {

/// A study with these conditions, `seeds` runs each of 10 generations; no tests, no claims.
ledger::StudySpec sample_study(const std::vector<std::string>& conditions, int seeds);

/// A finished run of it: distance in evolution, no tests.
ledger::Record sample_run(const std::string& condition, std::int64_t seed, double best_m);

/// Adds a result of one trial to a run.
void add_test(ledger::Record& run, const std::string& test, double distance_m, double trial_s = 300.0,
              double upright_s = 300.0, double walking_s = 300.0, const std::string& gait = "trot",
              const std::string& engine = "batch");

/// Runs of one condition with seeds 1, 2, … and these distances in evolution, appended in the order of the
/// study.
void add_runs(StudyData& data, const std::string& condition, const std::vector<double>& best_m);

/// Two conditions "a" and "b" with tests "long" (300 s, batch) and "ode" (15 s), three runs each, and a claim
/// of every kind.
StudyData small_study();

/// The same, evolved by a score that has one term.
StudyData scored_study(const std::string& quantity);

/// The first with six mutants of each champion in the test "long".
StudyData mutated_study();

/// `count` conditions of `runs` runs, pseudo-random distances and lifetimes, the same tests.
StudyData large_study(int count, int runs);

}  // namespace amble::report
