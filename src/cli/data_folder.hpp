#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace amble::cli {

/// Where robots/ and configs/ are: in the source tree or the installation that this program is part of, or
/// below the current folder.
std::optional<std::filesystem::path> data_folder();

/// The words of a command, in which files below configs/ and robots/ that are not there are those of the
/// data folder, so that what the docs say holds wherever the program was installed; a note says so. What is
/// written (-o, --csv, …) is left as it is.
std::vector<std::string> with_own_files(std::vector<std::string> words);

/// The config that that of a new robot extends.
std::optional<std::filesystem::path> preset_of_robots();

}  // namespace amble::cli
