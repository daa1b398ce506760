#pragma once

#include <string>

#include "amble/motion/motion.hpp"
#include "amble/robot/spec.hpp"

namespace amble::figures {

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
