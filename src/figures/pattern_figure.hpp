#pragma once

#include <string>

#include "amble/figures/figure_size.hpp"
#include "amble/motion/motion.hpp"
#include "amble/motion/recorded_trial.hpp"
#include "amble/robot/spec.hpp"

namespace amble::figures {

/// The temporal patterns of a SUPG: a row per joint type, a column per leg, target angle over the timer, with
/// the joint's range and the leg's offset; in the last row a histogram of the timer just before triggers
/// reset it. An <svg> element.
std::string pattern_figure(const robot::RobotSpec& robot, const motion::SupgPatterns& supg,
                           const motion::Motion& motion, FigureSize layout);

/// The patterns alone, without a trial, as a file of its own with its style sheet.
std::string pattern_svg(const robot::RobotSpec& robot, const motion::SupgPatterns& supg);

}  // namespace amble::figures
