#pragma once

#include <array>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "amble/morphology/leg_guess.hpp"
#include "amble/morphology/model_parts.hpp"

namespace amble::morphology {

/// A pose in which a robot may stand, by its geometry.
struct StandPose {
  std::map<std::string, double> angles_rad;  ///< of the legs' joints, as the model counts
  /// The largest height of a foot's lowest point over that of the lowest foot, and distance of a foot from
  /// below its hip, as shares of the leg's length.
  double uneven_share = 0.0, off_share = 0.0;
};

/// Angles of the legs' joints, within their stops and within `targets_rad`, with which all feet are on one
/// level below the hips, soles flat and the legs otherwise clear of the ground, at `reach` of the farthest
/// that the shortest leg gets down (so that knees are bent; lower if another leg cannot be bent as far), and
/// the centre of mass between the feet. Legs that turn about z at the hip, four and more, stand out to the
/// sides. The trunk stays as it is in the parts. `targets_rad`: for each joint what its motor can be told, as
/// the model counts; nothing: any angle. Deterministic.
StandPose find_stand_pose(const ModelParts& parts, const std::vector<LegGuess>& legs,
                          std::span<const std::optional<std::array<double, 2>>> targets_rad, double reach);

}  // namespace amble::morphology
