#pragma once

#include <ode/ode.h>

#include <deque>
#include <vector>

#include "amble/core/lanes.hpp"
#include "amble/ground/ground.hpp"
#include "amble/physics/ode/variant.hpp"
#include "amble/physics/ode/world.hpp"
#include "amble/robot/collision_points.hpp"
#include "amble/robot/pose.hpp"
#include "amble/robot/spec.hpp"

namespace amble::physics::ode {

/// Finds the contacts of a robot, always in the same order of geoms, so that equal states give equal forces
/// to the bit. (ODE's spaces hand out pairs in an order that depends on what happened before.)
class Contacts {
 public:
  /// `ground`: null for the plane z = 0; not owned.
  /// `loads`: whether loads() will be asked for.
  Contacts(const robot::RobotSpec& robot, const World& world, const ground::Ground* ground,
           bool loads = false, const Variant& variant = {});
  ~Contacts();
  Contacts(const Contacts&) = delete;
  Contacts& operator=(const Contacts&) = delete;

  /// Which feet touch the ground: legs × 1 of 0 or 1.
  void find_touch(LaneArray& touch);
  /// Replaces the contacts of the last step by those of the present pose. Fills `touch` as find_touch() does.
  void collide(LaneArray& touch);
  /// With how much force the ground pressed against each foot in the step after collide(), N: legs × 1.
  void loads(LaneArray& loads_n) const;

 private:
  struct Collider {
    dGeomID geom = nullptr;
    dBodyID body = nullptr;
    double radius_m = 0.0;  ///< of the bounding sphere about the geom's centre
    int leg = -1;           ///< the leg whose foot it is, −1: none
    // For uneven ground:
    robot::Pose place = {};  ///< of the geom relative to the body's centre of mass, body axes
    std::vector<robot::CollisionPoint> points = {};  ///< that can touch it
  };
  struct Pair {
    int a = 0, b = 0;  ///< indices into colliders_
  };

  int collide_with_ground(const Collider& collider);
  int collide_with_uneven_ground(const Collider& collider);
  void collide_pair(const Pair& pair);
  /// `leg`: whose foot `a` belongs to, −1: none.
  void add_contacts(int count, dBodyID a, dBodyID b, int leg);

  struct Feedback {
    int leg = 0;
    Vec3 normal;  ///< from the ground
    dJointFeedback forces{};
  };

  const World& world_;
  const ground::Ground* ground_;
  dJointGroupID group_;
  const bool with_loads_;
  std::deque<Feedback> feedbacks_;  ///< of the feet's contacts; ODE has pointers to them
  dSurfaceParameters surface_{};
  dSurfaceParameters foot_surface_{};
  std::vector<Collider> colliders_;
  std::vector<Pair> pairs_;  ///< that may collide with each other
  static constexpr int most_contacts = 16;
  dContactGeom found_[most_contacts];
  std::vector<ground::Touch> touches_;
};

}  // namespace amble::physics::ode
