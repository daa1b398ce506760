// An engine of one's own, without forces: joints turn towards their targets at a limited speed, the robot
// always stands on its lowest point, and the feet that touch the ground push it along.
// Use:
//   amble --plugin build/extend/libpuppet.so evolve examples/extend/puppet.toml --out runs/puppet
#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "amble/core/plugin.hpp"
#include "amble/physics/engine_kinds.hpp"
#include "amble/physics/single_robot.hpp"
#include "amble/robot/pose.hpp"

namespace {

using namespace amble;
using physics::MovingPose;
using physics::RootPose;
using physics::StartPose;

class Puppet final : public physics::SingleRobotEngine {
 public:
  Puppet(const robot::RobotSpec& robot, const physics::EngineSettings& settings)
      : SingleRobotEngine(robot, settings),
        timestep_s_(settings.timestep_s),
        most_turn_rad_(settings.own.numbers.at("speed_rad_s") * settings.timestep_s),
        angles_rad_(robot.joints.size()) {}

  void place(int lane) override {
    place_at(lane, {{robot_.bodies[0].position_m, robot_.bodies[0].rotation},
                    std::vector<double>(robot_.joints.size(), 0.0)});
  }
  void place_at(int lane, const StartPose& pose) override {
    check_lane(lane);
    place_here();
    root_ = pose.root;
    angles_rad_ = pose.joint_angle_rad;
    velocity_m_s_ = push_m_s_ = {};
    stand();
    sense(poses_);
  }
  // It keeps no speed: whatever moved it has no effect in the next step.
  void place_moving(int lane, const MovingPose& motion) override { place_at(lane, motion.pose); }
  MovingPose motion(int) const override {
    return {{root_, angles_rad_}, velocity_m_s_, {}, std::vector<double>(angles_rad_.size(), 0.0)};
  }
  void push(int lane, Vec3 impulse_n_s) override {
    check_pushable(lane);
    push_m_s_ = push_m_s_ + (1.0 / robot_.total_mass_kg()) * impulse_n_s;
  }

  void step(const LaneArray& targets_rad) override {
    if (!can_step(targets_rad)) return;
    const auto before = poses_;
    for (std::size_t j = 0; j < angles_rad_.size(); ++j) {
      const robot::Joint& joint = robot_.joints[j];
      const double target = std::clamp(static_cast<double>(targets_rad.at(static_cast<int>(j), 0)),
                                       joint.lower_rad, joint.upper_rad);
      angles_rad_[j] += std::clamp(target - angles_rad_[j], -most_turn_rad_, most_turn_rad_);
    }
    const Vec3 place_m = root_.position_m;
    root_.position_m = place_m + stride_m(before) + timestep_s_ * push_m_s_;
    stand();
    velocity_m_s_ = (1.0 / timestep_s_) * (root_.position_m - place_m);
    push_m_s_ = {};
    sense(before);
    healthy_ = norm(velocity_m_s_) < physics::absurd_speed;
  }

  RootPose root_pose(int) const override { return root_; }
  Vec3 root_com_m(int) const override { return poses_[0] * robot_.bodies[0].com_m; }
  Vec3 com_m(int) const override {
    Vec3 sum;
    for (std::size_t b = 0; b < poses_.size(); ++b)
      sum = sum + robot_.bodies[b].mass_kg * (poses_[b] * robot_.bodies[b].com_m);
    return (1.0 / robot_.total_mass_kg()) * sum;
  }
  Vec3 momentum_kg_m_s(int) const override { return robot_.total_mass_kg() * velocity_m_s_; }
  std::uint64_t state_hash(int) const override {
    const auto& [position, rotation] = root_;
    std::vector<double> state = angles_rad_;
    state.insert(state.end(), {position.x, position.y, position.z, rotation.w, rotation.x, rotation.y,
                               rotation.z, velocity_m_s_.x, velocity_m_s_.y, velocity_m_s_.z});
    std::uint64_t hash = 0xcbf29ce484222325;  // FNV-1a over 64-bit words
    for (const double value : state) hash = (hash ^ std::bit_cast<std::uint64_t>(value)) * 0x100000001b3;
    return hash ^ (hash >> 32);
  }

 private:
  robot::Pose root() const { return {root_.position_m, root_.rotation}; }
  bool touches(const robot::Leg& leg, std::span<const robot::Pose> poses) const {
    return std::ranges::any_of(leg.foot_geoms, [&](int geom) {
      const Vec3 foot_m = robot::centre_m(robot_.geoms[geom], poses);
      const double ground_m = ground() ? ground()->height_m(foot_m.x, foot_m.y) : 0.0;
      return robot::bottom_m(robot_.geoms[geom], poses) < ground_m + 0.002;
    });
  }
  /// Feet on the ground stay where they are, or as much as they agree on that: so far the root moves.
  Vec3 stride_m(std::span<const robot::Pose> before) const {
    const auto after = robot::poses_at(robot_, root(), angles_rad_);
    Vec3 sum;
    int feet = 0;
    for (const robot::Leg& leg : robot_.legs) {
      if (!touches(leg, before)) continue;
      const robot::Geom& foot = robot_.geoms[leg.foot_geoms[0]];
      sum = sum + robot::centre_m(foot, before) - robot::centre_m(foot, after);
      ++feet;
    }
    return feet == 0 ? Vec3() : Vec3{sum.x / feet, sum.y / feet, 0.0};
  }
  void stand() {
    poses_ = robot::poses_at(robot_, root(), angles_rad_);
    root_.position_m.z -=
        ground() ? ground()->clearance_m(robot_, poses_) : robot::clearance_m(robot_, poses_);
    poses_ = robot::poses_at(robot_, root(), angles_rad_);
  }
  /// Touch is that of the pose before the step, as in all engines.
  void sense(std::span<const robot::Pose> touching) {
    for (std::size_t j = 0; j < angles_rad_.size(); ++j)
      sensors_.joint_angle_rad.at(static_cast<int>(j), 0) = static_cast<float>(angles_rad_[j]);
    for (std::size_t l = 0; l < robot_.legs.size(); ++l)
      sensors_.touch.at(static_cast<int>(l), 0) = touches(robot_.legs[l], touching) ? 1.0f : 0.0f;
    sense_attitude(root_.rotation);
  }

  const double timestep_s_, most_turn_rad_;
  RootPose root_;
  std::vector<double> angles_rad_;
  std::vector<robot::Pose> poses_;  // of all bodies
  Vec3 velocity_m_s_, push_m_s_;
};

}  // namespace

AMBLE_PLUGIN {
  amble::physics::register_engine(
      {.name = "puppet",
       .traits = {.lanes = 1},
       .make = [](const amble::robot::RobotSpec& robot, const amble::physics::EngineSettings& settings)
           -> std::unique_ptr<amble::physics::Engine> { return std::make_unique<Puppet>(robot, settings); },
       .numbers = {{.name = "speed_rad_s",
                    .value = 5.0,
                    .range = {0.01, 100.0},
                    .what = "speed at which joints turn, rad/s"}}});
}
