#pragma once

#include <filesystem>
#include <optional>

namespace amble::cli {

/// Where robots/ and configs/ are: in the source tree or the installation that this program is part of, or
/// below the current folder.
std::optional<std::filesystem::path> data_folder();

/// The config that that of a new robot extends.
std::optional<std::filesystem::path> preset_of_robots();

}  // namespace amble::cli
