#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <mutex>
#include <optional>
#include <span>
#include <vector>

#include "amble/core/check.hpp"
#include "amble/core/hash.hpp"
#include "amble/physics/engine.hpp"
#include "amble/physics/engine_kinds.hpp"
#include "amble/physics/ode/contacts.hpp"
#include "amble/physics/ode/motors.hpp"
#include "amble/physics/ode/variant.hpp"
#include "amble/physics/ode/world.hpp"
#include "amble/physics/single_robot.hpp"
#include "amble/robot/pose.hpp"

namespace amble::physics {
namespace {

using robot::RobotSpec;

/// State of a body as ODE keeps it, copied once per step: centre of mass, quaternion, velocity, angular
/// velocity.
struct BodyState {
  std::array<double, 3> position_m;
  std::array<double, 4> rotation;
  std::array<double, 3> velocity_m_s;
  std::array<double, 3> angular_velocity_rad_s;
};
static_assert(sizeof(BodyState) == 13 * sizeof(double), "hashed as plain doubles");

Vec3 vec3(const std::array<double, 3>& v) {
  return {v[0], v[1], v[2]};
}
Quat quat(const std::array<double, 4>& q) {
  return {q[0], q[1], q[2], q[3]};
}

/// Finite, and not absurdly fast (Engine::healthy).
bool sane(const BodyState& body) {
  double sum = 0.0;  // finite only if every number is
  for (const double x : body.position_m) sum += x;
  for (const double x : body.rotation) sum += x;
  const double speed = norm(vec3(body.velocity_m_s));
  const double angular_speed = norm(vec3(body.angular_velocity_rad_s));
  return std::isfinite(sum) && speed <= absurd_speed && angular_speed <= absurd_speed;
}

/// All ODE objects of one trial.
struct Trial {
  ode::World world;
  ode::Motors motors;
  ode::Contacts contacts;
  std::optional<ode::TorqueMeter> torques;

  Trial(const RobotSpec& robot, const ode::Threading& threading, const EngineSettings& settings,
        const ground::Ground* ground)
      : world(robot, threading),
        motors(robot, world, settings.timestep_s),
        contacts(robot, world, ground, settings.loads, ode::Variant::of(settings.own)) {
    if (settings.torques) torques.emplace(robot, motors);
  }
};

/// Open Dynamics Engine 0.16, dWorldStep: one robot per engine, double precision. Every constraint, contact
/// or joint, has the erp and cfm of RobotSpec::contact. Infinite friction is ODE's mu = infinity; finite
/// friction is a pyramid proportional to the normal force (dContactApprox1), along the world's x and y on the
/// plane, and along ODE's own pair of tangents (dPlaneSpace) elsewhere.
/// Bodies joined by a joint never collide. motors.hpp says what acts in the joints. With numbers of
/// ode::Variant it is what they say.
class OdeEngine final : public SingleRobotEngine {
 public:
  OdeEngine(const RobotSpec& robot, const EngineSettings& settings)
      : SingleRobotEngine(robot, settings),
        settings_(settings),
        quick_sweeps_(ode::Variant::of(settings.own).quick_sweeps),
        total_mass_kg_(robot.total_mass_kg()),
        bodies_(robot.bodies.size()) {
    ode::prepare_thread();
    threading_.emplace();
  }

  void place(int lane) override {
    make_trial(lane);
    begin();
  }

  void place_at(int lane, const StartPose& pose) override {
    make_trial(lane);
    trial_->world.move_to(robot_, {pose.root.position_m, pose.root.rotation}, pose.joint_angle_rad);
    begin();
  }

  void place_moving(int lane, const MovingPose& motion) override {
    make_trial(lane);
    const robot::Pose root{motion.pose.root.position_m, motion.pose.root.rotation};
    const robot::JointStates joints{motion.pose.joint_angle_rad, motion.joint_speed_rad_s};
    trial_->world.move_to(robot_, root, joints.angle_rad);
    trial_->world.set_velocities(robot_, root, {motion.velocity_m_s, motion.angular_velocity_rad_s}, joints);
    trial_->motors.start_at(joints.angle_rad);
    begin();
  }

  MovingPose motion(int lane) const override {
    const RootPose root = root_pose(lane);
    const Vec3 spin = vec3(bodies_[0].angular_velocity_rad_s);
    const Vec3 com = rotate(root.rotation, robot_.bodies[0].com_m);
    return {.pose = {root, trial_->motors.angles_rad()},
            .velocity_m_s = vec3(bodies_[0].velocity_m_s) - cross(spin, com),
            .angular_velocity_rad_s = spin,
            .joint_speed_rad_s = trial_->motors.speeds_rad_s()};
  }

