#pragma once

#include <string>

#include "amble/analysis/layout.hpp"
#include "amble/analysis/motion.hpp"
#include "amble/robot/spec.hpp"

namespace amble::analysis {

/// The way of the centre of mass over the ground, seen from above with equal scales, with the places where
/// feet came down, the trunk at start and end, and a scale bar. World x points right in the wide layout, up
/// in the narrow one. An <svg> element. The motion must have a frame.
std::string path_figure(const robot::RobotSpec& robot, const Motion& motion, Layout layout);

}  // namespace amble::analysis
