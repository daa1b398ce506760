#pragma once

#include <filesystem>

#include "amble/experiment/problem.hpp"
#include "amble/experiment/problem/champion.hpp"

namespace amble::experiment {

/// The champion of a file, ready to walk again: replay.hpp. Throws UserError: the file cannot be read
/// (ExitCode::io); it is no champion, altered, truncated or of another version, or names a controller or an
/// engine that this program does not have (ExitCode::bad_file).
Champion load_champion(const std::filesystem::path& path);

}  // namespace amble::experiment
