#pragma once

#include <vector>

#include "amble/core/lanes.hpp"
#include "amble/robot/spec.hpp"

namespace amble::bench {

/// Sixteen SUPGs of the authors' robot, evolved for a short time from fixed seeds, and their targets.
struct Walkers {
  robot::RobotSpec robot;
  std::vector<LaneArray> targets_rad;  ///< by step: joints × 16
  double mean_contacts = 0.0;          ///< points of one robot that touch the ground
};

constexpr int walker_count = 16;

Walkers evolve_walkers(int steps);

/// Fused multiply-adds that depend on nothing but their own sum: FLOP per second of one core.
double peak_flop_per_s();

}  // namespace amble::bench
