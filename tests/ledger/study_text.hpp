#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <string>

#include "amble/core/error.hpp"
#include "amble/io/file.hpp"
#include "amble/ledger/study_spec.hpp"
#include "tests/io/temporary_folder.hpp"

namespace amble::ledger {

/// A study of two conditions, a test and a claim.
inline constexpr const char* good = R"(name = "s"
seeds = [1, 2]
[[conditions]]
name = "a"
config = "a.toml"
[[conditions]]
name = "b"
config = "../b.toml"
seeds = [5]
[[tests]]
name = "five"
seconds = 300
[[claims]]
text = "A beats B."
kind = "difference"
condition = "a"
against = "b"
measure = "five.distance_m"
)";

/// The diagnostic for a study with this text; empty if it is accepted.
inline std::string diagnostic(const std::string& text) {
  const test::TemporaryFolder folder;
  io::write_file(folder.path() / "s.toml", text);
  try {
    load_study(folder.path() / "s.toml");
    return {};
  } catch (const UserError& error) {
    EXPECT_EQ(error.code(), ExitCode::bad_input);
    return std::filesystem::path(error.what()).filename().string();
  }
}

inline std::string replaced(std::string text, const std::string& old, const std::string& now) {
  return text.replace(text.find(old), old.size(), now);
}

inline const std::string all_measures =
    "train_m, hidden, links, coverage, qd_score, map_best, entering_share, with map_trials "
    "corrected_coverage, corrected_qd_score, staying_share, TEST.distance_m, .upright_s, "
    ".walking_s, .moving_s, .kept, with episodes .lower_quartile_m, .upper_quartile_m, .best_m, .fell_share, "
    "with reach_m .reached_s, .reached_generation, .reached_evaluations, with mutants .viable_share, "
    ".mutants_kept, .gait_change, with command .tracking, .speed_error, .turn_error, .switch_s, "
    "with score .score, with energy .cost_of_transport, with seam .jumps, .jump_rad, .jump_power_w";

}  // namespace amble::ledger
