#pragma once

#include <filesystem>

#include "amble/cli/live_server.hpp"
#include "amble/core/error.hpp"

namespace amble::cli {

/// `amble view --live FOLDER`: serves a page of the runs in it until a stop signal, and says on the standard
/// error when one ends, vanishes, or goes on. Throws UserError.
ExitCode make_live_view(const std::filesystem::path& folder, const LiveOptions& options);

}  // namespace amble::cli
