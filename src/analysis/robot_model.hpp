#pragma once

#include <string>
#include <vector>

#include "amble/core/math.hpp"

namespace amble::analysis {

enum class Shape { sphere, capsule, cylinder, box };

/// A piece of a body's surface. `size_m`: sphere {radius}; capsule and cylinder {radius, half length of the
/// straight part along the geom's z}; box {half extents}.
struct Geom {
  int body = 0;
  Shape shape = Shape::sphere;
  Vec3 size_m;
  Vec3 position_m;  ///< centre, in the body's frame
  Quat rotation;    ///< geom axes → body axes
};

/// A rigid body; its frame stands at `position_m`, `rotation` in the parent's (for the root: in the world) at
/// zero angles.
struct Body {
  int parent = -1;  ///< smaller than the body's own index
  Vec3 position_m;
  Quat rotation;
  double mass_kg = 0.0;
  Vec3 com_m;  ///< in the body's frame
};

/// A hinge between a body and its parent. Where a body has several, they form a chain from the parent to the
/// body in the order of `chain_index`.
struct Joint {
  std::string name;
  int body = 0;
  int chain_index = 0;
  Vec3 anchor_m;  ///< in the body's frame
  Vec3 axis;      ///< unit vector in the body's frame, at zero angles
  double lower_rad = 0.0, upper_rad = 0.0;
};

struct Leg {
  std::string name;
  int foot_geom = 0;
  std::vector<int> joints;  ///< one per joint type
};

/// What pictures need to know of a robot, read from the robot JSON inside a recording. Joints stand leg by
/// leg and within a leg type by type.
struct RobotModel {
  std::string name;
  std::vector<Body> bodies;  ///< bodies[0] is the root
  std::vector<Joint> joints;
  std::vector<Geom> geoms;
  std::vector<std::string> joint_types;
  std::vector<Leg> legs;
  Vec3 gravity_m_s2;

  /// Indices into `joints` of the joints of one body, in the order of the chain.
  std::vector<int> joints_of_body(int body) const;
  /// The leg a body belongs to, or −1 for the trunk: a leg is its joints' bodies and what hangs on them.
  int leg_of_body(int body) const;
  /// Centre of mass of the whole robot in its start pose, world frame.
  Vec3 com_at_start_m() const;
};

/// Throws UserError(ExitCode::bad_file) naming `what`: not JSON, a key missing or of the wrong type, an index
/// out of range.
RobotModel parse_robot(const std::string& robot_json, const std::string& what);

}  // namespace amble::analysis
