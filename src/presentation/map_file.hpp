#pragma once

#include <atomic>
#include <cstddef>
#include <filesystem>
#include <optional>

#include "amble/experiment/repertoire.hpp"

namespace amble::presentation {

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
