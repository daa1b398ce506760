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

/// Feet that stand on the model's own floor otherwise than on amble's: they go through it, or slide without
/// friction. A line each, nothing where the model has no floor.
std::vector<std::string> doubts_of_feet(const ModelFile& file, const ModelParts& parts,
                                        const LegsGuess& legs);

}  // namespace amble::morphology
