#pragma once

#include <optional>
#include <span>

#include "amble/robot/pose.hpp"
#include "amble/robot/spec.hpp"

namespace amble::morphology {

/// A cylinder about its z axis: half its length is size_m.y.
struct RoundShape {
  double radius_m = 0.0, half_length_m = 0.0;
  robot::Pose pose;
};

/// The cylinder that points are the corners of, if they are: a wheel. About one of these axes (unit vectors)
/// their outline is a circle, at least as much as a polygon of twelve corners is, and their hull fills most
/// of the cylinder.
std::optional<RoundShape> cylinder_of(std::span<const Vec3> points_m, std::span<const Vec3> axes);

}  // namespace amble::morphology
