#pragma once

#include <span>
#include <vector>

#include "amble/core/math.hpp"
#include "amble/ground/height_field.hpp"
#include "amble/robot/collision_points.hpp"
#include "amble/robot/pose.hpp"
#include "amble/robot/spec.hpp"

namespace amble::ground {

/// Where a ball touches the ground, or would first.
struct Touch {
  double gap_m;  ///< between the ball's surface and the ground, along the normal; negative: depth
  Vec3 normal;   ///< of the ground, a unit vector; its z is positive
  Vec3 point_m;  ///< of the ball's surface, the deepest
};

/// Uneven ground for one robot: its height field, and an offset field for each radius with which the robot
/// touches it. Robots touch it with points only (robot::CollisionPoint): of a box its corners, of a capsule
/// its ends. Engines share this, so they find the same contacts in the same pose. Const, shared by threads.
class Ground {
 public:
  /// `robot` gives the radii.
  Ground(HeightField surface, const robot::RobotSpec& robot);

  const HeightField& surface() const { return fields_.front(); }
  double height_m(double x_m, double y_m) const { return surface().at(x_m, y_m).height_m; }
  double highest_m() const { return highest_m_; }

  /// Offset fields by rising radius, the first for radius 0: the surface.
  std::span<const HeightField> fields() const { return fields_; }
  /// Index among fields() for a radius of the robot.
  std::size_t field_of(double radius_m) const;

  /// By the plane that touches the offset field above or below the ball's centre.
  Touch touch(Vec3 centre_m, double radius_m) const;
  /// Adds where a geom's collision points touch, its frame being at `pose`: gaps of 0 and below.
  void touches(std::span<const robot::CollisionPoint> points, const robot::Pose& pose,
               std::vector<Touch>& found) const;
  /// How far the robot with its bodies at `poses` can be lowered before it touches the ground (negative: must
  /// be lifted); infinity for a robot of which nothing collides.
  double clearance_m(const robot::RobotSpec& robot, std::span<const robot::Pose> poses) const;

 private:
  std::vector<double> radii_m_;
  std::vector<HeightField> fields_;
  double highest_m_;
};

}  // namespace amble::ground
