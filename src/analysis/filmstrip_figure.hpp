#pragma once

#include <string>
#include <vector>

#include "amble/analysis/layout.hpp"
#include "amble/analysis/motion.hpp"
#include "amble/robot/spec.hpp"

namespace amble::analysis {

/// Poses of a filmstrip.
inline constexpr int filmstrip_poses = 10;

/// Frames at even distances over the last two seconds of walking. Of a robot that fell the last second is
/// left out, if there is enough before it. Fewer frames for a recording that has not as many.
std::vector<int> filmstrip_frames(const Motion& motion);

/// Side views of the robot in those frames, over a ground with marks of the distance along its heading. Legs
/// on the far side are lighter; a foot on the ground is filled. An <svg> element. The motion must have a
/// frame.
std::string filmstrip_figure(const robot::RobotSpec& robot, const Motion& motion, Layout layout);

}  // namespace amble::analysis
