#pragma once

#include <atomic>
#include <string>
#include <vector>

#include "amble/experiment/problem.hpp"
#include "amble/neat/genome.hpp"

namespace amble::exporting {

/// What a controller sensed and what it output, tick by tick, in a trial without noise. Float32, as the
/// controller itself reads and writes them.
struct Trace {
  struct Tick {
    std::vector<float> angle_rad;                         ///< by joint, in control order
    std::vector<float> touch;                             ///< by leg, 0 or 1
    std::vector<float> attitude_rad;                      ///< roll, pitch, yaw of the root
    std::vector<float> speed_rad_s = {}, torque_nm = {};  ///< by joint; empty where they are not asked for
    std::vector<float> load_n = {};                       ///< by leg, likewise
    std::vector<float> yaw_rate_rad_s = {};               ///< one, or none likewise
    std::vector<float> command = {};                      ///< speed and turn, likewise
    std::vector<float> heading_error_rad = {};            ///< one, or none likewise
    std::vector<float> target_rad;                        ///< by joint
    std::vector<float> state;                             ///< by state name, after the tick
  };

  std::vector<std::string> state_names;  ///< controllers::Batch::state_names
  std::vector<Tick> ticks;               ///< from the controller's first tick on
};

/// Runs the genome in the problem's engine for that many ticks, or until it falls. Throws
/// UserError(ExitCode::interrupted) if `stop` was set before the end.
Trace record_trace(const experiment::Problem& problem, const neat::Genome& genome, int ticks,
                   const std::atomic<bool>& stop);

}  // namespace amble::exporting
