#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>

#include "amble/core/error.hpp"
#include "amble/experiment/corrected_map.hpp"
#include "amble/experiment/repertoire.hpp"
#include "amble/figures/map_figure.hpp"
#include "amble/io/scratch_file.hpp"
#include "amble/view/page.hpp"

namespace amble::cli {

/// The map of a grid archive for figures, with what its elites do in new trials if there were any. Throws
/// UserError for a map of centroids.
figures::GridMap map_picture(const experiment::Repertoire& repertoire,
                             const std::optional<experiment::CorrectedMap>& corrected = {});

/// A page that shows elites of a map by their cells; its `walkers` are still to come.
view::ReplayPage map_page(const experiment::Repertoire& repertoire, const std::string& title,
                          const std::string& note,
                          const std::optional<experiment::CorrectedMap>& corrected = {});

/// The elite of a cell that has one, in a trial of `problem` without noise. Nothing if a signal came.
std::optional<view::Walker> elite_walker(const experiment::Repertoire& repertoire,
                                         const experiment::Problem& problem, std::uint32_t cell,
                                         const std::string& title, const std::filesystem::path& run,
                                         const io::ScratchFile& recording);

/// Writes a page with the map of a run, in which up to `walkers` cells can be chosen and then walk: the best
/// first, then cells spread evenly over the map. ExitCode::interrupted if a signal came. Throws UserError.
ExitCode write_map_page(const experiment::Repertoire& repertoire,
                        const std::optional<experiment::CorrectedMap>& corrected,
                        const std::filesystem::path& run, int walkers, const std::filesystem::path& out);

}  // namespace amble::cli
