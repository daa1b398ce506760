#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "amble/experiment/plan/config.hpp"
#include "amble/score/typical.hpp"
#include "amble/search/strategy.hpp"

namespace amble::experiment {

inline constexpr std::uint32_t checkpoint_version = 4;
/// Without Progress::csv_digest; can be read.
inline constexpr std::uint32_t undigested_checkpoint_version = 3;

/// Progress of a run.
struct Progress {
  double best = -1.0;  ///< objective of the champion; −1 before the first generation
  int best_generation = -1;
  /// What the champion typically does (objective, running_trials trials); not in checkpoints, as it follows
  /// from the champion. Nothing before the first generation.
  std::optional<score::Typical> typical = {};
  std::uint64_t evaluations = 0;
  std::uint64_t steps = 0;
  double wall_s = 0.0;           ///< over all processes that worked on the run
  std::uint64_t csv_bytes = 0;   ///< length of generations.csv
  std::uint64_t csv_digest = 0;  ///< table_digest() of it; 0: not known
};

/// All state that a run needs to continue, to the bit, as the bytes of a file.
std::string checkpoint_bytes(const Config& config, const Progress& progress,
                             const search::Strategy& strategy);
/// Restores what checkpoint_bytes() gave; `what` names the file. Throws UserError(ExitCode::bad_file):
/// foreign, of another version, truncated, altered, or written under another config than this (the number of
/// generations may differ).
Progress parse_checkpoint(std::string_view bytes, const std::string& what, const Config& config,
                          search::Strategy& strategy);

/// The part of parse_checkpoint after the seal and the config's hash.
Progress load_progress(std::string_view payload, const std::string& what, search::Strategy& strategy,
                       std::uint32_t version = checkpoint_version);

}  // namespace amble::experiment
