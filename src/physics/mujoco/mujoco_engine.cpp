#include <mujoco/mujoco.h>
#include <algorithm>
#include <cmath>
#include <memory>
#include <span>
#include <vector>

#include "amble/core/check.hpp"
#include "amble/core/hash.hpp"
#include "amble/core/index.hpp"
#include "amble/morphology/mujoco_handlers.hpp"
#include "amble/physics/engine.hpp"
#include "amble/physics/engine_kinds.hpp"
#include "amble/physics/mujoco/contacts.hpp"
#include "amble/physics/mujoco/model.hpp"
#include "amble/physics/single_robot.hpp"

namespace amble::physics {
namespace {

using morphology::vec3;
using robot::RobotSpec;
using robot::Servo;
using robot::ServoMode;

/// MuJoCo's ids: the ground is its first geom, the root the only child of its world body.
constexpr int ground_geom = 0, root_body = 1;

/// MuJoCo 2.2: one robot per engine, double precision, joint angles as coordinates, semi-implicit Euler
/// without substeps, at most 20 iterations of Newton's method to a tolerance of 1e-10, elliptic friction
/// cones. Contacts, stops and velocity servos have the erp and cfm of RobotSpec::contact, as in ODE
/// (mujoco/model.cpp); the torque servo applies its torque for a whole step. A cfm so small that MuJoCo's
/// impedance would exceed 0.9999 is raised to that. Bodies joined by a joint never collide; of more than 512
/// contacts the rest is left out. Healthy means: the speeds of the root and of all joints. Throws UserError
/// for what MuJoCo's compiler refuses.
class MujocoEngine final : public SingleRobotEngine {
 public:
  MujocoEngine(const RobotSpec& robot, const EngineSettings& settings)
      : SingleRobotEngine(robot, settings),
        model_(mujoco::make_model(robot, settings.timestep_s)),
        data_(morphology::new_mujoco_data(model_.get(), "the mujoco engine")),
        ground_contacts_(robot, model_),
        slip_(robot.contact.friction, settings.timestep_s) {}

  void place(int lane) override {
    reset(lane);
    begin();
  }

  void place_at(int lane, const StartPose& pose) override {
    reset(lane);
    set_positions(pose);
    begin();
  }

  void place_moving(int lane, const MovingPose& motion) override {
    reset(lane);
    set_positions(motion.pose);
    // A free joint's angular velocity is in the axes of its body.
    const Vec3 v = motion.velocity_m_s,
               w = rotate(conjugate(motion.pose.root.rotation), motion.angular_velocity_rad_s);
    const mjtNum root[] = {v.x, v.y, v.z, w.x, w.y, w.z};
    std::ranges::copy(root, data_->qvel);
    for (std::size_t j = 0; j < motion.joint_speed_rad_s.size(); ++j)
      data_->qvel[model_.dof_of[j]] = motion.joint_speed_rad_s[j];
    begin();
  }

  MovingPose motion(int lane) const override {
    const RootPose root = root_pose(lane);
    MovingPose motion{.pose = {root, {}},
                      .velocity_m_s = vec3(data_->qvel),
                      .angular_velocity_rad_s = rotate(root.rotation, vec3(data_->qvel + 3)),
                      .joint_speed_rad_s = {}};
    for (std::size_t j = 0; j < robot_.joints.size(); ++j) {
      motion.pose.joint_angle_rad.push_back(data_->qpos[model_.position_of[j]]);
      motion.joint_speed_rad_s.push_back(data_->qvel[model_.dof_of[j]]);
    }
    return motion;
  }

  void step(const LaneArray& targets_rad) override {
    // mj_step in its parts (MuJoCo documentation, "Simulation pipeline"): M(q) and constraints, bias forces,
    // M q̈ = τ − c + Jᵀ f, then semi-implicit Euler. Between them come the servos and the correction for slip.
    if (!can_step(targets_rad)) return;
    find_contacts();
    find_touch();
    mj_fwdVelocity(model_.get(), data_.get());
    drive(targets_rad);
    mj_fwdAcceleration(model_.get(), data_.get());
    slip_.solve(model_.get(), data_.get());
    if (with_torques_) measure_torques();
    if (with_loads_) measure_loads();
    mj_Euler(model_.get(), data_.get());
    mju_zero3(data_->xfrc_applied + 6 * root_body);
    read_state();
  }

  void push(int lane, Vec3 impulse_n_s) override {
    check_pushable(lane);
    // xfrc_applied acts at the body's centre of mass: force = impulse / h, for one step.
    mjtNum* const force_n = data_->xfrc_applied + 6 * root_body;
    const mjtNum impulse[] = {impulse_n_s.x, impulse_n_s.y, impulse_n_s.z};
    mju_addToScl3(force_n, impulse, 1.0 / model_->opt.timestep);
  }

