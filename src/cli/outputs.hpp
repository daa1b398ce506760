#pragma once

#include <filesystem>
#include <initializer_list>
#include <string_view>
#include <utility>

namespace amble::cli {

/// The path as it is written or, if it exists, as it is found through links.
std::filesystem::path resolved(const std::filesystem::path& path);

/// Before anything is computed: throws UserError for an empty path and for one among a run's own champions.
/// If it leads to the standard output, that is the output's alone from here on.
void prepare_output(const std::filesystem::path& path);

/// prepare_output() and io::check_output().
void check_output(const std::filesystem::path& path, std::string_view beginning, std::string_view what);

/// Before anything is computed: throws UserError unless `option`'s file ends in .svg and check_output() takes
/// it.
void check_drawing(std::string_view option, const std::filesystem::path& path);

/// Throws UserError where two of a command's outputs are one file. Options that were not given have an empty
/// path.
void check_distinct(
    std::initializer_list<std::pair<std::string_view, std::filesystem::path>> options_and_paths);

}  // namespace amble::cli
