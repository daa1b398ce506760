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

/// How a champion is run again; by default as in its file, undisturbed and with a trace.
struct ReplayOptions {
  std::optional<double> seconds = {};                ///< length of the trial, a whole number of timesteps
  std::optional<std::string> engine = {};            ///< one of physics::engine_names()
  std::optional<std::filesystem::path> record = {};  ///< writes a recording (record/recording.hpp)
  std::string origin = {};                           ///< named in the recording
  trial::Observer* observer = nullptr;               ///< not owned; sees motor torques if the engine has them
  bool trace = true;                                 ///< keep a hash per step; off for trials of hours
  std::optional<trial::ScenarioKey> noise = {};      ///< under the problem's noise; nothing: without any
};

/// What came of it.
struct Replay {
  TrialResult result;                     ///< how far it walked, and how the trial ended
  std::vector<trial::EventCount> events;  ///< the controller's (controllers::Batch::events)
  std::vector<std::uint32_t> trace;       ///< trial::TraceObserver; empty unless ReplayOptions::trace
  double physics_s = 0.0;                 ///< wall time spent in the engine
};

/// One trial of one genome, without noise unless an option sets it. Nothing if `stop` was set before it ended
/// (then nothing is recorded). `genome` must be valid for the problem (neat::validate). Throws UserError for
/// options that do not fit the problem, and if the recording cannot be written.
std::optional<Replay> replay(const Problem& problem, const neat::Genome& genome, const ReplayOptions& options,
                             const std::atomic<bool>& stop);

}  // namespace amble::experiment
