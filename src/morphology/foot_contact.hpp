#pragma once

#include <string>
#include <vector>

#include "amble/morphology/leg_guess.hpp"
#include "amble/morphology/model_file.hpp"
#include "amble/morphology/model_parts.hpp"

namespace amble::morphology {

/// The coefficient of friction of the robot's feet and where it is from; of the first foot, as MuJoCo takes
/// it: of a <pair>, the greater one, or that of the geom of higher priority.
struct FootFriction {
  double coefficient = 1.0;
  std::string source;  ///< "of the first foot in the model, which has no floor"
};
FootFriction foot_friction(const ModelFile& file, const ModelParts& parts, const LegsGuess& legs);

/// The bodies of a leg's joints that are farther out than its foot: they have no shape that collides.
std::vector<std::string> bodies_beyond_foot(const ModelParts& parts, const LegGuess& leg);

/// Feet that stand on the model's own floor otherwise than on amble's: they go through it, or slide without
/// friction, if it has one; and legs whose last bodies can touch nothing. A line each.
std::vector<std::string> doubts_of_feet(const ModelFile& file, const ModelParts& parts,
                                        const LegsGuess& legs);

}  // namespace amble::morphology
