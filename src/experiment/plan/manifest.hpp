#pragma once

#include <string>
#include <string_view>

#include "amble/experiment/plan/config.hpp"
#include "amble/io/json_file.hpp"

namespace amble::experiment {

inline constexpr std::string_view manifest_format = "amble-manifest";
/// The version of the run folder as a whole: raised whenever an older program's run could not go on here.
inline constexpr int run_version = 6;

/// The text of a run folder's manifest.json: which processes have worked on the run.
std::string manifest_text(const Config& config, const io::Json& processes);

}  // namespace amble::experiment
