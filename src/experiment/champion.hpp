#pragma once

#include <filesystem>

#include "amble/experiment/problem.hpp"
#include "amble/experiment/problem/champion.hpp"

namespace amble::experiment {

/// The champion of a file. Throws UserError as parse_champion() does, and if the file cannot be read.
Champion load_champion(const std::filesystem::path& path);

}  // namespace amble::experiment
