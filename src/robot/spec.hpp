#pragma once

#include <array>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "amble/core/math.hpp"

/// The robot itself: its bodies, joints and legs, the poses of its bodies, the frame of its sensors.
namespace amble::robot {

struct OriginalModel;

/// Shapes that engines can put into contact. `size_m` of a Geom means: sphere {radius, –, –}; capsule and
/// cylinder {radius, half length of the straight part along the geom's z, –}; box {half extents}; mesh
/// {radius about the geom's origin that encloses all vertices, –, –}. A mesh collides as the convex hull of
/// its vertices.
enum class Shape {
  sphere,    ///< a ball
  capsule,   ///< a cylinder with half a ball at each end
  cylinder,  ///< with flat ends
  box,       ///< along the geom's axes
  mesh       ///< Geom::vertices_m and triangles
};

/// A piece of a body's surface. Carries no mass: that is in Body.
struct Geom {
  std::string name;             ///< for messages and models; may be empty
  int body = 0;                 ///< index in RobotSpec::bodies
  bool collides = true;         ///< false: visual only
  Shape shape = Shape::sphere;  ///< what `size_m` means
  Vec3 size_m;                  ///< Shape says what each number is; those that it names are positive
  Vec3 position_m;              ///< centre, in the body's frame
  Quat rotation;                ///< geom axes → body axes
  std::array<float, 4> rgba{0.7f, 0.7f, 0.7f, 1.0f};  ///< red, green, blue, opacity, 0 … 1; for pictures
  /// A mesh's vertices in the geom's axes, at least four. If it collides, exactly those of the convex hull.
  std::vector<Vec3> vertices_m = {};
  /// A mesh's surface: indices in `vertices_m`, counter-clockwise as seen from outside.
  std::vector<std::array<int, 3>> triangles = {};
};

/// Colour, in recordings, of the geoms of a leg that a damage took away (damage::as_drawn).
inline constexpr std::array gone_rgba{0.9f, 0.9f, 0.9f, 0.25f};

/// A rigid body. `position_m` and `rotation` are the pose of its frame in the parent's frame while all joints
/// are at zero; of the root (parent −1) in the world: the start pose.
struct Body {
  std::string name;       ///< as its model has it
  int parent = -1;        ///< always smaller than the body's own index
  Vec3 position_m;        ///< origin of its frame, in the parent's
  Quat rotation;          ///< body axes → the parent's
  double mass_kg = 0.0;   ///< positive
  Vec3 com_m;             ///< centre of mass, in the body's frame
  Vec3 inertia_kg_m2;     ///< principal moments about the centre of mass, all positive
  Quat inertia_rotation;  ///< principal axes → body axes
};

/// Which law gives a servo's torque.
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
///
/// All numbers are finite and at least 0, and 0 where there is no motor. The defaults are those of the
/// authors' robot.
struct Servo {
  ServoMode mode = ServoMode::velocity;  ///< which of the numbers below count
  double gain_per_s = 9.0;               ///< ServoMode::velocity: speed aimed at per angle still to go, 1/s
  double max_torque_nm = 5.0;            ///< largest torque, N m
  double kp_nm_per_rad = 0.0;            ///< ServoMode::torque: torque per angle still to go, N m/rad
  double kd_nm_s_per_rad = 0.0;          ///< ServoMode::torque: torque per speed, N m s/rad
  /// ServoMode::torque, in the engine mujoco-model alone, others refuse such a robot (UserError): the torque
  /// is that of the angle and the speed at the beginning of a tick, and is held for the tick, as an action of
  /// Gymnasium's environments is. Targets may lie beyond the stops: then it presses against one.
  bool hold_torque = false;
};

/// A closed range of joint angles.
struct AngleRange {
  double lower_rad = 0.0,  ///< from the start pose
      upper_rad = 0.0;     ///< not below `lower_rad`
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
  std::string name;        ///< as configs name it
  int body = 0;            ///< index in RobotSpec::bodies of the body that it moves; not the root
  int chain_index = 0;     ///< place among the joints of its body, from 0, counted from the parent
  Vec3 anchor_m;           ///< a point on the axis, in the frame of `body`
  Vec3 axis;               ///< unit vector in the frame of `body`, at zero angles
  double lower_rad = 0.0,  ///< the lower stop, at most 0; −infinity: none
      upper_rad = 0.0;     ///< the upper stop, at least 0 and above the lower; infinity: none
  /// Range of the targets that controllers give, finite and within the stops (but for Servo::hold_torque);
  /// none: from stop to stop. If its width is 0 no controller drives the joint: its servo holds it there.
  std::optional<AngleRange> command = std::nullopt;
  Servo servo;                        ///< how it follows its targets
  double armature_kg_m2 = 0.0;        ///< inertia of the motor's rotor, times the gear ratio squared
  double damping_nm_s_per_rad = 0.0;  ///< torque against the motion per speed, at least 0
  double friction_loss_nm = 0.0;      ///< largest torque of dry friction, at least 0
  double stiffness_nm_per_rad = 0.0;  ///< spring of a joint without a motor; 0: none
  double rest_rad = 0.0;              ///< the spring's angle at rest; may lie beyond the stops

