#pragma once

#include <cstdint>
#include <string>

#include "amble/experiment/run_folder.hpp"

namespace amble::watch {

/// The text of the champion's file of the elite in a cell of a run's map, as `amble repertoire --cell` makes
/// it: its trials are simulated here, by one thread. Empty if the run fills no map, the cell is empty or not
/// there, or the files are just being replaced.
std::string elite_text(const experiment::RunPaths& paths, std::uint32_t cell);

}  // namespace amble::watch