  RootPose root_pose(int lane) const override {
    check_lane(lane);
    const mjtNum* q = data_->qpos;
    return {vec3(q), Quat{q[3], q[4], q[5], q[6]}};
  }

  Vec3 root_com_m(int lane) const override {
    check_lane(lane);
    return vec3(data_->xipos + 3 * root_body);
  }

  Vec3 com_m(int lane) const override {
    check_lane(lane);
    return vec3(data_->subtree_com + 3 * root_body);
  }

  Vec3 momentum_kg_m_s(int lane) const override {
    check_lane(lane);
    mj_comVel(model_.get(), data_.get());
    mj_subtreeVel(model_.get(), data_.get());
    return model_->body_subtreemass[root_body] * vec3(data_->subtree_linvel + 3 * root_body);
  }

  std::uint64_t state_hash(int lane) const override {
    check_lane(lane);
    const std::uint64_t of_position = hash_bytes(data_->qpos, to_index(model_->nq) * sizeof(mjtNum));
    return hash_bytes(data_->qvel, to_index(model_->nv) * sizeof(mjtNum), of_position);
  }

 private:
  void reset(int lane) {
    check_lane(lane);
    mj_resetData(model_.get(), data_.get());
    // MuJoCo would write the first warning of each kind to a log file in the current folder.
    for (mjWarningStat& warning : data_->warning) warning.number = 1;
  }

  void set_positions(const StartPose& pose) {
    AMBLE_CHECK(pose.joint_angle_rad.size() == robot_.joints.size(), "one angle per joint");
    const auto& [position_m, rotation] = pose.root;
    const mjtNum root[] = {position_m.x, position_m.y, position_m.z, rotation.w,
                           rotation.x,   rotation.y,   rotation.z};
    std::ranges::copy(root, data_->qpos);
    for (std::size_t j = 0; j < pose.joint_angle_rad.size(); ++j)
      data_->qpos[model_.position_of[j]] = pose.joint_angle_rad[j];
  }

  void begin() {
    place_here();
    find_contacts();
    find_touch();
    read_state();
  }

  void on_ground() override { ground_contacts_.set_ground(*model_.mujoco, ground()); }

  /// mj_fwdPosition; on uneven ground in its parts, with the contacts of ground::Ground added to MuJoCo's
  /// own.
  void find_contacts() {
    if (ground() == nullptr) {
      mj_fwdPosition(model_.get(), data_.get());
      return;
    }
    mj_kinematics(model_.get(), data_.get());
    mj_comPos(model_.get(), data_.get());
    mj_tendon(model_.get(), data_.get());
    mj_crb(model_.get(), data_.get());
    mj_factorM(model_.get(), data_.get());
    mj_collision(model_.get(), data_.get());
    ground_contacts_.add(*ground(), model_.get(), data_.get());
    mj_makeConstraint(model_.get(), data_.get());
    mj_projectConstraint(model_.get(), data_.get());
  }

  /// Reads which feet touch the ground.
  void find_touch() {
    sensors_.touch.set_lane(0, 0.0f);
    for (const mjContact& contact : std::span(data_->contact, to_index(data_->ncon))) {
      if (contact.geom1 != ground_geom) continue;
      const int leg = model_.leg_of[to_index(contact.geom2)];
      if (leg >= 0) sensors_.touch.at(leg, 0) = 1.0f;
    }
  }

  /// Applies the servos by moving their rows' a_ref, and the joints' damping −d q̇ (set_joints()).
  void drive(const LaneArray& targets_rad) {
    for (int j = 0; j < targets_rad.rows(); ++j) {
      const int dof = model_.dof_of[to_index(j)];
      data_->qfrc_applied[dof] = -robot_.joints[to_index(j)].damping_nm_s_per_rad * data_->qvel[dof];
    }
    for_servo_rows([&](int row, int j) {
      const Servo servo = robot_.joints[to_index(j)].acting_servo();
      if (servo.mode == ServoMode::velocity) {
        // MuJoCo's dry friction in a joint has a_ref = −b q̇ (efc_KBIP: stiffness, damping b, impedance and
        // its derivative, by row). A motor has a_ref = −b (q̇ − speed) with speed = gain (target − q).
        const double speed_rad_s = servo.gain_per_s * error_rad(j, targets_rad);
        data_->efc_aref[row] += data_->efc_KBIP[4 * row + 1] * speed_rad_s;
      } else {
        drive_stiffly(row, j, error_rad(j, targets_rad));
      }
    });
  }

