#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>

#include "amble/experiment/corrected_map.hpp"
#include "amble/experiment/repertoire.hpp"
#include "amble/figures/map_figure.hpp"
#include "amble/io/file.hpp"
#include "amble/page/replay_page.hpp"

namespace amble::presentation {

/// The map of a grid archive for figures, with what its elites do in new trials if there were any. Throws
/// UserError for a map of centroids.
figures::GridMap map_picture(const experiment::Repertoire& repertoire,
                             const std::optional<experiment::CorrectedMap>& corrected = {});

/// A page with the map of a run, in which up to `walkers` cells can be chosen and then walk: the best first,
/// then cells spread evenly over the map. `run`: its folder, for the recordings' origin.
/// Nothing if `stop` was set. Throws UserError: an empty map, one of centroids.
std::optional<std::string> map_page(const experiment::Repertoire& repertoire,
                                    const std::optional<experiment::CorrectedMap>& corrected,
                                    const std::filesystem::path& run, std::size_t walkers,
                                    const std::atomic<bool>& stop);

/// A page that shows elites of a map by their cells; its `walkers` are still to come.
page::ReplayPage blank_map_page(const experiment::Repertoire& repertoire, const std::string& title,
                                const std::string& note,
                                const std::optional<experiment::CorrectedMap>& corrected = {});

/// The elite of a cell that has one, in a trial of `problem` without noise. Nothing if `stop` was set.
std::optional<page::Walker> elite_walker(const experiment::Repertoire& repertoire,
                                         const experiment::Problem& problem, std::uint32_t cell,
                                         const std::string& title, const std::filesystem::path& run,
                                         const io::ScratchFile& recording, const std::atomic<bool>& stop);

struct MapFileOptions {
  /// New trials of each elite, whose outcome the file tells; nothing: 20 where the map was made under noise,
  /// else none. Not for .json.
  std::optional<int> trials = {};
  std::size_t walkers = 200;  ///< cells at most that can be chosen in a page
  int jobs = 1;               ///< the file does not depend on it
};

/// Writes the map of a run to `out`, by its extension: .html (a page in which elites walk), .svg (a picture),
/// .csv (a table of elites) or .json (all of it). `run`: its folder. False if `stop` was set; then nothing is
/// written. Throws UserError: another extension; a file there that is not of this kind; an empty map, or one
/// of centroids, as page or picture.
bool write_map_file(const experiment::Repertoire& repertoire, const std::filesystem::path& run,
                    const std::filesystem::path& out, const MapFileOptions& options,
                    const std::atomic<bool>& stop);

}  // namespace amble::presentation
