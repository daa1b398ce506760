#pragma once

#include <string>
#include <vector>

#include "amble/morphology/limbs.hpp"
#include "amble/morphology/model_parts.hpp"

namespace amble::morphology {

/// What distinguishes legs from other limbs.
enum class LegSearch {
  by_ground,     ///< they end near the lowest point of the start pose
  by_structure,  ///< by names and by what repeats, whatever the pose of the legs
  any_height,    ///< the same of a robot that may lie on its side: hips need not be as high
  either,        ///< by structure if that has all legs by ground and more, else by ground
};

struct LegChoice {
  std::vector<int> limbs;  ///< indices of the legs among the limbs, ascending
  std::string why;
  std::vector<int> off_ground;  ///< those of `limbs` that were added, as they have the joints of the others
};

/// By ground: limbs whose foot is no higher than a quarter of the height of the centre of mass; and, where
/// these lack their mirror images or leave the centre of mass on one side, limbs with as many joints, about
/// as long, that begin as high and are their counterparts. By structure: limbs that are named as legs are,
/// else the largest group of limbs with as many joints and about the same length, whose hips are about as
/// high, that are not named as arms, heads or tails; of two groups the lower one.
LegChoice choose_legs(const ModelParts& parts, const std::vector<Limb>& limbs, LegSearch search);

/// The words of the names of a limb's bodies and joints, in small letters.
std::vector<std::string> limb_words(const ModelParts& parts, const std::vector<int>& joints);

}  // namespace amble::morphology