  /// A torque servo by backward Euler, τ = kp (target − q − h q̇⁺) − kd q̇⁺ = k (speed − q̇⁺) with
  /// k = kp h + kd and speed = kp (target − q) / k. As q̇⁺ = q̇ + h a, that is
  ///   a = a_ref − R τ,   R = 1 / (k h),   a_ref = (speed − q̇) / h.
  void drive_stiffly(int row, int j, double error_rad) {
    const Servo servo = robot_.joints[to_index(j)].acting_servo();
    const double h = model_->opt.timestep, k = servo.kp_nm_per_rad * h + servo.kd_nm_s_per_rad;
    // Without any strength, R as good as infinite.
    const double stiffness = std::max(k * h, mjMINVAL);
    const double speed_rad_s = k > 0.0 ? servo.kp_nm_per_rad * error_rad / k : 0.0;
    data_->efc_R[row] = 1.0 / stiffness;
    data_->efc_D[row] = stiffness;
    data_->efc_aref[row] = (speed_rad_s - data_->qvel[model_.dof_of[to_index(j)]]) / h;
  }

  /// Calls use(row, joint) for the rows of servos among MuJoCo's constraints.
  template <typename Use>
  void for_servo_rows(Use use) {
    for (int row = data_->ne; row < data_->ne + data_->nf; ++row)
      if (data_->efc_type[row] == mjCNSTR_FRICTION_DOF)
        use(row, model_.joint_of[to_index(data_->efc_id[row])]);
  }

  /// The servos' torques, once the constraints are solved.
  void measure_torques() {
    for (int j = 0; j < torques_nm_.rows(); ++j) torques_nm_.at(j, 0) = 0.0f;
    for_servo_rows([&](int row, int j) {
      if (robot_.joints[to_index(j)].has_motor())
        torques_nm_.at(j, 0) = static_cast<float>(data_->efc_force[row]);
    });
  }

  /// The contacts' normal forces, once the constraints are solved.
  void measure_loads() {
    loads_n_.set_lane(0, 0.0f);
    for (int c = 0; c < data_->ncon; ++c) {
      const mjContact& contact = data_->contact[c];
      const int leg = contact.geom1 == ground_geom ? model_.leg_of[to_index(contact.geom2)] : -1;
      if (leg < 0) continue;
      mjtNum force[6];
      mj_contactForce(model_.get(), data_.get(), c, force);
      loads_n_.at(leg, 0) += static_cast<float>(force[0]);
    }
  }

  double error_rad(int j, const LaneArray& targets_rad) const {
    const robot::Joint& joint = robot_.joints[to_index(j)];
    const double angle_rad = data_->qpos[model_.position_of[to_index(j)]];
    if (!joint.has_motor()) return joint.rest_rad - angle_rad;
    const double target_rad =
        std::clamp(static_cast<double>(targets_rad.at(j, 0)), joint.lower_rad, joint.upper_rad);
    return target_rad - angle_rad;
  }

  /// Finite, and not absurdly fast (Engine::healthy).
  bool sane() const {
    double sum = 0.0;  // finite only if every number is
    for (const double x : std::span(data_->qpos, to_index(model_->nq))) sum += x;
    for (const double v : std::span(data_->qvel, to_index(model_->nv))) sum += v;
    if (!std::isfinite(sum)) return false;
    bool slow = norm(vec3(data_->qvel)) <= absurd_speed && norm(vec3(data_->qvel + 3)) <= absurd_speed;
    for (const int dof : model_.dof_of) slow = slow && std::abs(data_->qvel[dof]) <= absurd_speed;
    return slow;
  }

  void read_state() {
    healthy_ = sane();
    if (!healthy_) return;
    mj_kinematics(model_.get(), data_.get());
    mj_comPos(model_.get(), data_.get());
    for (int j = 0; j < sensors_.joint_angle_rad.rows(); ++j)
      sensors_.joint_angle_rad.at(j, 0) = static_cast<float>(data_->qpos[model_.position_of[to_index(j)]]);
    sense_attitude(root_pose(0).rotation);
  }

  const mujoco::Model model_;
  const morphology::MujocoData data_;
  mujoco::GroundContacts ground_contacts_;
  mujoco::Slip slip_;
};

}  // namespace

}  // namespace amble::physics

// Every program that links this library has the engine: amble_registers() in cmake/AmbleTargets.cmake.
extern "C" const bool amble_registers_physics_mujoco;
const bool amble_registers_physics_mujoco = [] {
  amble::physics::register_engine(
      {.name = "mujoco",
       .traits = {.lanes = 1},
       .make = [](const amble::robot::RobotSpec& robot,
                  const amble::physics::EngineSettings& settings) -> std::unique_ptr<amble::physics::Engine> {
         return std::make_unique<amble::physics::MujocoEngine>(robot, settings);
       }});
  return true;
}();
