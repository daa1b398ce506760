#include "amble/physics/mujoco_model/mujoco_model_engine.hpp"

#include <fmt/format.h>
#include <mujoco/mujoco.h>
#include <algorithm>
#include <cmath>
#include <span>

#include "amble/core/check.hpp"
#include "amble/core/error.hpp"
#include "amble/core/hash.hpp"
#include "amble/core/index.hpp"
#include "amble/io/text.hpp"
#include "amble/morphology/mujoco_handlers.hpp"
#include "amble/physics/engine_kinds.hpp"
#include "amble/physics/mujoco_model/actuation.hpp"
#include "amble/physics/mujoco_model/model.hpp"
#include "amble/physics/mujoco_model/uneven_ground.hpp"
#include "amble/physics/single_robot.hpp"

namespace amble::physics {
namespace {

using morphology::vec3;
using robot::RobotSpec;

morphology::MujocoData new_model_data(const mjModel* model) {
  morphology::keep_mujoco_quiet();
  return morphology::new_mujoco_data(model, "the engine mujoco-model");
}

class MujocoModelEngine final : public SingleRobotEngine {
 public:
  MujocoModelEngine(const RobotSpec& robot, const EngineSettings& settings)
      : SingleRobotEngine(robot, settings),
        model_(mujoco_model::make_model(robot_, settings)),
        actuation_(robot_, model_),
        data_(new_model_data(model_.get())),
        uneven_ground_(robot_, model_),
        tick_s_(settings.timestep_s) {
    if (settings.uneven_ground) refuse_runge_kutta();
  }

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
    model_.root.move(model_.get(), motion.velocity_m_s, motion.angular_velocity_rad_s, data_.get());
    for (std::size_t j = 0; j < motion.joint_speed_rad_s.size(); ++j)
      data_->qvel[model_.dof_of[j]] = motion.joint_speed_rad_s[j];
    begin();
  }

  MovingPose motion(int lane) const override {
    const mujoco_model::RootMotion root = model_.root.motion(model_.get(), data_.get());
    MovingPose motion{.pose = {root_pose(lane), {}},
                      .velocity_m_s = root.velocity_m_s,
                      .angular_velocity_rad_s = root.angular_velocity_rad_s,
                      .joint_speed_rad_s = {}};
    for (std::size_t j = 0; j < robot_.joints.size(); ++j) {
      motion.pose.joint_angle_rad.push_back(angle_rad(j));
      motion.joint_speed_rad_s.push_back(data_->qvel[model_.dof_of[j]]);
    }
    return motion;
  }

  void step(const LaneArray& targets_rad) override {
    if (!can_step(targets_rad)) return;
    torques_nm_.set_lane(0, 0.0f);
    loads_n_.set_lane(0, 0.0f);
    try {
      for (int i = 0; i < model_.steps && !data_was_reset(); ++i) step_once(targets_rad, i == 0);
    } catch (const morphology::MujocoError&) {  // too little memory for its contacts
      healthy_ = false;
      return;
    }
    find_touch();
    mju_zero(data_->xfrc_applied + 6 * model_.root.body(), 6);
    read_state();
  }

  void push(int lane, Vec3 impulse_n_s) override {
    check_pushable(lane);
    // xfrc_applied acts at the centre of mass of MuJoCo's body, which may be a part of the robot's root.
    const Vec3 force_n = (1.0 / tick_s_) * impulse_n_s;
    const Vec3 lever_m = root_com_m(lane) - vec3(data_->xipos + 3 * model_.root.body());
    const Vec3 moment_nm = cross(lever_m, force_n);
    const mjtNum wrench[] = {force_n.x, force_n.y, force_n.z, moment_nm.x, moment_nm.y, moment_nm.z};
    mju_addTo(data_->xfrc_applied + 6 * model_.root.body(), wrench, 6);
  }

  RootPose root_pose(int lane) const override {
    check_lane(lane);
    return model_.root.pose(*data_);
  }

  Vec3 root_com_m(int lane) const override {
    const RootPose root = root_pose(lane);
    return root.position_m + rotate(root.rotation, robot_.bodies[0].com_m);
  }

  Vec3 com_m(int lane) const override {
    check_lane(lane);
    return vec3(data_->subtree_com + 3 * model_.root.body());
  }

  Vec3 momentum_kg_m_s(int lane) const override {
    check_lane(lane);
    mj_comVel(model_.get(), data_.get());
    mj_subtreeVel(model_.get(), data_.get());
    return model_->body_subtreemass[model_.root.body()] *
           vec3(data_->subtree_linvel + 3 * model_.root.body());
  }

