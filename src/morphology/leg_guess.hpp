#pragma once

#include <string>
#include <vector>

#include "amble/morphology/model_parts.hpp"

namespace amble::morphology {

/// What may be a leg of a robot.
struct LegGuess {
  std::string name;
  std::vector<int> joints;         ///< with motors (Drive::motor), from the trunk outwards
  int foot_geom = 0;               ///< the lowest shape of its foot
  std::vector<int> foot_geoms;     ///< all of them, from the lowest
  std::vector<int> joint_of_type;  ///< by joint type; −1: none
};

struct LegsGuess {
  std::vector<LegGuess> legs;
  std::vector<std::string> joint_types;  ///< from the foot to the trunk
  std::vector<int> held;                 ///< joints that belong to no leg
  std::vector<int> passive;              ///< joints that move freely (Drive::none), in a leg or not
  std::string why_legs, why_names, why_types;
  bool motors_added = false;  ///< by guess_driven_legs()
};

/// Finds the legs of a robot in its start pose. A leg is a chain of bodies that ends without branches, and
/// whose end is near the lowest point of the robot: no higher than a quarter of the height of its centre of
/// mass. It begins where the chain parts from those of other legs, and has a joint with a motor. Its foot is
/// the lowest geom that collides of its last body that has one, and what belongs to it (foot_shapes()). Legs
/// and joint types are named by the words that the names of the model's joints share or differ in; where they
/// say nothing, by place and by axis.
LegsGuess guess_legs(const ModelParts& parts);

/// The same; but of a model that names motors of so few joints that most of its legs would have none, the
/// list is taken for incomplete: every joint gets a motor, in `parts`, too.
LegsGuess guess_driven_legs(ModelParts& parts);

/// The words of a name: "FR_hip_joint" and "FRHipJoint" and "fr-hip.joint" have three each, "leg1" has one
/// and, with `digits_apart`, two.
std::vector<std::string> words_of(const std::string& name, bool digits_apart = false);

}  // namespace amble::morphology
