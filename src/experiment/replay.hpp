#pragma once

#include <atomic>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "amble/experiment/champion.hpp"
#include "amble/trial/trial.hpp"

namespace amble::experiment {

/// How a champion is run again; the default of each option is as in its own file.
struct ReplayOptions {
  std::optional<double> seconds = {};
  std::optional<std::string> engine = {};
  std::optional<std::filesystem::path> record = {};  ///< writes a recording (record/recording.hpp)
  std::string origin = {};                           ///< named in the recording
  trial::Observer* observer = nullptr;               ///< not owned; sees motor torques if the engine has them
  bool trace = true;                                 ///< keep a hash per step; off for trials of hours
  std::optional<trial::ScenarioKey> noise = {};      ///< under the problem's noise; nothing: without any
};

struct Replay {
  TrialResult result;
  std::vector<trial::EventCount> events;  ///< of the controller (controllers::Batch::events)
  std::vector<std::uint32_t> trace;       ///< trial::TraceObserver; empty unless ReplayOptions::trace
  double physics_s = 0.0;                 ///< time spent in the engine
};

/// One trial of one genome, without noise unless an option sets it. Nothing if `stop` was set before it ended
/// (then nothing is recorded). Throws UserError.
std::optional<Replay> replay(const Problem& problem, const neat::Genome& genome, const ReplayOptions& options,
                             const std::atomic<bool>& stop);

}  // namespace amble::experiment