  std::uint64_t state_hash(int lane) const override {
    check_lane(lane);
    std::uint64_t hash = hash_bytes(data_->qpos, to_index(model_->nq) * sizeof(mjtNum));
    hash = hash_bytes(data_->qvel, to_index(model_->nv) * sizeof(mjtNum), hash);
    hash = hash_bytes(data_->act, to_index(model_->na) * sizeof(mjtNum), hash);
    return hash_span<double>(actuation_.sums_nm(), hash);
  }

  std::vector<std::string> notes() const {
    std::vector<std::string> notes;
    const double own_s = model_.own_timestep_s, now_s = model_->opt.timestep;
    notes.push_back(now_s == own_s
                        ? fmt::format("{} of the model's steps of {:g} s to a tick", model_.steps, own_s)
                        : fmt::format("the model's timestep of {:g} s does not divide a tick of {:g} s: {} "
                                      "steps of {:.4g} s",
                                      own_s, tick_s_, model_.steps, now_s));
    for (std::string& line : actuation_.notes()) notes.push_back(std::move(line));
    int standing = 0, falling = 0;
    for (int g = 0; g < model_->ngeom; ++g) {
      const bool collides = model_->geom_contype[g] != 0 || model_->geom_conaffinity[g] != 0;
      standing += collides && model_.stands(g) && std::ranges::count(model_.grounds, g) == 0;
    }
    for (int b = 1; b < model_->nbody; ++b)
      falling += model_->body_parentid[b] == 0 && b != model_.root.body() && model_->body_weldid[b] != 0;
    if (standing > 0)
      notes.push_back(fmt::format("{} geoms of the model's world are in the way as well", standing));
    if (falling > 0) notes.push_back(fmt::format("{} bodies that are not the robot's move as well", falling));
    const double mass_kg = model_->body_subtreemass[model_.root.body()], of_robot_kg = robot_.total_mass_kg();
    constexpr double rounding = 1e-6;
    if (std::abs(mass_kg - of_robot_kg) > rounding * of_robot_kg)
      notes.push_back(fmt::format("the model weighs {:.4g} kg, the robot {:.4g} kg", mass_kg, of_robot_kg));
    return notes;
  }

 private:
  /// In each counter of warnings: MuJoCo would write the first of a kind to a log file in the current folder.
  /// Where a state has become absurd it resets its data, and these with them.
  static constexpr int warned = 2;

  void reset(int lane) {
    check_lane(lane);
    mj_resetData(model_.get(), data_.get());
    for (mjWarningStat& warning : data_->warning) warning.number = warned;
    std::ranges::copy(model_.start, data_->qpos);
    actuation_.reset();
  }

  void step_once(const LaneArray& targets_rad, bool first) {
    actuation_.drive(targets_rad, first, *data_);
    if (ground() == nullptr)
      mj_step(model_.get(), data_.get());
    else
      step_on_uneven_ground();
    if (with_torques_) add_torques();
    if (with_loads_) add_loads();
  }

  bool data_was_reset() const {
    return std::ranges::any_of(data_->warning,
                               [](const mjWarningStat& warning) { return warning.number < warned; });
  }

  void set_positions(const StartPose& pose) {
    AMBLE_CHECK(pose.joint_angle_rad.size() == robot_.joints.size(), "one angle per joint");
    model_.root.place(model_.get(), pose.root, data_.get());
    for (std::size_t j = 0; j < pose.joint_angle_rad.size(); ++j)
      data_->qpos[model_.position_of[j]] = start_rad(j) + pose.joint_angle_rad[j];
  }

  void begin() {
    place_here();
    find_contacts();
    find_touch();
    read_state();
  }

  void on_ground() override {
    if (ground() != nullptr) refuse_runge_kutta();
    uneven_ground_.set_ground(*model_.mujoco, ground());
  }

  void refuse_runge_kutta() const {
    if (model_->opt.integrator == mjINT_RK4)
      fail(ExitCode::bad_input,
           "the engine mujoco-model: the integrator of robot '{}', RK4, works on flat ground alone",
           io::printable(robot_.name));
  }

  /// mj_fwdPosition, on uneven ground with the contacts of ground::Ground.
  void find_contacts() {
    const mjModel* const m = model_.get();
    mjData* const d = data_.get();
    if (ground() == nullptr) {
      mj_fwdPosition(m, d);
      return;
    }
    mj_kinematics(m, d);
    mj_comPos(m, d);
    mj_tendon(m, d);
    mj_crb(m, d);
    mj_factorM(m, d);
    mj_collision(m, d);
    uneven_ground_.add(*ground(), m, d);
    mj_makeConstraint(m, d);
    mj_transmission(m, d);
    mj_projectConstraint(m, d);
  }

