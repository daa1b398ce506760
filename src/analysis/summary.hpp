#pragma once

#include <vector>

#include "amble/analysis/motion.hpp"

namespace amble::analysis {

/// The head-line numbers of a recording.
struct Summary {
  double distance_m = 0.0;  ///< of the whole-body centre of mass from its start, over the ground
  double seconds = 0.0;     ///< until the time was up or the robot fell
  double mean_speed_m_s = 0.0;
  record::Outcome outcome = record::Outcome::completed;
  std::vector<int> triggers;  ///< per leg; empty without triggers
};

Summary summarise(const Motion& motion);

}  // namespace amble::analysis
