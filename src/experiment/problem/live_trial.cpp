#include "amble/experiment/problem/live_trial.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "amble/core/check.hpp"
#include "amble/core/error.hpp"
#include "amble/robot/pose.hpp"

namespace amble::experiment {
namespace {

constexpr double most_lift_m = 100.0;

/// Rounded up to a micrometre or so, which hides the last bits of the sines behind it.
double rounded_up(double height_m) {
  constexpr double per_metre = 0x1p20;
  return std::ceil(height_m * per_metre) / per_metre;
}

double clearance_m(const robot::RobotSpec& robot, const ground::Ground* ground,
                   const physics::StartPose& pose) {
  const auto bodies =
      robot::poses_at(robot, {pose.root.position_m, pose.root.rotation}, pose.joint_angle_rad);
  return ground != nullptr ? ground->clearance_m(robot, bodies) : robot::clearance_m(robot, bodies);
}

/// That of the trial, without its end.
trial::Protocol endless(const Problem& problem) {
  trial::Protocol protocol = problem.protocol({});
  protocol.steps = std::numeric_limits<int>::max();
  protocol.fall.below_m = -std::numeric_limits<double>::infinity();
  protocol.fall.above_m = protocol.fall.tilt_rad = std::numeric_limits<double>::infinity();
  protocol.measures = {};
  return protocol;
}

}  // namespace

LiveTrial::LiveTrial(const Problem& problem, const neat::Genome& genome)
    : problem_(problem),
      ground_(problem_.make_ground(problem_.ground_key)),
      engine_(problem_.make_engine()),
      controllers_(problem_.architecture->make_batch(engine_->lanes())),
      parameters_(problem_.decode(genome)),
      task_(std::make_unique<trial::OneTask>(parameters_)) {
  if (ground_) engine_->set_ground(ground_);
  runner_ = std::make_unique<trial::Runner>(*engine_, *controllers_, endless(problem_));
  runner_->begin(*task_);
}

void LiveTrial::apply(const Input& input) {
  AMBLE_CHECK(input.step == steps_ + 1, "an input comes before the next step");
  if (!healthy_) return;
  if (input.command && !obeys())
    fail(ExitCode::bad_input,
         "command: the controller of \"{}\" senses no commands; configs/steer evolves one that does",
         problem_.robot.name);
  if (input.lift_m && !(*input.lift_m > 0.0 && *input.lift_m <= most_lift_m))
    fail(ExitCode::bad_input, "lift_m = {}: expected more than 0 and at most {} m", *input.lift_m,
         most_lift_m);
  if (input.ground || input.damage || input.lift_m) {
    Problem next = problem_;
    if (input.ground) next.set_ground(*input.ground);
    if (input.damage) next.set_damage(*input.damage);
    move_to(std::move(next), input.lift_m.value_or(0.0));
  }
  if (input.push_n_s) engine_->push(lane, *input.push_n_s);
  if (input.command) runner_->tell(lane, *input.command);
}

bool LiveTrial::obeys() const {
  return problem_.architecture->extra_senses().commands();
}

trial::Command LiveTrial::told() const {
  return runner_->told(lane).value_or(trial::Command{});
}

void LiveTrial::move_to(Problem next, double lift_m) {
  // The engine counts from its own first step. What begins later goes on to count before what began earlier.
  Problem from_now_on = next;
  std::ranges::stable_sort(from_now_on.damage.parts, {}, &damage::Part::from_s);
  for (damage::Part& part : from_now_on.damage.parts)
    part.from_s = std::max(0.0, part.from_s - steps_ * next.trial.timestep_s);
  auto engine = from_now_on.make_engine();
  auto ground = next.make_ground(next.ground_key);
  if (ground) engine->set_ground(ground);
  physics::MovingPose motion = engine_->motion(lane);
  const double sunk_m = std::min(0.0, clearance_m(problem_.robot, ground_.get(), motion.pose)) -
                        clearance_m(next.robot, ground.get(), motion.pose);
  if (sunk_m > 0.0) motion.pose.root.position_m.z += rounded_up(sunk_m);
  motion.pose.root.position_m.z += lift_m;
  engine->place_moving(lane, motion);
  runner_->move_to(*engine, from_now_on.protocol({}).numb);
  engine_ = std::move(engine);
  ground_ = std::move(ground);
  problem_ = std::move(next);
}

bool LiveTrial::step() {
  if (!healthy_) return false;
  healthy_ = runner_->tick(*task_);
  if (healthy_) ++steps_;
  return healthy_;
}

bool LiveTrial::fallen() const {
  const Vec3 root_m = engine_->root_com_m(lane);
  const double ground_m = ground_ ? ground_->height_m(root_m.x, root_m.y) : 0.0;
  const robot::RobotSpec& robot = problem_.robot;
  return robot.fall_rule().met(root_m.z - ground_m, robot.upright(engine_->root_pose(lane).rotation));
}

}  // namespace amble::experiment
