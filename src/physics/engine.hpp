#pragma once

#include <cstdint>
#include <memory>
#include <string_view>
#include <vector>

#include "amble/core/lanes.hpp"
#include "amble/core/math.hpp"
#include "amble/ground/ground.hpp"
#include "amble/io/own_settings.hpp"
#include "amble/robot/sensors.hpp"
#include "amble/robot/spec.hpp"

/// Engines: what simulates a robot.
namespace amble::physics {

/// Where the root's frame is in the world. That frame is the model's own: its origin need not be the centre
/// of mass, nor its axes level in the start pose.
struct RootPose {
  Vec3 position_m;  ///< the frame's origin, in the world
  Quat rotation;    ///< root axes → world axes
};

/// A pose to start a trial from, at rest. In the robot's own start pose the root has the
/// pose of RobotSpec::bodies[0] and all angles are 0.
struct StartPose {
  RootPose root;                        ///< in the world
  std::vector<double> joint_angle_rad;  ///< in control order (RobotSpec::joints), within the stops
};

/// A pose and how the robot moves in it, independent of masses and of the engine.
struct MovingPose {
  StartPose pose;                         ///< where it is
  Vec3 velocity_m_s;                      ///< the origin of the root's frame, in the world
  Vec3 angular_velocity_rad_s;            ///< the root's, in the world's axes
  std::vector<double> joint_speed_rad_s;  ///< in control order
};

/// What an engine is made with, beside the robot.
struct EngineSettings {
  double timestep_s = 0.01;  ///< length of step(), positive (AMBLE_CHECK in make_engine())
  bool torques = false;      ///< measure motor_torque_nm(); changes nothing else
  bool loads = false;        ///< measure foot_load_n(); changes nothing else
  /// Coulomb coefficient of the config's ground.friction; negative: it gives none. RobotSpec::contact has it
  /// already: only for engines that take friction from elsewhere (mujoco-model).
  double ground_friction = -1.0;
  /// True: set_ground() will be called, and an engine that cannot refuses now (UserError). False says
  /// nothing: Problem::make_engine() leaves it so, and set_ground() has to refuse by itself.
  bool uneven_ground = false;
  io::OwnSettings own = {};  ///< settings of an engine that has its own
};

/// A robot that is faster has diverged: m/s or rad/s (Engine::healthy).
inline constexpr double absurd_speed = 1000.0;

/// Advances up to lanes() copies of one robot in lockstep, one copy per lane, on one ground: the plane z = 0
/// unless set_ground() gives another. Lanes do not influence each other, not by one bit: a lane's states
/// depend on its own targets alone. One thread at a time may use an engine (EngineTraits says which keep to
/// one). Order within step(): find touches and contacts, advance by one timestep, then read joint angles and
/// attitude: touch is that of the pose before the step.
///
/// A lane is 0 … lanes() − 1; another is a programming error. Positions, velocities and forces are in the
/// world (docs/CONVENTIONS.md): x forward, y to the left, z up; on a slope z is the ground's normal.
class Engine {
 public:
  virtual ~Engine() = default;

  /// Robots that it simulates at once; constant.
  virtual int lanes() const = 0;

  /// The ground from now on, made for this robot; null: the plane z = 0. Retires all lanes. Throws UserError
  /// where the engine cannot have this robot on uneven ground, which its on_ground() refuses.
  void set_ground(std::shared_ptr<const ground::Ground> ground);
  /// The last of set_ground(); null: the plane z = 0.
  const ground::Ground* ground() const { return ground_.get(); }

  /// Puts the robot of this lane into its start pose, at rest, whatever its state was; its sensors are valid
  /// at once (all joint angles 0; a foot touches if it is not above the ground). On uneven ground that pose
  /// may be in the ground: see place_at().
  virtual void place(int lane) = 0;
  /// The same, but into the given pose, which has an angle for each joint (AMBLE_CHECK). Joint angles are
  /// still counted from the robot's own start pose.
  virtual void place_at(int lane, const StartPose& pose) = 0;
  /// The same, but moving. Impulses of the last step, from which a solver would start, are not known.
  virtual void place_moving(int lane, const MovingPose& motion) = 0;
  /// How the robot of a placed lane is and moves, as the engine has it: what place_moving() takes.
  virtual MovingPose motion(int lane) const = 0;
  /// Takes the robot of this lane out of step() until it is placed again.
  virtual void retire(int lane) = 0;

