#include "amble/physics/damaged_engine.hpp"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "amble/core/check.hpp"
#include "amble/core/error.hpp"
#include "amble/core/index.hpp"
#include "amble/damage/stages.hpp"
#include "amble/robot/collision_points.hpp"
#include "amble/robot/pose.hpp"

namespace amble::physics {
namespace {

/// Rounded up to a micrometre or so, which hides the last bits of the sines behind it.
double rounded_up(double height_m) {
  constexpr double per_metre = 0x1p20;
  return std::ceil(height_m * per_metre) / per_metre;
}

class DamagedEngine final : public Engine {
 public:
  DamagedEngine(std::string_view name, const robot::RobotSpec& robot, const damage::Settings& damage,
                const EngineSettings& settings)
      : robot_(robot), torques_(settings.torques), loads_(settings.loads) {
    for (damage::Stage& stage : damage::stages_of(robot, damage)) {
      auto engine = make_engine(name, stage.robot, settings);
      const int first_step = damage::first_step(stage.from_s, settings.timestep_s);
      LaneArray targets(static_cast<int>(stage.joint_of.size()), engine->lanes());
      stages_.push_back({std::move(stage), first_step, std::move(engine), std::move(targets)});
    }
    const int lanes = stages_[0].engine->lanes(), joints = static_cast<int>(robot.joints.size());
    lanes_.resize(to_index(lanes));
    sensors_.joint_angle_rad = LaneArray(joints, lanes);
    sensors_.touch = LaneArray(static_cast<int>(robot.legs.size()), lanes);
    sensors_.attitude_rad = LaneArray(3, lanes);
    if (torques_) torques_nm_ = LaneArray(joints, lanes);
    if (loads_) loads_n_ = LaneArray(static_cast<int>(robot.legs.size()), lanes);
  }

  int lanes() const override { return static_cast<int>(lanes_.size()); }

  void place(int lane) override {
    if (stages_[0].damage.locks.empty()) {
      begin(lane);
      stages_[0].engine->place(lane);
      sense(lane);
    } else {
      place_at(lane, {{robot_.bodies[0].position_m, robot_.bodies[0].rotation},
                      std::vector<double>(robot_.joints.size(), 0.0)});
    }
  }

  void place_at(int lane, const StartPose& pose) override {
    begin(lane);
    stages_[0].engine->place_at(lane, of_stage(stages_[0], with_locks(pose)));
    sense(lane);
  }

  void place_moving(int lane, const MovingPose& motion) override {
    begin(lane);
    stages_[0].engine->place_moving(lane, of_stage(stages_[0], motion));
    sense(lane);
  }

  MovingPose motion(int lane) const override {
    const Stage& stage = stage_of(lane);
    MovingPose inner = stage.engine->motion(lane);
    MovingPose motion = inner;
    motion.pose.joint_angle_rad = spread(stage, inner.pose.joint_angle_rad);
    motion.joint_speed_rad_s = spread(stage, inner.joint_speed_rad_s);
    return motion;
  }

  void retire(int lane) override {
    state(lane).placed = false;
    for (Stage& stage : stages_) stage.engine->retire(lane);
  }

  void step(const LaneArray& targets_rad) override {
    AMBLE_CHECK(targets_rad.rows() == sensors_.joint_angle_rad.rows() && targets_rad.lanes() == lanes(),
                "targets");
    for (int lane = 0; lane < lanes(); ++lane) before_step(lane, targets_rad);
    for (std::size_t s = 0; s < stages_.size(); ++s)
      if (std::ranges::any_of(lanes_, [s](const Lane& lane) { return lane.placed && lane.stage == s; }))
        stages_[s].engine->step(stages_[s].targets_rad);
    for (int lane = 0; lane < lanes(); ++lane)
      if (state(lane).placed) sense(lane);
  }

  void push(int lane, Vec3 impulse_n_s) override {
    AMBLE_CHECK(state(lane).placed, "only a placed robot can be pushed");
    state(lane).push_n_s = state(lane).push_n_s + impulse_n_s;
  }

