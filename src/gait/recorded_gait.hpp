#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "amble/gait/report.hpp"
#include "amble/record/recording.hpp"

namespace amble::gait {

/// The gait of a recording, or of its first `seconds`. Reads frame by frame, so it may be hours long. Work is
/// measured if torques were recorded. Frames from the first that is not finite on are left out. Throws
/// UserError as motion::read_recorded_trial() does, where `seconds` is no whole number of frames,
/// and where a trial that was completed is shorter.
Report recorded_gait(const std::filesystem::path& path, const Settings& settings,
                     std::optional<double> seconds = std::nullopt);
/// The same from a reader that stands at the beginning; `what` names the recording in errors.
Report recorded_gait(record::RecordingReader& reader, const std::string& what, const Settings& settings,
                     std::optional<double> seconds = std::nullopt);

}  // namespace amble::gait
