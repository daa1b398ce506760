#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "amble/core/error.hpp"
#include "amble/presentation/shown_trial.hpp"

namespace amble::cli {

/// A page of a run with its figures, which do not move: `amble view --static`.
struct StaticView {
  std::filesystem::path run, out;
  std::optional<std::filesystem::path> figures;  ///< a folder that gets each figure as an SVG file
  std::optional<std::string> engine;             ///< in which the champion is shown
  presentation::TrialChoice disturbance;
};

/// Writes the page. Throws UserError.
ExitCode make_static_view(const StaticView& options);

}  // namespace amble::cli
