#pragma once

#include <string>
#include <string_view>

#include "amble/figures/figure_size.hpp"
#include "amble/motion/motion.hpp"
#include "amble/robot/spec.hpp"

namespace amble::figures {

/// Poses of a robot in the figure, at most: evenly spaced in time, the first at the start, the last at the
/// end.
inline constexpr int steering_poses = 7;

/// What a robot was told beside what it did: both paths from above with the robot at several times, along the
/// width whichever way they go, and below them speed and turn over time, those that it did as means over a
/// second. `note` is a line of text below. An <svg> element. The motion must have a frame, and commands.
std::string steering_figure(const robot::RobotSpec& robot, const motion::Motion& motion,
                            std::string_view note, FigureSize layout);

/// The wide one as a file of its own, with its style sheet.
std::string steering_svg(const robot::RobotSpec& robot, const motion::Motion& motion, std::string_view note);

}  // namespace amble::figures
