#pragma once

#include <string>

#include "amble/figures/figure_size.hpp"
#include "amble/motion/motion.hpp"
#include "amble/robot/spec.hpp"

namespace amble::figures {

/// The path of the centre of mass over the ground, seen from above with equal scales, with the footprints,
/// the trunk at start and end, and a scale bar. World x points right in the wide layout, up in the narrow
/// one. An <svg> element. The motion must have a frame.
std::string path_figure(const robot::RobotSpec& robot, const motion::Motion& motion, FigureSize layout);

}  // namespace amble::figures