  /// Whether a servo acts in it.
  bool has_motor() const { return servo.mode != ServoMode::none; }
  /// What acts in it: its servo; of a joint without a motor one that is its spring, without a limit, whose
  /// target is always `rest_rad`.
  Servo acting_servo() const;
  /// Range of the targets that controllers give: `command`, or without it the stops.
  AngleRange command_range() const { return command.value_or(AngleRange{lower_rad, upper_rad}); }
  /// Whether controllers give it targets.
  bool driven() const { return !command || command->lower_rad < command->upper_rad; }
};

/// A leg: a foot, and the joints that controllers drive.
struct Leg {
  std::string name;  ///< as configs name it
  /// The shapes of its foot, at least one, as indices in RobotSpec::geoms. The leg's touch sensor is whether
  /// any of them touches the ground.
  std::vector<int> foot_geoms;
  std::vector<int> joints;  ///< by joint type (RobotSpec::joint_types); −1: the leg has none of that type

  /// Whether a geom, by its index, is one of its foot.
  bool has_foot_geom(int geom) const;
};

/// Largest Contact::sweeps.
constexpr int most_sweeps = 1000;

/// Contact of bodies with the ground (and each other). erp and cfm as in ODE (manual, "Soft constraints"):
/// with timestep h a contact is a spring of erp / (h cfm) N/m and a damper of (1 − erp) / cfm N s/m. The ODE
/// engine gives both numbers to all constraints of its world, joints included, as the authors' program did.
struct Contact {
  double friction = 0.0;  ///< Coulomb coefficient, at least 0; infinity: no sliding at all
  double erp = 0.0;       ///< share of the penetration undone per step, in (0, 1]: to be set
  /// Softness, ODE's constraint force mixing: yielding velocity per force, m/s per N, at least 0.
  double cfm_s_per_kg = 0.0;
  /// Sweeps of the batch engine's solver, 0 to 1000. 0: as many as the paper's quadruped needs, which are too
  /// few for a heavy trunk on light legs (docs/BATCH.md, "Solver"; physics::solver_error_m_s).
  int sweeps = 0;
};

/// When a trial ends as `fell`. By default when the root's centre of mass sinks into the ground.
struct FallRule {
  double below_m = 0.0;  ///< the root's centre of mass is lower than this over the ground below it
  double above_m = std::numeric_limits<double>::infinity();  ///< or higher than this
  double tilt_rad =
      std::numeric_limits<double>::infinity();  ///< or the root tilts from its start pose by more

  /// `height_m`: the root's centre of mass over the ground below it. `up`: cosine of the angle between the
  /// world's z axis (on a slope the ground's normal) and the root's axis that pointed along it in the start
  /// pose.
  bool met(double height_m, double up) const;
};

/// All that is known of a robot: const, shared by all workers, independent of any engine. Joints are in
/// control order: leg by leg and type by type, without gaps, then those that belong to no leg (head, spine,
/// tail), which are not driven: their motors hold them, or they have none. That is the order of motors,
/// targets, angles, and rows of every table in amble.
///
/// Numbers are as the comments of the members say in every robot that is read from a file; a robot that a
/// program makes itself is not checked.
struct RobotSpec {
  std::string name;                      ///< for titles
  std::vector<Body> bodies;              ///< bodies[0] is the root ("torso"), free to move
  std::vector<Joint> joints;             ///< in control order
  std::vector<Geom> geoms;               ///< in any order
  std::vector<std::string> joint_types;  ///< names, e.g. knee, hip_fb, hip_io, in control order
  std::vector<Leg> legs;                 ///< in control order
  Contact contact;                       ///< with the ground, and of bodies with each other
  Vec3 gravity_m_s2{0.0, 0.0, -9.8};     ///< in the world; leans on a slope
  /// A trial ends as `fell` when the root's centre of mass is lower than this over the ground below it.
  double fall_height_m = 0.0;
  /// The same when it is higher than this over the ground below it.
  double fall_above_m = std::numeric_limits<double>::infinity();
  /// The same when the root's own vertical axis leans from that of its start pose by more than this.
  double fall_tilt_rad = std::numeric_limits<double>::infinity();
  bool self_collision = false;  ///< whether bodies that no joint links collide with each other
  /// The MJCF itself, for the engine mujoco-model; null unless the robot file says keep_model = true.
  std::shared_ptr<const OriginalModel> original = nullptr;

  /// Sum over the bodies.
  double total_mass_kg() const;
  /// The three numbers above.
  FallRule fall_rule() const { return {fall_height_m, fall_above_m, fall_tilt_rad}; }
  /// How the robot is turned from its start pose, whose x axis points forward and z up, for a root whose axes
  /// `root_rotation` takes to the world's: whichever way the root's own axes point.
  Quat turned(const Quat& root_rotation) const { return root_rotation * conjugate(bodies[0].rotation); }
  /// What FallRule::met() takes as `up`, likewise.
  double upright(const Quat& root_rotation) const;
  /// Number of joints that belong to legs: those at the front of `joints`.
  std::size_t leg_joint_count() const;
  /// The body of a leg's foot, as an index in `bodies`: that of the first of its shapes.
  int foot_body(const Leg& leg) const;
  /// Indices into `joints` of the joints of one body, in the order of the chain (Joint::chain_index).
  std::vector<int> joints_of_body(int body) const;
  /// The leg that a body is part of, or −1 for the trunk: a leg is its joints' bodies and their descendants,
  /// without bodies that carry feet of several legs (a spine that turns with a leg).
  int leg_of_body(int body) const;
};

}  // namespace amble::robot
