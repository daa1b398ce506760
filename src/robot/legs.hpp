#pragma once

#include <span>
#include <vector>

#include "amble/core/math.hpp"
#include "amble/robot/pose.hpp"
#include "amble/robot/spec.hpp"

namespace amble::robot {

/// The joint of a leg that is nearest to the root, as an index into RobotSpec::joints; −1: the leg has none.
int hip_joint(const RobotSpec& robot, const Leg& leg);

/// Where each leg is attached, in the world: the anchor of its hip joint with the bodies at `poses`; the
/// centre of its foot if it has no joint.
std::vector<Vec3> hips_m(const RobotSpec& robot, std::span<const Pose> poses);
/// Centre of a leg's foot: the mean of those of its shapes.
Vec3 foot_m(const RobotSpec& robot, const Leg& leg, std::span<const Pose> poses);
/// Height over the ground (negative: depth) of the lowest point of a leg's foot.
double foot_bottom_m(const RobotSpec& robot, const Leg& leg, std::span<const Pose> poses);
/// Centres of the feet, leg by leg.
std::vector<Vec3> feet_m(const RobotSpec& robot, std::span<const Pose> poses);

/// How far a leg reaches with all joints stretched: from its hip joint from joint to joint to the centre of
/// its foot, m.
double leg_length_m(const RobotSpec& robot, const Leg& leg, std::span<const Pose> poses);
/// That of the longest leg in the start pose; 0 for a robot without legs.
double longest_leg_m(const RobotSpec& robot);

/// How high the legs carry: the mean over them of the height of the hip joint (hips_m) over the lowest point
/// of the foot, in the start pose, m. 0 for a robot without legs.
double leg_height_m(const RobotSpec& robot);

/// A left and a right leg beside each other, as indices.
struct LegPair {
  int left = 0, right = 0;
};

/// The legs in pairs from front to back (+x is forward, +y left). Half of the legs are left: all of them are
/// further left than each of the others; the n-th from the front of each side make a pair. Empty where that
/// cannot be told: an odd number of legs, no gap between the sides, or two legs of a side abreast.
std::vector<LegPair> leg_pairs(std::span<const Vec3> places_m);

}  // namespace amble::robot