  /// Advances every placed lane by one timestep towards its target angles: rad from the start pose, joints ×
  /// lanes (AMBLE_CHECK), clamped to the stops (but for robot::Servo::hold_torque). A lane with a target that
  /// is NaN diverges.
  virtual void step(const LaneArray& targets_rad) = 0;
  /// Pushes the robot of a placed lane: during its next step alone, the force impulse / timestep acts on the
  /// centre of mass of the root body. `impulse_n_s` in N s, world frame. Pushes add up. Placing the
  /// lane anew before that step cancels them.
  virtual void push(int lane, Vec3 impulse_n_s) = 0;

  /// False once a placed lane's state is not finite or absurdly fast (over 1000 m/s or rad/s): its trial has
  /// diverged, its other values mean nothing, and it must be retired.
  virtual bool healthy(int lane) const = 0;

  /// What all robots sense after the last step, or where they were placed: joint angles, touch and attitude;
  /// the other rows are empty. The same object at every call.
  virtual const robot::SensorFrame& sensors() const = 0;
  /// Where the root's frame is in the world.
  virtual RootPose root_pose(int lane) const = 0;
  /// Torque of each joint's motor in the last step, N m about the joint's axis, child against parent (joints
  /// × lanes), without the reaction of a stop. Null unless EngineSettings::torques is set.
  virtual const LaneArray* motor_torque_nm() const = 0;
  /// With how much force the ground pressed against each foot in the last step, along its normal, N (legs ×
  /// lanes); the mean where an engine takes several steps to one. Null unless EngineSettings::loads is set,
  /// and always in an engine that does not override it: there controllers that sense loads fail an
  /// AMBLE_CHECK.
  virtual const LaneArray* foot_load_n() const { return nullptr; }
  /// Centre of mass of the root body, in the world; RobotSpec::fall_height_m refers to its height over the
  /// ground below it.
  virtual Vec3 root_com_m(int lane) const = 0;
  /// Centre of mass of the whole robot, in the world.
  virtual Vec3 com_m(int lane) const = 0;
  /// Linear momentum of the whole robot, in the world.
  virtual Vec3 momentum_kg_m_s(int lane) const = 0;
  /// Hash of all positions and velocities of this lane, to the bit: `amble verify` names the first step in
  /// which it differs. Comparable within one engine alone.
  virtual std::uint64_t state_hash(int lane) const = 0;

 private:
  /// The ground has changed; all lanes are to be retired. May throw UserError.
  virtual void on_ground() {}

  std::shared_ptr<const ground::Ground> ground_;
};

/// Those that are registered (engine_kinds.hpp), in the order in which they are listed to users.
std::vector<std::string_view> engine_names();
/// Whether an engine of this name is in the program.
bool is_engine(std::string_view name);
/// Throws UserError unless it is one of engine_names. `what` precedes the message, e.g. "--engines: ".
void check_engine_name(std::string_view name, std::string_view what = "");

/// What holds for every engine of a name, whatever the robot.
struct EngineTraits {
  int lanes = 1;                   ///< Engine::lanes()
  bool keeps_to_a_thread = false;  ///< only the thread that placed a robot may step it
  /// It simulates RobotSpec::original, not the robot: only robots that carry one, and without damage.
  bool of_original_model = false;
  /// `amble compare` takes it only if it is named, not among all engines.
  bool only_if_named = false;
};
/// Throws UserError for an unknown name.
EngineTraits engine_traits(std::string_view name);

/// Makes the engine of that name for the intact robot. Throws UserError for an unknown name or a robot that
/// the engine cannot simulate.
std::unique_ptr<Engine> make_engine(std::string_view name, const robot::RobotSpec& robot,
                                    const EngineSettings& settings);

}  // namespace amble::physics
