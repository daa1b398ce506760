#pragma once

#include <string>
#include <vector>

#include "amble/morphology/model_parts.hpp"

namespace amble::morphology {

/// The names of those of these joints behind which hangs next to nothing, less than a ten-thousandth of the
/// robot's mass, as at a finger of milligrams: a motor that holds them makes a simulation diverge.
std::vector<std::string> joints_of_tiny_links(const ModelParts& parts, const std::vector<int>& joints);

/// A line about those of these joints whose limit of speed, in a URDF, is so low that legs of that length
/// hardly move, as templates have it; empty: none is.
std::string slow_joints(const ModelFile& file, const ModelParts& parts, const std::vector<int>& joints,
                        double leg_length_m);

}  // namespace amble::morphology
