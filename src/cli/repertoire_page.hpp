#pragma once

#include <filesystem>

#include "amble/core/error.hpp"
#include "amble/experiment/repertoire.hpp"
#include "amble/figures/map_figure.hpp"

namespace amble::cli {

/// The map of a grid archive for figures. Throws UserError for a map of centroids.
figures::GridMap map_picture(const experiment::Repertoire& repertoire);

/// Writes a page with the map of a run, in which up to `walkers` cells can be chosen and then walk: the best
/// first, then cells spread evenly over the map. ExitCode::interrupted if a signal came. Throws UserError.
ExitCode write_map_page(const experiment::Repertoire& repertoire, const std::filesystem::path& run,
                        int walkers, const std::filesystem::path& out);

}  // namespace amble::cli
