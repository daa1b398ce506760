#pragma once

#include <vector>

#include "amble/morphology/model_parts.hpp"
#include "amble/robot/pose.hpp"

namespace amble::morphology {

/// How far a foot is tilted against its start pose, to find which of its shapes can be the first to touch.
inline constexpr double foot_tilt_rad = 0.35;
/// A body whose joint is nearer to the ground than this share of its leg's length is all foot.
inline constexpr double foot_share = 0.3;

/// The shapes of a leg's foot, the lowest first: of those that move as one with it, no motor being between,
///  - those that are the first to touch if the foot is tilted by up to foot_tilt_rad in any direction;
///  - all of a link that is welded on and has one of these;
///  - all, if their last joint with a motor is near the ground (foot_share): an ankle.
/// Beside these, where a foot has toes that a motor moves: what stands on the ground as they do of the links
/// above, as far as their joints are that near to the ground.
/// So a shank that ends in a ball or two has these as its foot, and not its own shape.
/// `lowest`: the lowest geom of the leg that collides; `joints`: those of the leg with motors, from the trunk
/// outwards; `poses`: of the bodies at the start.
std::vector<int> foot_shapes(const ModelParts& parts, const std::vector<robot::Pose>& poses,
                             const std::vector<int>& joints, int lowest);

/// The mean of the centres of a foot's shapes, in the world.
Vec3 foot_centre_m(const ModelParts& parts, const std::vector<int>& shapes,
                   const std::vector<robot::Pose>& poses);

}  // namespace amble::morphology
