#pragma once

#include <string>
#include <vector>

#include "amble/morphology/leg_choice.hpp"
#include "amble/morphology/model_parts.hpp"

namespace amble::morphology {

/// What may be a leg of a robot.
struct LegGuess {
  std::string name;
  int limb = 0;                    ///< among find_limbs()
  std::vector<int> joints;         ///< with motors (Drive::motor), from the trunk outwards
  int foot_geom = 0;               ///< the lowest shape of its foot
  std::vector<int> foot_geoms;     ///< all of them, from the lowest (foot_shapes())
  std::vector<int> joint_of_type;  ///< by joint type; −1: none
};

struct LegsGuess {
  std::vector<LegGuess> legs;
  std::vector<std::string> joint_types;  ///< from the foot to the trunk
  std::vector<int> held;                 ///< joints that belong to no leg
  std::vector<int> passive;              ///< joints that move freely (Drive::none), in a leg or not
  std::string why_legs, why_names, why_types;
  bool motors_added = false;  ///< every joint was given one (lacks_motors())
};

/// Names the legs that were chosen among the limbs of a robot, those without a joint with a motor left out. A
/// leg begins where its chain parts from the trunk; its foot is foot_geom() and what belongs to it
/// (foot_shapes()). Legs and joint types are named by the words that the names of the model's joints share or
/// differ in; where they say nothing, by place and by axis.
LegsGuess guess_legs(const ModelParts& parts, const LegChoice& choice);
/// The same of the legs that end near the ground in the start pose.
LegsGuess guess_legs(const ModelParts& parts);

/// Whether a model names motors of so few joints that most of these legs would have none: then the list is
/// incomplete, and every joint has one.
bool lacks_motors(const ModelParts& parts, const LegChoice& choice);

/// The longest way from a foot's centre along its joints to the trunk; 0.1 m without legs.
double longest_leg_m(const ModelParts& parts, const LegsGuess& legs);

/// The words of a name: "FR_hip_joint" and "FRHipJoint" and "fr-hip.joint" have three each, "leg1" has one
/// and, with `digits_apart`, two.
std::vector<std::string> words_of(const std::string& name, bool digits_apart = false);

}  // namespace amble::morphology
