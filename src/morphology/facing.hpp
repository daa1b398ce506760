#pragma once

#include <optional>
#include <string>
#include <vector>

#include "amble/core/math.hpp"
#include "amble/morphology/leg_guess.hpp"
#include "amble/morphology/model_parts.hpp"

namespace amble::morphology {

/// A turn of a robot's root, applied in the world before its own rotation, and why.
struct RootTurn {
  Quat turn;
  std::string why;
};

/// The turn about z that makes a robot face +x, which is forward in amble, if it faces +y, −y or −x. That
/// follows from the names of its legs (front and rear, left and right); else from rows of legs along y whose
/// hinges step along y, and from heads and tails. None: it faces +x, or nothing tells.
std::optional<RootTurn> turn_to_face_x(const ModelParts& parts, const LegsGuess& legs);

/// The turn that sets a robot upright whose legs all together point sideways, with the trunk on their other
/// side or with hips in a plane that is not level, as of models by conventions of motion capture; with `up`
/// also one whose legs point up. None: they do not.
std::optional<RootTurn> turn_upright(const ModelParts& parts, const LegsGuess& legs, bool up);

}  // namespace amble::morphology
