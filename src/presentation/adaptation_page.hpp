#pragma once

#include <atomic>
#include <filesystem>
#include <optional>
#include <string>

#include "amble/experiment/adapt.hpp"

namespace amble::presentation {

/// A page with the map, the trials as a table, and the elites that were tried, on the damaged robot in trials
/// without noise; the one found first. `damage`: as it was asked for; `run`: the map's folder. Nothing if
/// `stop` was set. Throws UserError for a map of centroids.
std::optional<std::string> adaptation_page(const experiment::Adaptation& adaptation,
                                           const experiment::Repertoire& repertoire,
                                           const experiment::AdaptSettings& settings,
                                           const std::string& damage, const std::filesystem::path& run,
                                           const std::atomic<bool>& stop);

}  // namespace amble::presentation
