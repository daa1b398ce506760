#pragma once

#include <array>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "amble/core/math.hpp"

namespace amble::robot {

struct OriginalModel;

/// Shapes that engines can put into contact. `size_m` of a Geom means: sphere {radius, –, –}; capsule and
/// cylinder {radius, half length of the straight part along the geom's z, –}; box {half extents}; mesh
/// {radius about the geom's origin that encloses all vertices, –, –}. A mesh collides as the convex hull of
/// its vertices.
enum class Shape { sphere, capsule, cylinder, box, mesh };

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
  /// A mesh's vertices in the geom's axes, and its surface, each triangle counter-clockwise as seen from
  /// outside. If it collides, exactly those of the convex hull.
  std::vector<Vec3> vertices_m = {};
  std::vector<std::array<int, 3>> triangles = {};
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
  /// Applies kp × (target − angle) − kd × speed, clamped to ± max_torque, with the angle and speed at the end
  /// of the step (backward Euler): stable however stiff it is. At a stop, in the engines ode and batch,
  /// kp × (target − angle) with the angle at its beginning.
  torque,
  /// No motor: the joint moves freely, but for its spring, damping, friction and stops.
  none,
};

/// How a joint follows its target angle.
struct Servo {
  ServoMode mode = ServoMode::velocity;
  double gain_per_s = 9.0;
  double max_torque_nm = 5.0;
  double kp_nm_per_rad = 0.0;
  double kd_nm_s_per_rad = 0.0;
  /// ServoMode::torque, in the engine mujoco-model alone: the torque is that of the angle and the speed at
  /// the beginning of a tick, and is held for the tick, as an action of Gymnasium's environments is. Targets
  /// may lie beyond the stops: then it presses against one.
  bool hold_torque = false;
};

struct AngleRange {
  double lower_rad = 0.0, upper_rad = 0.0;
};

/// A hinge between `body` and its parent, with a motor unless its servo's mode is none. Its angle is 0 in the
/// start pose and grows by the right-hand rule about `axis` as `body` turns against its parent. A body with
/// two joints has them in the order of the chain: the first is next to the parent, the second to the body.
///
/// With angle q and torque τ of its servo, the joint's equation of motion has, beside what the bodies give,
/// armature q̈ = τ − damping q̇ − friction, |friction| ≤ friction_loss, which opposes q̇ (MuJoCo's `<joint>`
/// attributes of these names). A joint without a motor has a spring in place of the servo,
/// τ = stiffness (rest − q) with q at the end of a step (backward Euler, as the torque servo), so that it is
/// stable however stiff it is; it takes from an oscillation of ω rad/s a damping ratio of about ω h / 2.
struct Joint {
  std::string name;
  int body = 0;
  int chain_index = 0;                      ///< place among the joints of its body, counted from the parent
  Vec3 anchor_m;                            ///< in the frame of `body`
  Vec3 axis;                                ///< unit vector in the frame of `body`, at zero angles
  double lower_rad = 0.0, upper_rad = 0.0;  ///< stops; ± infinity: none
  /// Range of the targets that controllers give, finite and within the stops (but for Servo::hold_torque);
  /// none: from stop to stop. If its width is 0 no controller drives the joint: its servo holds it there.
  std::optional<AngleRange> command = std::nullopt;
  Servo servo;
  double armature_kg_m2 = 0.0;  ///< inertia of the motor's rotor, times the gear ratio squared
  double damping_nm_s_per_rad = 0.0;
  double friction_loss_nm = 0.0;
  double stiffness_nm_per_rad = 0.0;  ///< of the spring of a joint without a motor; 0: none
  double rest_rad = 0.0;              ///< the spring's angle at rest; may lie beyond the stops

  bool has_motor() const { return servo.mode != ServoMode::none; }
  /// What acts in it: its servo; of a joint without a motor one that is its spring, without a limit, whose
  /// target is always `rest_rad`.
  Servo acting_servo() const;
  AngleRange command_range() const { return command.value_or(AngleRange{lower_rad, upper_rad}); }
  /// Whether controllers give it targets.
  bool driven() const { return !command || command->lower_rad < command->upper_rad; }
};

