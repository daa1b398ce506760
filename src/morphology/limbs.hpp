#pragma once

#include <span>
#include <string>
#include <vector>

#include "amble/morphology/model_parts.hpp"
#include "amble/robot/pose.hpp"

namespace amble::morphology {

/// A chain of bodies that hangs from the trunk and ends free: a leg, an arm, a neck, a tail.
struct Limb {
  int trunk = 0;                 ///< the body of the trunk that it hangs from
  std::vector<int> bodies;       ///< from the trunk outwards, without what branches off
  std::vector<int> joints;       ///< of these bodies, from the trunk outwards
  std::vector<int> toe_joints;   ///< of what branches off at its end
  std::vector<int> side_joints;  ///< of levers: small parts that branch off and do not reach its end
  std::vector<int> toes;         ///< the bodies that `toe_joints` move
  double length_m = 0.0;         ///< from its first joint along the joints to its end
};

/// The limbs of a robot, in the order of their last bodies. They follow from the tree of bodies and the
/// lengths along it alone, not from the pose. Where a chain branches, branches that are short against what
/// leads to them are toes, and small ones beside a longer one, or beside a body that reaches further itself,
/// are levers; else the chain up to there is a part of the trunk (a spine), and limbs begin behind it.
std::vector<Limb> find_limbs(const ModelParts& parts);

/// The lowest shape that collides of a limb's last body with its toes, or of the last body before that has
/// one; −1: none has.
int foot_geom(const ModelParts& parts, const Limb& limb, std::span<const robot::Pose> poses);

/// For a limb with a foot_geom(), the shape of the same body that reaches farthest from the last joint: its
/// end, whatever the pose.
int end_geom(const ModelParts& parts, const Limb& limb, std::span<const robot::Pose> poses);

/// Where a limb begins, in the world: the anchor of its first joint.
Vec3 hip_m(const ModelParts& parts, const Limb& limb, std::span<const robot::Pose> poses);

}  // namespace amble::morphology
