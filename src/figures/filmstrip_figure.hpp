#pragma once

#include <string>
#include <vector>

#include "amble/figures/figure_size.hpp"
#include "amble/motion/motion.hpp"
#include "amble/robot/spec.hpp"

namespace amble::figures {

/// Most poses of a filmstrip.
inline constexpr int filmstrip_poses = 10;

/// Evenly spaced frames over the last two seconds of walking. If the robot fell, the last second is left out
/// as far as the recording is long enough. Fewer than filmstrip_poses if the recording has fewer frames.
std::vector<int> filmstrip_frames(const motion::Motion& motion);

/// Side views of the robot in those frames, over a ground with marks of the distance along its heading. Legs
/// on the far side are lighter; a foot on the ground is filled. An <svg> element. The motion must have a
/// frame.
std::string filmstrip_figure(const robot::RobotSpec& robot, const motion::Motion& motion, FigureSize layout);

/// Pictures in a second, where the motion has as many frames.
inline constexpr double most_pictures_per_s = 20.0;

/// The robot from the side while it walks, over a ground that passes by: the time of the filmstrip, as fast
/// as it was, again and again. An <svg> element, whose pictures are groups "picture p0", "picture p1", …;
/// animation_style() shows one after the other. The motion must have a frame.
std::string walk_animation(const robot::RobotSpec& robot, const motion::Motion& motion);

/// The rules that an element by walk_animation() needs: CSS animations. Whoever wants no motion sees one
/// pose.
std::string animation_style(const motion::Motion& motion);

}  // namespace amble::figures