  bool healthy(int lane) const override { return stage_of(lane).engine->healthy(lane); }
  const robot::SensorFrame& sensors() const override { return sensors_; }
  const LaneArray* motor_torque_nm() const override { return torques_ ? &torques_nm_ : nullptr; }
  const LaneArray* foot_load_n() const override { return loads_ ? &loads_n_ : nullptr; }
  RootPose root_pose(int lane) const override { return stage_of(lane).engine->root_pose(lane); }
  Vec3 root_com_m(int lane) const override { return stage_of(lane).engine->root_com_m(lane); }
  Vec3 com_m(int lane) const override { return stage_of(lane).engine->com_m(lane); }
  Vec3 momentum_kg_m_s(int lane) const override { return stage_of(lane).engine->momentum_kg_m_s(lane); }
  std::uint64_t state_hash(int lane) const override { return stage_of(lane).engine->state_hash(lane); }

 private:
  struct Stage {
    damage::Stage damage;
    int first_step;  ///< from 1
    std::unique_ptr<Engine> engine;
    LaneArray targets_rad;  ///< of its joints
  };
  struct Lane {
    bool placed = false;
    std::size_t stage = 0;
    int step = 0;        ///< the last one
    Vec3 push_n_s = {};  ///< in the next step
  };

  void check_lane(int lane) const { AMBLE_CHECK(lane >= 0 && lane < lanes(), "there is no such lane"); }
  Lane& state(int lane) {
    check_lane(lane);
    return lanes_[to_index(lane)];
  }
  const Stage& stage_of(int lane) const {
    check_lane(lane);
    return stages_[lanes_[to_index(lane)].stage];
  }

  /// Each stage's engine has a ground made for its own robot: the same where it touches with the same radii.
  void on_ground() override {
    const ground::Ground* const all = ground();
    for (Stage& stage : stages_) {
      std::shared_ptr<const ground::Ground> own(std::shared_ptr<const void>(), all);  // kept by Engine
      if (all != nullptr && robot::contact_radii_m(stage.damage.robot) != robot::contact_radii_m(robot_))
        own = std::make_shared<const ground::Ground>(all->surface(), stage.damage.robot);
      stage.engine->set_ground(std::move(own));
    }
  }

  void begin(int lane) {
    retire(lane);
    state(lane) = {.placed = true};
  }

  /// The pose with locked joints at their angles; lifted if that makes the robot reach lower.
  StartPose with_locks(const StartPose& pose) const {
    StartPose locked = pose;
    for (const auto& [joint, angle_rad] : stages_[0].damage.locks) locked.joint_angle_rad[joint] = angle_rad;
    const double sunk_m = clearance_m(pose) - clearance_m(locked);
    if (sunk_m > 0.0) locked.root.position_m.z += rounded_up(sunk_m);
    return locked;
  }

  /// Height over the ground of the lowest point of the robot with which trials begin.
  double clearance_m(const StartPose& pose) const {
    const StartPose own = of_stage(stages_[0], pose);
    const robot::RobotSpec& robot = stages_[0].damage.robot;
    const auto poses = robot::poses_at(robot, {own.root.position_m, own.root.rotation}, own.joint_angle_rad);
    return ground() ? ground()->clearance_m(robot, poses) : robot::clearance_m(robot, poses);
  }

  /// Numbers of the intact robot's joints → those of a stage's joints.
  static std::vector<double> gathered(const Stage& stage, const std::vector<double>& all) {
    std::vector<double> own;
    for (const int joint : stage.damage.joint_of) own.push_back(all[to_index(joint)]);
    return own;
  }
  /// The reverse, with 0 for missing joints.
  std::vector<double> spread(const Stage& stage, const std::vector<double>& own) const {
    std::vector<double> all(robot_.joints.size(), 0.0);
    for (std::size_t j = 0; j < own.size(); ++j) all[to_index(stage.damage.joint_of[j])] = own[j];
    return all;
  }
  StartPose of_stage(const Stage& stage, const StartPose& pose) const {
    AMBLE_CHECK(pose.joint_angle_rad.size() == robot_.joints.size(), "one angle per joint");
    return {pose.root, gathered(stage, pose.joint_angle_rad)};
  }
  MovingPose of_stage(const Stage& stage, const MovingPose& motion) const {
    MovingPose own = motion;
    own.pose = of_stage(stage, motion.pose);
    own.joint_speed_rad_s = gathered(stage, motion.joint_speed_rad_s);
    return own;
  }

