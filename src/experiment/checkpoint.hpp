#pragma once

#include <filesystem>
#include <vector>

#include "amble/experiment/plan/checkpoint.hpp"

namespace amble::experiment {

/// Writes checkpoint_bytes(), atomically.
void save_checkpoint(const std::filesystem::path& path, const Config& config, const Progress& progress,
                     const search::Strategy& strategy);

/// Temporary files (io::AtomicFile), complete or not, of a process that was killed before it renamed one to
/// `path`.
std::vector<std::filesystem::path> unnamed_checkpoints(const std::filesystem::path& path);

/// Restores what save_checkpoint wrote. Throws UserError(ExitCode::bad_file): foreign, of another version,
/// truncated, altered, or written under another config than this (the number of generations may differ).
Progress load_checkpoint(const std::filesystem::path& path, const Config& config, search::Strategy& strategy);

}  // namespace amble::experiment