  /// mj_step in its parts (MuJoCo documentation, "Simulation pipeline").
  void step_on_uneven_ground() {
    const mjModel* const m = model_.get();
    mjData* const d = data_.get();
    mj_checkPos(m, d);
    mj_checkVel(m, d);
    find_contacts();
    mj_fwdVelocity(m, d);
    mj_step2(m, d);  // forces, accelerations, integrator
  }

  /// Reads which feet touch what stands in the world.
  void find_touch() {
    sensors_.touch.set_lane(0, 0.0f);
    for (const mjContact& contact : std::span(data_->contact, to_index(data_->ncon))) {
      if (contact.dist > contact.includemargin) continue;
      for (const auto& [foot, other] :
           {std::pair{contact.geom1, contact.geom2}, {contact.geom2, contact.geom1}}) {
        const int leg = model_.leg_of[to_index(foot)];
        if (leg >= 0 && model_.stands(other)) sensors_.touch.at(leg, 0) = 1.0f;
      }
    }
  }

  /// The mean over a tick.
  void add_torques() {
    for (int j = 0; j < torques_nm_.rows(); ++j)
      torques_nm_.at(j, 0) += static_cast<float>(actuation_.torque_nm(to_index(j), *data_) / model_.steps);
  }

  /// The mean over a tick of the contacts' normal forces.
  void add_loads() {
    for (int c = 0; c < data_->ncon; ++c) {
      const mjContact& contact = data_->contact[c];
      mjtNum force[6];
      mj_contactForce(model_.get(), data_.get(), c, force);
      for (const auto& [foot, other] :
           {std::pair{contact.geom1, contact.geom2}, {contact.geom2, contact.geom1}}) {
        const int leg = model_.leg_of[to_index(foot)];
        if (leg >= 0 && model_.stands(other))
          loads_n_.at(leg, 0) += static_cast<float>(force[0] / model_.steps);
      }
    }
  }

  double start_rad(std::size_t joint) const { return model_.start[to_index(model_.position_of[joint])]; }
  double angle_rad(std::size_t joint) const {
    return data_->qpos[model_.position_of[joint]] - start_rad(joint);
  }

  /// Finite, and not absurdly fast (Engine::healthy).
  bool sane() const {
    if (data_was_reset()) return false;
    double sum = 0.0;  // finite only if every number is
    for (const double x : std::span(data_->qpos, to_index(model_->nq))) sum += x;
    for (const double v : std::span(data_->qvel, to_index(model_->nv))) sum += v;
    if (!std::isfinite(sum)) return false;
    const mjtNum* const root = data_->qvel + model_.root.dof();
    bool slow = true;
    if (model_.root.is_free())
      slow = norm(vec3(root)) <= absurd_speed && norm(vec3(root + 3)) <= absurd_speed;
    else
      for (int d = 0; d < model_.root.dofs(); ++d) slow = slow && std::abs(root[d]) <= absurd_speed;
    for (const int dof : model_.dof_of) slow = slow && std::abs(data_->qvel[dof]) <= absurd_speed;
    return slow;
  }

  void read_state() {
    healthy_ = sane();
    if (!healthy_) return;
    // mj_kinematics normalises quaternions, which MuJoCo does when the next step begins.
    positions_.assign(data_->qpos, data_->qpos + model_->nq);
    mj_kinematics(model_.get(), data_.get());
    mj_comPos(model_.get(), data_.get());
    std::ranges::copy(positions_, data_->qpos);
    for (int j = 0; j < sensors_.joint_angle_rad.rows(); ++j)
      sensors_.joint_angle_rad.at(j, 0) = static_cast<float>(angle_rad(to_index(j)));
    sense_attitude(root_pose(0).rotation);
  }

  const mujoco_model::Model model_;
  mujoco_model::Actuation actuation_;
  const morphology::MujocoData data_;
  mujoco_model::UnevenGround uneven_ground_;
  const double tick_s_;
  std::vector<double> positions_;
};

}  // namespace

std::unique_ptr<Engine> make_mujoco_model_engine(const RobotSpec& robot, const EngineSettings& settings) {
  return std::make_unique<MujocoModelEngine>(robot, settings);
}

std::vector<std::string> original_model_notes(const RobotSpec& robot, double timestep_s) {
  return MujocoModelEngine(robot, {.timestep_s = timestep_s}).notes();
}

}  // namespace amble::physics

// Every program that links this library has the engine: amble_registers() in cmake/AmbleTargets.cmake.
extern "C" const bool amble_registers_physics_mujoco_model;
const bool amble_registers_physics_mujoco_model = [] {
  amble::physics::register_engine({.name = "mujoco-model",
                                   .traits = {.lanes = 1, .of_original_model = true},
                                   .make = amble::physics::make_mujoco_model_engine});
  return true;
}();