  void step(const LaneArray& targets_rad) override {
    if (!can_step(targets_rad)) return;
    try {
      trial_->contacts.collide(sensors_.touch);
      trial_->motors.drive(targets_rad);
      if (with_torques_) trial_->torques->before_step(targets_rad);
      // (J M⁻¹ Jᵀ + cfm/h) λ = c/h − J (v/h + M⁻¹ f) with bounds of λ, by Dantzig's pivoting; then v⁺ from
      // λ, and positions with v⁺ (ODE manual, "Constraint Force Mixing (CFM)" and "World Stepping").
      const int stepped =
          quick_sweeps_ > 0 ? quick_step() : dWorldStep(trial_->world.id(), settings_.timestep_s);
      if (stepped == 0) throw ode::Fault("out of memory");
    } catch (const ode::Fault&) {
      healthy_ = false;
      threading_->replace();
      return;
    }
    if (with_torques_) trial_->torques->after_step(torques_nm_);
    if (with_loads_) trial_->contacts.loads(loads_n_);
    read_state();
  }

  void push(int lane, Vec3 impulse_n_s) override {
    check_pushable(lane);
    // ODE adds forces up until the next step, which uses them and sets them back to zero.
    const Vec3 force_n = (1.0 / settings_.timestep_s) * impulse_n_s;
    dBodyAddForce(trial_->world.bodies()[0], force_n.x, force_n.y, force_n.z);
  }

  RootPose root_pose(int lane) const override {
    check_lane(lane);
    const Quat rotation = quat(bodies_[0].rotation);
    return {vec3(bodies_[0].position_m) - rotate(rotation, robot_.bodies[0].com_m), rotation};
  }

  Vec3 root_com_m(int lane) const override {
    check_lane(lane);
    return vec3(bodies_[0].position_m);
  }

  Vec3 com_m(int lane) const override {
    check_lane(lane);
    Vec3 sum;
    for (std::size_t b = 0; b < bodies_.size(); ++b)
      sum = sum + robot_.bodies[b].mass_kg * vec3(bodies_[b].position_m);
    return (1.0 / total_mass_kg_) * sum;
  }

  Vec3 momentum_kg_m_s(int lane) const override {
    check_lane(lane);
    Vec3 sum;
    for (std::size_t b = 0; b < bodies_.size(); ++b)
      sum = sum + robot_.bodies[b].mass_kg * vec3(bodies_[b].velocity_m_s);
    return sum;
  }

  std::uint64_t state_hash(int lane) const override {
    check_lane(lane);
    return hash_bytes(bodies_.data(), bodies_.size() * sizeof(BodyState));
  }

 private:
  void make_trial(int lane) {
    check_lane(lane);
    ode::prepare_thread();
    trial_.reset();
    trial_.emplace(robot_, *threading_, settings_, ground());
    if (quick_sweeps_ > 0) dWorldSetQuickStepNumIterations(trial_->world.id(), quick_sweeps_);
  }

  /// QuickStep shuffles its rows by numbers that the whole process draws from one stream: each step begins
  /// that stream anew, and no two steps at once.
  int quick_step() {
    static std::mutex mutex;
    const std::lock_guard lock(mutex);
    dRandSetSeed(1);
    return dWorldQuickStep(trial_->world.id(), settings_.timestep_s);
  }

  void begin() {
    place_here();
    trial_->contacts.find_touch(sensors_.touch);
    read_state();
  }

  void on_ground() override { trial_.reset(); }

  void read_state() {
    for (std::size_t b = 0; b < bodies_.size(); ++b) {
      const dBodyID body = trial_->world.bodies()[b];
      std::copy_n(dBodyGetPosition(body), 3, bodies_[b].position_m.begin());
      std::copy_n(dBodyGetQuaternion(body), 4, bodies_[b].rotation.begin());
      std::copy_n(dBodyGetLinearVel(body), 3, bodies_[b].velocity_m_s.begin());
      std::copy_n(dBodyGetAngularVel(body), 3, bodies_[b].angular_velocity_rad_s.begin());
      healthy_ = healthy_ && sane(bodies_[b]);
    }
    if (!healthy_) return;
    trial_->motors.read(sensors_.joint_angle_rad);
    sense_attitude(quat(bodies_[0].rotation));
  }

  const EngineSettings settings_;
  const int quick_sweeps_;
  const double total_mass_kg_;
  std::optional<ode::Threading> threading_;
  std::optional<Trial> trial_;
  std::vector<BodyState> bodies_;
};

}  // namespace

}  // namespace amble::physics

// Every program that links this library has the engine: amble_registers() in cmake/AmbleTargets.cmake.
extern "C" const bool amble_registers_physics_ode;
const bool amble_registers_physics_ode = [] {
  using amble::physics::EngineSettings;
  // ODE has data of its own for each thread.
  amble::physics::EngineTraits traits{.lanes = 1, .keeps_to_a_thread = true};
  const auto make = [](const amble::robot::RobotSpec& robot, const EngineSettings& settings) {
    return std::unique_ptr<amble::physics::Engine>(
        std::make_unique<amble::physics::OdeEngine>(robot, settings));
  };
  const auto as_it_is = [make](const amble::robot::RobotSpec& robot, EngineSettings settings) {
    settings.own = {};  // numbers that a champion has for another engine
    return make(robot, settings);
  };
  amble::physics::register_engine({.name = "ode", .traits = traits, .make = as_it_is});
  traits.only_if_named = true;
  amble::physics::register_engine({.name = "ode-variant",
                                   .traits = traits,
                                   .make = make,
                                   .numbers = amble::physics::ode::variant_numbers()});
  return true;
}();
