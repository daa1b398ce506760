#pragma once

#include <filesystem>

#include "amble/experiment/problem.hpp"
#include "amble/experiment/problem/champion.hpp"

namespace amble::experiment {

/// The champion of a file, ready to walk again: replay.hpp. Throws UserError: the file cannot be read, is
/// altered, truncated or of another version (ExitCode::bad_file), or names a controller or an engine that
/// this program does not have.
Champion load_champion(const std::filesystem::path& path);

}  // namespace amble::experiment
