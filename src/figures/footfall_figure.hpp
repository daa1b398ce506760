#pragma once

#include <string>

#include "amble/figures/figure_size.hpp"
#include "amble/motion/motion.hpp"
#include "amble/robot/spec.hpp"

namespace amble::figures {

/// Footfall diagram (Hildebrand 1965): a row per leg, a bar while its foot is on the ground, a mark at each
/// trigger; for the whole recording and, if it is long enough, enlarged for its last seconds. An <svg>
/// element. The motion must have a frame.
std::string footfall_figure(const robot::RobotSpec& robot, const motion::Motion& motion, FigureSize layout);

}  // namespace amble::figures
