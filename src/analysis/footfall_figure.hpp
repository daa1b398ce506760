#pragma once

#include <string>

#include "amble/analysis/layout.hpp"
#include "amble/analysis/motion.hpp"
#include "amble/robot/spec.hpp"

namespace amble::analysis {

/// Footfall diagram (Hildebrand 1965): a row per leg, a bar while its foot is on the ground, a mark at each
/// trigger; of the whole recording and, if it is long enough, of its last seconds enlarged. An <svg> element.
/// The motion must have a frame.
std::string footfall_figure(const robot::RobotSpec& robot, const Motion& motion, Layout layout);

}  // namespace amble::analysis
