#pragma once

#include <filesystem>
#include <vector>

#include "amble/page/lab_page.hpp"

namespace amble::presentation {

/// The robots of some configs for the lab, each with the controllers that the lab offers: those of a config,
/// and in its world those of configs/quick below `data`. They walk in the engine `batch`. Throws UserError.
std::vector<page::LabRobot> lab_robots(const std::vector<std::filesystem::path>& configs,
                                       const std::filesystem::path& data);

/// The gallery's: the paper's quadruped and all of robots/ below `data` that have a config.
std::vector<std::filesystem::path> gallery_configs(const std::filesystem::path& data);

}  // namespace amble::presentation
