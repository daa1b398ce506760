#pragma once

#include <string>

#include "amble/analysis/layout.hpp"
#include "amble/analysis/motion.hpp"
#include "amble/analysis/supg.hpp"
#include "amble/robot/spec.hpp"

namespace amble::analysis {

/// The temporal patterns of a SUPG: a row per joint type, a column per leg, target angle over the timer, with
/// the joint's range and the place where the leg's timer starts; in the last row how far the timer had come
/// when triggers reset it. An <svg> element.
std::string pattern_figure(const robot::RobotSpec& robot, const Supg& supg, const Motion& motion,
                           Layout layout);

/// The patterns alone, without a trial, as a file of its own with its style sheet.
std::string pattern_svg(const robot::RobotSpec& robot, const Supg& supg);

}  // namespace amble::analysis
