#pragma once

#include <array>
#include <string>
#include <vector>

#include "amble/core/math.hpp"

namespace amble::robot {

/// Shapes that engines can put into contact. `size_m` of a Geom means: sphere {radius, –, –}; capsule and
/// cylinder {radius, half length of the straight part along the geom's z, –}; box {half extents}.
enum class Shape { sphere, capsule, cylinder, box };

/// A piece of a body's surface. Carries no mass: that is in Body.
struct Geom {
  std::string name;
  int body = 0;
  bool collides = true;  ///< false: visual only
  Shape shape = Shape::sphere;
  Vec3 size_m;
  Vec3 position_m;  ///< centre, in the body's frame
  Quat rotation;    ///< geom axes → body axes
  std::array<float, 4> rgba{0.7f, 0.7f, 0.7f, 1.0f};
};

/// A rigid body. `position_m` and `rotation` are the pose of its frame in the parent's frame while all joints
/// are at zero; of the root (parent −1) in the world: the start pose.
struct Body {
  std::string name;
  int parent = -1;  ///< always smaller than the body's own index
  Vec3 position_m;
  Quat rotation;
  double mass_kg = 0.0;
  Vec3 com_m;             ///< centre of mass, in the body's frame
  Vec3 inertia_kg_m2;     ///< principal moments about the centre of mass
  Quat inertia_rotation;  ///< principal axes → body axes
};

enum class ServoMode {
  /// Drives the joint at the speed gain × (target − angle), with at most max_torque (the authors' ODE joint
  /// motor).
  velocity,
  /// Applies kp × (target − angle) − kd × speed, clamped to ± max_torque.
  torque,
};

/// How a joint follows its target angle.
struct Servo {
  ServoMode mode = ServoMode::velocity;
  double gain_per_s = 9.0;
  double max_torque_nm = 5.0;
  double kp_nm_per_rad = 0.0;
  double kd_nm_s_per_rad = 0.0;
};

/// A motorised hinge between `body` and its parent. Its angle is 0 in the start pose and grows by the
/// right-hand rule about `axis` as `body` turns against its parent. A body with two joints has them in the
/// order of the chain: the first is next to the parent, the second to the body.
struct Joint {
  std::string name;
  int body = 0;
  int chain_index = 0;                      ///< place among the joints of its body, counted from the parent
  Vec3 anchor_m;                            ///< in the frame of `body`
  Vec3 axis;                                ///< unit vector in the frame of `body`, at zero angles
  double lower_rad = 0.0, upper_rad = 0.0;  ///< stops; targets are scaled to this range
  Servo servo;
};

struct Leg {
  std::string name;
  int foot_geom = 0;        ///< its contact with the ground is the leg's touch sensor
  std::vector<int> joints;  ///< one per joint type, in the order of RobotSpec::joint_types
};

/// Contact of bodies with the ground (and each other). erp and cfm as in ODE (manual, "Soft constraints"):
/// with timestep h a contact is a spring of erp / (h cfm) N/m and a damper of (1 − erp) / cfm N s/m. The ODE
/// engine gives both numbers to all constraints of its world, joints included, as the authors' program did.
struct Contact {
  double friction = 0.0;  ///< Coulomb coefficient; infinity: no sliding at all
  double erp = 0.0;       ///< share of the penetration undone per step, in (0, 1]
  /// Softness, ODE's constraint force mixing: yielding velocity per force, m/s per N.
  double cfm_s_per_kg = 0.0;
};

/// All that is known of a robot: const, shared by all workers, independent of any engine. Joints are in
/// control order, leg by leg and type by type: joint index = leg × joint_types.size() + type. That is the
/// order of motors, targets, angles, and rows of every table in amble.
struct RobotSpec {
  std::string name;
  std::vector<Body> bodies;  ///< bodies[0] is the root ("torso"), free to move
  std::vector<Joint> joints;
  std::vector<Geom> geoms;
  std::vector<std::string> joint_types;
  std::vector<Leg> legs;
  Contact contact;
  Vec3 gravity_m_s2{0.0, 0.0, -9.8};
  double fall_height_m = 0.0;  ///< a trial ends as `fell` when the root's centre of mass is lower
  bool self_collision = false;

  double total_mass_kg() const;
  /// Indices into `joints` of the joints of one body, in the order of the chain (Joint::chain_index).
  std::vector<int> joints_of_body(int body) const;
  /// The leg that a body is part of, or −1 for the trunk: a leg is its joints' bodies and their descendants.
  int leg_of_body(int body) const;
};

}  // namespace amble::robot
