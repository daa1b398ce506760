#pragma once

#include <atomic>
#include <filesystem>
#include <optional>
#include <string>

#include "amble/experiment/champion.hpp"
#include "amble/figures/cppn_graph.hpp"
#include "amble/page/replay_page.hpp"

namespace amble::presentation {

/// The CPPN of a champion, with the names that its controller gives to inputs and outputs.
figures::CppnGraph cppn_graph(const experiment::Champion& champion);

/// How a champion walks again; the default of each option is as in its evolution.
struct WalkOptions {
  std::optional<double> seconds = {};
  std::optional<std::string> engine = {};
  std::optional<trial::ScenarioKey> noise = {};  ///< experiment::ReplayOptions::noise
};

/// ", in the engine ode" where that is not the one in which the champion evolved, and ", median trial" under
/// noise; else empty.
std::string engine_note(const experiment::Champion& champion, const WalkOptions& options);

/// Lets a champion walk again and writes its recording to `recording`, which the page reads.
/// `path`: the champion's file, named in the recording. Nothing if `stop` was set. Throws UserError.
std::optional<page::Walker> walk(const experiment::Champion& champion, const std::filesystem::path& path,
                                 const WalkOptions& options, const std::filesystem::path& recording,
                                 const std::atomic<bool>& stop);

/// The same of a genome: `origin` is named in the recording, and the walker has neither title nor CPPN.
std::optional<page::Walker> walk(const experiment::Problem& problem, const neat::Genome& genome,
                                 const std::string& origin, const WalkOptions& options,
                                 const std::filesystem::path& recording, const std::atomic<bool>& stop);

/// What a recording shows, called by its file's name. Throws UserError.
page::Walker recorded(const std::filesystem::path& recording);

/// Program and version, for the foot of pages.
std::string made_by();

}  // namespace amble::presentation
