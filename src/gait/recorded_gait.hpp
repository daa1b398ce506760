#pragma once

#include <filesystem>
#include <optional>

#include "amble/gait/report.hpp"

namespace amble::gait {

/// The gait of a recording, or of its first `seconds`. Reads frame by frame, so it may be hours long. Work is
/// measured if torques were recorded. Frames from the first that is not finite on are left out. Throws
/// UserError as motion::read_recorded_trial() does.
Report recorded_gait(const std::filesystem::path& path, const Settings& settings,
                     std::optional<double> seconds = std::nullopt);

}  // namespace amble::gait
