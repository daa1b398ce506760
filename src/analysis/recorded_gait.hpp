#pragma once

#include <filesystem>
#include <optional>

#include "amble/analysis/gait.hpp"

namespace amble::analysis {

/// The gait of a recording, of its first `seconds` if given. Read frame by frame, so it may be hours long.
/// Torques count if they were recorded. Throws UserError as read_recorded() does; what follows a frame that
/// is not finite is left out.
GaitReport recorded_gait(const std::filesystem::path& path, const GaitSettings& settings,
                         std::optional<double> seconds = std::nullopt);

}  // namespace amble::analysis