  /// Moves the lane to the stage of its next step, and hands on its targets and push.
  void before_step(int lane, const LaneArray& targets_rad) {
    Lane& own = state(lane);
    if (!own.placed) return;
    ++own.step;
    std::size_t next = own.stage;
    while (next + 1 < stages_.size() && stages_[next + 1].first_step <= own.step) ++next;
    if (next != own.stage && healthy(lane)) {
      const MovingPose now = motion(lane);
      stages_[own.stage].engine->retire(lane);
      own.stage = next;
      stages_[next].engine->place_moving(lane, of_stage(stages_[next], now));
    }
    Stage& stage = stages_[own.stage];
    if (own.push_n_s != Vec3{}) stage.engine->push(lane, std::exchange(own.push_n_s, {}));
    const std::vector<int>& joint_of = stage.damage.joint_of;
    for (std::size_t j = 0; j < joint_of.size(); ++j)
      stage.targets_rad.at(static_cast<int>(j), lane) = targets_rad.at(joint_of[j], lane);
    for (const auto& [joint, angle_rad] : stage.damage.locks) {
      const auto j =
          static_cast<int>(std::ranges::find(joint_of, static_cast<int>(joint)) - joint_of.begin());
      stage.targets_rad.at(j, lane) = static_cast<float>(angle_rad);
    }
  }

  /// Copies a lane's sensors, torques and loads from its stage. A lock's torque is no motor's.
  void sense(int lane) {
    const Stage& stage = stage_of(lane);
    const robot::SensorFrame& own = stage.engine->sensors();
    sensors_.joint_angle_rad.set_lane(lane, 0.0f);
    sensors_.touch.set_lane(lane, 0.0f);
    torques_nm_.set_lane(lane, 0.0f);
    loads_n_.set_lane(lane, 0.0f);
    for (int a = 0; a < 3; ++a) sensors_.attitude_rad.at(a, lane) = own.attitude_rad.at(a, lane);
    for (std::size_t l = 0; l < stage.damage.leg_of.size(); ++l) {
      const int leg = stage.damage.leg_of[l], inner = static_cast<int>(l);
      sensors_.touch.at(leg, lane) = own.touch.at(inner, lane);
      if (loads_) loads_n_.at(leg, lane) = stage.engine->foot_load_n()->at(inner, lane);
    }
    for (std::size_t j = 0; j < stage.damage.joint_of.size(); ++j) {
      const int joint = stage.damage.joint_of[j], inner = static_cast<int>(j);
      sensors_.joint_angle_rad.at(joint, lane) = own.joint_angle_rad.at(inner, lane);
      if (torques_) torques_nm_.at(joint, lane) = stage.engine->motor_torque_nm()->at(inner, lane);
    }
    if (torques_)
      for (const damage::Lock& lock : stage.damage.locks)
        torques_nm_.at(static_cast<int>(lock.joint), lane) = 0.0f;
  }

  const robot::RobotSpec robot_;
  const bool torques_, loads_;
  std::vector<Stage> stages_;
  std::vector<Lane> lanes_;
  robot::SensorFrame sensors_;
  LaneArray torques_nm_, loads_n_;
};

}  // namespace

std::unique_ptr<Engine> make_damaged_engine(std::string_view name, const robot::RobotSpec& robot,
                                            const damage::Settings& damage, const EngineSettings& settings) {
  if (!damage.changes_body()) return make_engine(name, robot, settings);
  if (engine_traits(name).of_original_model)
    fail(ExitCode::bad_input,
         "the engine {} simulates the robot's own model, which is whole: of damages it knows numb feet alone",
         name);
  return std::make_unique<DamagedEngine>(name, robot, damage, settings);
}

}  // namespace amble::physics
