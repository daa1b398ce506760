#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <string_view>

#include "amble/experiment/plan/config.hpp"
#include "amble/experiment/plan/progress.hpp"
#include "amble/experiment/problem/problem.hpp"
#include "amble/search/strategies.hpp"
#include "amble/search/strategy.hpp"

namespace amble::experiment {

/// Version of the files that checkpoint_bytes() makes.
inline constexpr std::uint32_t checkpoint_version = 4;
/// Without Progress::csv_digest; can be read.
inline constexpr std::uint32_t undigested_checkpoint_version = 3;

/// What a run searches.
search::SearchSpace space_of(const Config& config, const Problem& problem);

/// A run between two generations: the content of a checkpoint.
struct RunState {
  /// Before the first generation.
  RunState(const Config& config, const Problem& problem);

  Progress progress;
  std::unique_ptr<search::Strategy> strategy;
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
