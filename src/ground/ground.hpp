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
  Vec3 normal;   ///< the ground's there, a unit vector; its z is positive
  Vec3 point_m;  ///< the deepest of the ball's surface, in the world
};

/// Uneven ground for one robot: its height field, and an offset field for each radius with which the robot
/// touches it. Robots touch it with points only (robot::CollisionPoint): of a box its corners, of a capsule
/// its ends. Engines share this, so they find the same contacts in the same pose. Const, shared by threads.
class Ground {
 public:
  /// `robot` gives the radii. Makes an offset field for each, which takes a while.
  Ground(HeightField surface, const robot::RobotSpec& robot);

  /// The ground itself.
  const HeightField& surface() const { return fields_.front(); }
  /// Height of the surface over z = 0, at any finite place of the world.
  double height_m(double x_m, double y_m) const { return surface().at(x_m, y_m).height_m; }
  /// The greatest height of the surface.
  double highest_m() const { return highest_m_; }

  /// Offset fields by rising radius, the first for radius 0: the surface.
  std::span<const HeightField> fields() const { return fields_; }
  /// Index among fields() for a radius of the robot. AMBLE_CHECK: it is one of them, to the bit.
  std::size_t field_of(double radius_m) const;

  /// Where a ball of a radius of the robot touches, by the plane that touches the offset field above or below
  /// its centre.
  Touch touch(Vec3 centre_m, double radius_m) const;
  /// Adds to `found` where a geom's collision points touch, its frame being at `pose` in the world: gaps of 0
  /// and below.
  void touches(std::span<const robot::CollisionPoint> points, const robot::Pose& pose,
               std::vector<Touch>& found) const;
  /// How far the robot with its bodies at `poses` (in the world, robot::poses_at) can be lowered before it
  /// touches the ground (negative: must be lifted); infinity for a robot of which nothing collides.
  double clearance_m(const robot::RobotSpec& robot, std::span<const robot::Pose> poses) const;

 private:
  std::vector<double> radii_m_;
  std::vector<HeightField> fields_;
  double highest_m_;
};

/// What Ground::clearance_m of such a surface is at least: below and around what touches, all is as high as
/// the highest node there. Takes far less than making a Ground.
double least_clearance_m(const HeightField& surface, const robot::RobotSpec& robot,
                         std::span<const robot::Pose> poses);

}  // namespace amble::ground
