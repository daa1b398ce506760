#include "amble/physics/batch/solver_error.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "amble/core/index.hpp"
#include "amble/physics/batch/lockstep_state.hpp"
#include "amble/physics/batch/model.hpp"
#include "amble/physics/batch/step.hpp"
#include "amble/robot/legs.hpp"
#include "amble/robot/pose.hpp"

namespace amble::physics {
namespace {

using batch::LockstepState;
using batch::Model;
using batch::StateRows;

/// Dry friction of this share of a motor's torque holds its joint for a while.
constexpr double held_share = 0.5;

Model with_sweeps(const robot::RobotSpec& robot, int sweeps) {
  Model model(robot);
  model.iterations = sweeps;
  return model;
}

/// How far a joint of dry friction moves its foot per radian, by link; 0 of other joints. What holds them is
/// no velocity of the root.
std::vector<double> held_levers_m(const robot::RobotSpec& robot, const Model& model) {
  const std::vector<robot::Pose> poses = robot::start_poses(robot);
  std::vector<double> by_joint(robot.joints.size(), 0.0), by_link;
  for (const robot::Leg& leg : robot.legs)
    for (int body = robot.foot_body(leg); body > 0; body = robot.bodies[to_index(body)].parent)
      for (const int j : robot.joints_of_body(body)) {
        const robot::Joint& joint = robot.joints[to_index(j)];
        if (joint.friction_loss_nm >= held_share * joint.servo.max_torque_nm && joint.has_motor())
          by_joint[to_index(j)] =
              norm(robot::foot_m(robot, leg, poses) - poses[to_index(body)] * joint.anchor_m);
      }
  for (const batch::Link& link : model.links) by_link.push_back(by_joint[to_index(link.joint)]);
  return by_link;
}

/// Sixteen robots that follow sine waves, advanced with as many sweeps as are allowed.
class Probe {
 public:
  Probe(const robot::RobotSpec& robot, double timestep_s)
      : robot_(robot),
        timestep_s_(timestep_s),
        model_(with_sweeps(robot, robot::most_sweeps)),
        rows_(model_),
        workspace_(model_),
        now_(model_, rows_),
        next_(model_, rows_),
        targets_rad_(rows_.links, batch::lanes),
        levers_m_(held_levers_m(robot, model_)) {
    const auto engine = make_batch_engine(robot, {.timestep_s = timestep_s});
    for (int lane = 0; lane < batch::lanes; ++lane) {
      engine->place(lane);
      now_.at(StateRows::active, lane) = now_.at(StateRows::healthy, lane) = 1.0f;
      now_.set_state(lane, engine->state(lane));
    }
    batch::derive(arguments(model_, now_));
  }

  /// Computes the next state.
  void step() {
    set_targets();
    copy(next_, now_);
    batch::step(arguments(model_, next_), targets_rad_);
  }

  /// Adds the differences of a step with another model's sweeps to `sum`, and returns their number.
  int compare(const Model& model, double& sum) {
    LockstepState other(model, rows_);
    copy(other, now_);
    batch::step(arguments(model, other), targets_rad_);
    int count = 0;
    for (int lane = 0; lane < batch::lanes; ++lane) {
      if (now_.at(StateRows::contacts, lane) == 0.0f || next_.at(StateRows::healthy, lane) == 0.0f) continue;
      double most_m_s = norm(other.vec3(StateRows::velocity, lane) - next_.vec3(StateRows::velocity, lane));
      for (std::size_t link = 0; link < levers_m_.size(); ++link) {
        const int row = rows_.speed + static_cast<int>(link);
        most_m_s = std::max(most_m_s, levers_m_[link] * std::abs(other.at(row, lane) - next_.at(row, lane)));
      }
      sum += most_m_s;
      ++count;
    }
    return count;
  }

  void advance() {
    copy(now_, next_);
    ++tick_;
  }

