#include "amble/trial/trial.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "amble/core/check.hpp"
#include "amble/core/clock.hpp"
#include "amble/core/index.hpp"
#include "amble/record/footfall.hpp"

namespace amble::trial {
namespace {

constexpr int heading_row = 2;

}  // namespace

Runner::Runner(physics::Engine& engine, controllers::Batch& controllers, const Protocol& protocol)
    : engine_(&engine),
      controllers_(controllers),
      protocol_(protocol),
      targets_rad_(engine.sensors().joint_angle_rad.rows(), engine.lanes()),
      senses_(protocol.sensing, engine.sensors(), protocol.timestep_s),
      disturbances_(engine.sensors(), protocol.numb),
      lanes_(to_index(engine.lanes())) {
  AMBLE_CHECK(controllers.lanes() == engine.lanes(), "one controller per robot");
  AMBLE_CHECK(!protocol.measures.need_torques() || engine.motor_torque_nm(), "work is measured by torques");
  AMBLE_CHECK(!protocol.measures.effort || to_index(targets_rad_.rows()) == protocol.max_torque_nm.size(),
              "effort is a share of the largest torques");
}

// The step loop: sensors → controllers → targets (noise applies to both), engine step, then evaluate each
// lane.
void Runner::run(TaskQueue& queue, const std::atomic<bool>& stop) {
  begin(queue);
  while (busy_ > 0 && !stop.load(std::memory_order_relaxed)) tick(queue);
}

void Runner::begin(TaskQueue& queue) {
  for (int lane = 0; lane < engine_->lanes(); ++lane) refill(lane, queue);
}

bool Runner::tick(TaskQueue& queue) {
  const double before_s = now_s();
  controllers_.step(disturbances_.read(senses_.read(*engine_)), targets_rad_);
  if (protocol_.first_command == FirstCommand::after_first_step) hold_first_steps();
  disturbances_.act(targets_rad_, *engine_);
  const double between_s = now_s();
  engine_->step(targets_rad_);
  control_s_ += between_s - before_s;
  physics_s_ += now_s() - between_s;

  for (int lane = 0; lane < engine_->lanes(); ++lane)
    if (lanes_[to_index(lane)].busy) after_step(lane, queue);
  return busy_ > 0;
}

void Runner::move_to(physics::Engine& engine, std::vector<NumbTouch> numb) {
  AMBLE_CHECK(engine.lanes() == engine_->lanes(), "an engine of as many lanes");
  for (const Lane& slot : lanes_)
    AMBLE_CHECK(!slot.busy || slot.task.scenario == nullptr, "a scenario belongs to one engine");
  engine_ = &engine;
  disturbances_ = Disturbances(engine.sensors(), std::move(numb));
}

void Runner::tell(int lane, Command command) {
  AMBLE_CHECK(protocol_.commands.has_value(), "commands are changed where there are some");
  protocol_.commands->change(lanes_[to_index(lane)].trajectory.steps, command);
}

std::optional<Command> Runner::told(int lane) const {
  const Lane& slot = lanes_[to_index(lane)];
  const CommandSchedule* const commands = commands_of(slot.task);
  if (commands == nullptr) return std::nullopt;
  return commands->at(std::max(slot.trajectory.steps - 1, 0));
}

void Runner::refill(int lane, TaskQueue& queue) {
  Lane& slot = lanes_[to_index(lane)];
  busy_ -= std::exchange(slot.busy, false);
  auto task = queue.next();
  slot.busy = task.has_value();
  disturbances_.load(lane, task ? task->scenario : nullptr);
  if (!task) {
    engine_->retire(lane);
    senses_.clear(lane);
    return;
  }
  ++busy_;
  {
    const Stopwatch watch(physics_s_);
    if (task->scenario && task->scenario->start)
      engine_->place_at(lane, *task->scenario->start);
    else
      engine_->place(lane);
  }
  senses_.load(lane, *engine_, task->scenario, commands_of(*task));
  slot.task = std::move(*task);
  if (slot.task.observer) slot.task.observer->on_start(*engine_, lane);
  controllers_.load(lane, *slot.task.parameters);
  note_start(slot, lane);
}

/// Begins the trajectory of a lane that was placed.
void Runner::note_start(Lane& slot, int lane) {
  slot.trajectory = {};
  slot.trajectory.timestep_s = protocol_.timestep_s;
  slot.trajectory.com_start_m = slot.last_healthy_com_m = engine_->com_m(lane);
  if (protocol_.measures.root)
    slot.trajectory.root_start_m = slot.trajectory.root_end_m = engine_->root_pose(lane).position_m;
  note_forward(lane, slot.trajectory.forward_x, slot.trajectory.forward_y);
  if (protocol_.measures.contacts)
    slot.trajectory.contact_steps.assign(to_index(engine_->sensors().touch.rows()), 0);
  if (protocol_.measures.footfalls) {
    slot.trajectory.footfall_steps.assign(to_index(engine_->sensors().touch.rows()), {});
    slot.last_touch_step.assign(to_index(engine_->sensors().touch.rows()),
                                std::numeric_limits<int>::min() / 2);
  }
  slot.yaw_rad = engine_->sensors().attitude_rad.at(heading_row, lane);
  slot.speed_sum_m_s = slot.turn_sum_rad_s = 0.0;
  slot.second_begins = 0;
  if (!protocol_.measures.energy) return;
  slot.angle_rad.clear();
  const LaneArray& angle_rad = engine_->sensors().joint_angle_rad;
  for (int joint = 0; joint < angle_rad.rows(); ++joint) slot.angle_rad.push_back(angle_rad.at(joint, lane));
}

/// The projection on the ground of the root's forward axis, of unit length; unchanged where that is upright.
void Runner::note_forward(int lane, double& x, double& y) const {
  const Vec3 forward = rotate(turned(lane), {1.0, 0.0, 0.0});
  const double length = std::sqrt(forward.x * forward.x + forward.y * forward.y);
  if (!(length > 1e-6)) return;
  x = forward.x / length;
  y = forward.y / length;
}

/// Sets the targets of lanes in their first step to the present joint angles.
void Runner::hold_first_steps() {
  const LaneArray& angle_rad = engine_->sensors().joint_angle_rad;
  for (int lane = 0; lane < engine_->lanes(); ++lane) {
    const Lane& slot = lanes_[to_index(lane)];
    if (!slot.busy || slot.trajectory.steps > 0) continue;
    for (int joint = 0; joint < targets_rad_.rows(); ++joint)
      targets_rad_.at(joint, lane) = angle_rad.at(joint, lane);
  }
}

void Runner::after_step(int lane, TaskQueue& queue) {
  Lane& slot = lanes_[to_index(lane)];
  const auto outcome = advance(lane);
  if (!outcome) return;
  slot.trajectory.outcome = *outcome;
  slot.trajectory.com_end_m = slot.last_healthy_com_m;
  slot.trajectory.forward_end_x = slot.trajectory.forward_x;
  slot.trajectory.forward_end_y = slot.trajectory.forward_y;
  if (*outcome != record::Outcome::diverged)
    note_forward(lane, slot.trajectory.forward_end_x, slot.trajectory.forward_end_y);
  if (*outcome != record::Outcome::completed && protocol_.measures.commands) note_missed_commands(slot);
  queue.done(slot.task.index, std::move(slot.trajectory));
  refill(lane, queue);
}

/// Accounts for one step of a lane; returns the outcome of its trial if it has ended.
std::optional<record::Outcome> Runner::advance(int lane) {
  Lane& slot = lanes_[to_index(lane)];
  record::Trajectory& trajectory = slot.trajectory;
  ++trajectory.steps;
  ++steps_simulated_;
  if (!engine_->healthy(lane)) return record::Outcome::diverged;

  slot.last_healthy_com_m = engine_->com_m(lane);
  if (protocol_.measures.root) trajectory.root_end_m = engine_->root_pose(lane).position_m;
  if (protocol_.path.at(trajectory.steps, protocol_.steps)) {
    const Vec3 moved = slot.last_healthy_com_m - trajectory.com_start_m;
    trajectory.com_path_m.push_back(static_cast<float>(moved.x));
    trajectory.com_path_m.push_back(static_cast<float>(moved.y));
  }
  measure(lane);
  // Its output for the first step was not used: it starts now.
  if (protocol_.first_command == FirstCommand::after_first_step && trajectory.steps == 1) {
    controllers_.load(lane, *slot.task.parameters);
    senses_.face(lane, *engine_);
  }
  if (slot.task.observer)
    slot.task.observer->on_step(trajectory.steps, *engine_, controllers_, targets_rad_, lane);

  const Vec3 root_m = engine_->root_com_m(lane);  // its centre of mass
  const double ground_m = engine_->ground() ? engine_->ground()->height_m(root_m.x, root_m.y) : 0.0;
  if (protocol_.measures.height) trajectory.height_steps_m += root_m.z - ground_m;
  if (protocol_.fall.met(root_m.z - ground_m, upright(lane))) return record::Outcome::fell;
  if (trajectory.steps == protocol_.steps) return record::Outcome::completed;
  return std::nullopt;
}

/// What FallRule::met asks for; 1 where that does not matter.
double Runner::upright(int lane) const {
  if (!std::isfinite(protocol_.fall.tilt_rad)) return 1.0;
  return rotate(turned(lane), {0.0, 0.0, 1.0}).z;
}

/// As RobotSpec::turned().
Quat Runner::turned(int lane) const {
  return engine_->root_pose(lane).rotation * conjugate(protocol_.start_rotation);
}

/// Adds what scores need of this step to the lane's trajectory.
void Runner::measure(int lane) {
  Lane& slot = lanes_[to_index(lane)];
  if (protocol_.measures.uprightness) {
    // R_zz of the rotation matrix, from the quaternion.
    const Quat q = turned(lane);
    slot.trajectory.upright_steps += 1.0 - 2.0 * (q.x * q.x + q.y * q.y);
  }
  if (protocol_.measures.contacts)
    for (std::size_t leg = 0; leg < slot.trajectory.contact_steps.size(); ++leg)
      slot.trajectory.contact_steps[leg] += engine_->sensors().touch.at(static_cast<int>(leg), lane) > 0.0f;
  if (protocol_.measures.footfalls) note_footfalls(lane);
  if (protocol_.measures.seconds) {
    record::Trajectory& trajectory = slot.trajectory;
    const auto noted = static_cast<int>(trajectory.com_by_second_m.size() / 2);
    if (record::second_count(trajectory.seconds()) > noted) {
      const Vec3 moved = slot.last_healthy_com_m - trajectory.com_start_m;
      trajectory.com_by_second_m.insert(trajectory.com_by_second_m.end(), {moved.x, moved.y});
    }
  }
  if (protocol_.measures.headings || protocol_.measures.commands) note_seconds(lane);
  if (protocol_.measures.need_torques()) note_work(lane);
}

/// Work and effort of each motor in this step.
void Runner::note_work(int lane) {
  Lane& slot = lanes_[to_index(lane)];
  const LaneArray& angle_rad = engine_->sensors().joint_angle_rad;
  const LaneArray& torque_nm = *engine_->motor_torque_nm();
  for (int joint = 0; protocol_.measures.effort && joint < torque_nm.rows(); ++joint) {
    const double most_nm = protocol_.max_torque_nm[to_index(joint)];
    const double share = most_nm > 0.0 ? torque_nm.at(joint, lane) / most_nm : 0.0;
    slot.trajectory.effort_steps += share * share;
  }
  // Work: τ Δq, braking counted like driving.
  for (int joint = 0; protocol_.measures.energy && joint < angle_rad.rows(); ++joint) {
    double& before_rad = slot.angle_rad[to_index(joint)];
    const double now_rad = angle_rad.at(joint, lane);
    slot.trajectory.energy_j += std::abs(torque_nm.at(joint, lane) * (now_rad - before_rad));
    before_rad = now_rad;
  }
}

const CommandSchedule* Runner::commands_of(const Task& task) const {
  if (task.scenario != nullptr && task.scenario->commands) return &*task.scenario->commands;
  return protocol_.commands ? &*protocol_.commands : nullptr;
}

/// Headings and commands, second by second.
void Runner::note_seconds(int lane) {
  Lane& slot = lanes_[to_index(lane)];
  record::Trajectory& trajectory = slot.trajectory;
  const float yaw_rad = engine_->sensors().attitude_rad.at(heading_row, lane);
  trajectory.turned_rad += static_cast<double>(wrapped_rad(yaw_rad - slot.yaw_rad));
  slot.yaw_rad = yaw_rad;
  const CommandSchedule* const commands = commands_of(slot.task);
  if (commands != nullptr) {
    const Command command = commands->at(trajectory.steps - 1);
    slot.speed_sum_m_s += static_cast<double>(command.speed_m_s);
    slot.turn_sum_rad_s += static_cast<double>(command.turn_rad_s);
  }
  if (record::second_count(trajectory.seconds()) <= static_cast<int>(trajectory.turned_by_second_rad.size()))
    return;
  trajectory.turned_by_second_rad.push_back(trajectory.turned_rad);
  const int steps = trajectory.steps - slot.second_begins;
  if (commands != nullptr)
    trajectory.command_by_second.insert(trajectory.command_by_second.end(),
                                        {slot.speed_sum_m_s / steps, slot.turn_sum_rad_s / steps});
  slot.speed_sum_m_s = slot.turn_sum_rad_s = 0.0;
  slot.second_begins = trajectory.steps;
}

/// Those of the seconds that a trial was cut off from.
void Runner::note_missed_commands(Lane& slot) const {
  const CommandSchedule* const commands = commands_of(slot.task);
  if (commands == nullptr) return;
  std::vector<double>& noted = slot.trajectory.command_by_second;
  for (int step = slot.trajectory.steps; step <= protocol_.steps; ++step) {
    if (record::second_count(step * protocol_.timestep_s) <= static_cast<int>(noted.size() / 2)) continue;
    const Command command = commands->at(step - 1);
    noted.insert(noted.end(),
                 {static_cast<double>(command.speed_m_s), static_cast<double>(command.turn_rad_s)});
  }
}

void Runner::note_footfalls(int lane) {
  Lane& slot = lanes_[to_index(lane)];
  const int step = slot.trajectory.steps;
  // Off during the steps between two touches.
  const double least_off = record::footfall_off_s / protocol_.timestep_s - 1e-6;
  for (std::size_t leg = 0; leg < slot.last_touch_step.size(); ++leg) {
    if (!(engine_->sensors().touch.at(static_cast<int>(leg), lane) > 0.0f)) continue;
    if (record::has_come_down(step, slot.last_touch_step[leg], least_off))
      slot.trajectory.footfall_steps[leg].push_back(step);
    slot.last_touch_step[leg] = step;
  }
}

}  // namespace amble::trial