struct Leg {
  std::string name;
  /// The shapes of its foot, at least one. The leg's touch sensor is whether any of them touches the ground.
  std::vector<int> foot_geoms;
  std::vector<int> joints;  ///< by joint type (RobotSpec::joint_types); −1: the leg has none of that type

  bool has_foot_geom(int geom) const;
};

/// Largest Contact::sweeps.
constexpr int most_sweeps = 1000;

/// Contact of bodies with the ground (and each other). erp and cfm as in ODE (manual, "Soft constraints"):
/// with timestep h a contact is a spring of erp / (h cfm) N/m and a damper of (1 − erp) / cfm N s/m. The ODE
/// engine gives both numbers to all constraints of its world, joints included, as the authors' program did.
struct Contact {
  double friction = 0.0;  ///< Coulomb coefficient; infinity: no sliding at all
  double erp = 0.0;       ///< share of the penetration undone per step, in (0, 1]
  /// Softness, ODE's constraint force mixing: yielding velocity per force, m/s per N.
  double cfm_s_per_kg = 0.0;
  /// Sweeps of the batch engine's solver, 0 to 1000. 0: as many as the paper's quadruped needs, which are too
  /// few for a heavy trunk on light legs (docs/BATCH.md, "Solver"; physics::solver_error_m_s).
  int sweeps = 0;
};

/// When a trial ends as `fell`.
struct FallRule {
  double below_m = 0.0;  ///< the root's centre of mass is lower than this over the ground below it
  double above_m = std::numeric_limits<double>::infinity();  ///< or higher than this
  double tilt_rad =
      std::numeric_limits<double>::infinity();  ///< or its z axis of the start pose tilts by more

  /// `up`: cosine of the angle between the vertical and the root's axis that was vertical in the start pose.
  bool met(double height_m, double up) const;
};

/// All that is known of a robot: const, shared by all workers, independent of any engine. Joints are in
/// control order: leg by leg and type by type, without gaps, then those that belong to no leg (head, spine,
/// tail), which are not driven: their motors hold them, or they have none. That is the order of motors,
/// targets, angles, and rows of every table in amble.
struct RobotSpec {
  std::string name;
  std::vector<Body> bodies;  ///< bodies[0] is the root ("torso"), free to move
  std::vector<Joint> joints;
  std::vector<Geom> geoms;
  std::vector<std::string> joint_types;
  std::vector<Leg> legs;
  Contact contact;
  Vec3 gravity_m_s2{0.0, 0.0, -9.8};
  /// A trial ends as `fell` when the root's centre of mass is lower than this over the ground below it.
  double fall_height_m = 0.0;
  /// And when it is higher than this, or the root tilts from its start pose by more than this.
  double fall_above_m = std::numeric_limits<double>::infinity();
  double fall_tilt_rad = std::numeric_limits<double>::infinity();
  bool self_collision = false;
  /// The MJCF itself, for the engine mujoco-model; null unless the robot file says keep_model = true.
  std::shared_ptr<const OriginalModel> original = nullptr;

  double total_mass_kg() const;
  FallRule fall_rule() const { return {fall_height_m, fall_above_m, fall_tilt_rad}; }
  /// FallRule::met of a root that is turned so.
  double upright(const Quat& root_rotation) const;
  /// Number of joints that belong to legs: the first of `joints`.
  std::size_t leg_joint_count() const;
  /// The body of a leg's foot: that of the first of its shapes.
  int foot_body(const Leg& leg) const;
  /// Indices into `joints` of the joints of one body, in the order of the chain (Joint::chain_index).
  std::vector<int> joints_of_body(int body) const;
  /// The leg that a body is part of, or −1 for the trunk: a leg is its joints' bodies and their descendants,
  /// without bodies that carry feet of several legs (a spine that turns with a leg).
  int leg_of_body(int body) const;
};

}  // namespace amble::robot
