#pragma once

#include <cstdint>
#include <string>

#include "amble/ledger/record.hpp"

namespace amble::ledger {

/// A record with a curve, two tests and a small document in place of a champion.
inline Record sample_record(const std::string& condition = "supg", std::int64_t seed = 7) {
  Record record{.study = "sample",
                .condition = condition,
                .seed = seed,
                .config = "00ff",
                .generations = 10,
                .engine = "batch",
                .evaluations = 3000,
                .steps = 4'500'000,
                .best_objective = 4.25,
                .best_generation = 8,
                .hidden = 3,
                .links = 21,
                .curve = {{0, 1.5}, {3, 2.0}, {8, 4.25}},
                .champion = {{"genome", "here"}},
                .champion_file = "abcd",
                .tests = {},
                .provenance = {}};
  record.provenance.version = "0.1.0";
  record.provenance.finished_utc = "2026-01-01T00:00:00Z";
  record.provenance.evolution_s = 70.5;
  record.tests.push_back({.name = "five",
                          .settings = "11",
                          .engine = "batch",
                          .trial_s = 300.0,
                          .episodes = {{12.5, 300.0, 250.0, record::Outcome::completed}},
                          .gait = "trot",
                          .path_interval_s = 1.0,
                          .path_m = {0.1, 0.0, 0.2, -0.05}});
  record.tests.push_back({.name = "noisy",
                          .settings = "12",
                          .engine = "ode",
                          .trial_s = 15.0,
                          .episodes = {{1.0, 3.0, 2.0, record::Outcome::fell},
                                       {5.0, 15.0, 15.0, record::Outcome::completed},
                                       {3.0, 9.0, 9.0, record::Outcome::diverged}},
                          .gait = "",
                          .path_interval_s = 1.0,
                          .path_m = {}});
  return record;
}

}  // namespace amble::ledger