 private:
  batch::StepArguments arguments(const Model& model, LockstepState& robots) {
    workspace_.attach();
    return {.model = model,
            .rows = rows_,
            .state = robots.rows(),
            .workspace = workspace_,
            .sensors = robots.sensors(),
            .ground = nullptr,
            .torques_nm = nullptr,
            .timestep_s = static_cast<float>(timestep_s_)};
  }

  static void copy(LockstepState& to, const LockstepState& from) {
    for (int lane = 0; lane < batch::lanes; ++lane) to.copy(lane, from, lane);
  }

  /// Sine waves of 0.5 to 2 Hz by lane, of 0.3 to 1 of a joint's range or of 0.8 rad, which grow for 0.2 s.
  void set_targets() {
    constexpr double golden = std::numbers::phi - 1.0, most_rad = 0.8, grow_s = 0.2;
    const double time_s = tick_ * timestep_s_;
    for (std::size_t j = 0; j < robot_.joints.size(); ++j) {
      const robot::AngleRange range = robot_.joints[j].command_range();
      const double lower = std::max(range.lower_rad, -most_rad), upper = std::min(range.upper_rad, most_rad);
      for (int lane = 0; lane < batch::lanes; ++lane) {
        const double share = (lane + 0.5) / batch::lanes, frequency_hz = 0.5 + 1.5 * share;
        const double phase = golden * static_cast<double>(batch::lanes * static_cast<int>(j) + lane);
        const double wave = std::sin(2.0 * std::numbers::pi * (frequency_hz * time_s + phase));
        const double amplitude = (0.3 + 0.7 * share) * 0.5 * (upper - lower) * std::min(1.0, time_s / grow_s);
        targets_rad_.row(static_cast<int>(j))[lane] =
            static_cast<float>(std::clamp(amplitude * wave, range.lower_rad, range.upper_rad));
      }
    }
  }

  const robot::RobotSpec& robot_;
  const double timestep_s_;
  const Model model_;
  const StateRows rows_;
  batch::Workspace workspace_;
  LockstepState now_, next_;
  LaneArray targets_rad_;
  const std::vector<double> levers_m_;  ///< by link
  int tick_ = 0;
};

}  // namespace

std::vector<double> solver_errors_m_s(const robot::RobotSpec& robot, double timestep_s,
                                      std::span<const int> sweeps) {
  constexpr double duration_s = 1.0;
  std::vector<Model> models;
  models.reserve(sweeps.size());
  for (const int count : sweeps) models.push_back(with_sweeps(robot, count));
  std::vector<double> sums(sweeps.size(), 0.0);
  std::vector<int> counts(sweeps.size(), 0);
  Probe probe(robot, timestep_s);
  for (int tick = 0; tick < std::lround(duration_s / timestep_s); ++tick) {
    probe.step();
    for (std::size_t i = 0; i < models.size(); ++i) counts[i] += probe.compare(models[i], sums[i]);
    probe.advance();
  }
  for (std::size_t i = 0; i < sums.size(); ++i) sums[i] /= std::max(1, counts[i]);
  return sums;
}

SweepsAdvice sweeps_advice(const robot::RobotSpec& robot, double timestep_s) {
  // Rounding alone can leave 0.003, which no number of sweeps gets below.
  constexpr double carries_over_m_s = 0.015, good_m_s = 0.005;
  const int own = Model(robot).iterations;
  const std::array<int, 11> tried{own, 20, 28, 40, 56, 80, 112, 160, 224, 320, 450};
  const std::vector<double> errors = solver_errors_m_s(robot, timestep_s, tried);
  SweepsAdvice advice{own, errors[0], own, errors[0]};
  if (errors[0] <= carries_over_m_s) return advice;
  for (std::size_t i = 1; i < tried.size() && advice.better_error_m_s > good_m_s; ++i)
    if (tried[i] > own) {
      advice.better_sweeps = tried[i];
      advice.better_error_m_s = errors[i];
    }
  return advice;
}

}  // namespace amble::physics
