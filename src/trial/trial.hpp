#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "amble/controllers/controller.hpp"
#include "amble/physics/engine.hpp"
#include "amble/record/trajectory.hpp"
#include "amble/trial/commands.hpp"
#include "amble/trial/disturbances.hpp"
#include "amble/trial/scenario.hpp"
#include "amble/trial/senses.hpp"
#include "amble/trial/settings.hpp"

namespace amble::trial {

/// How often something happened in a controller.
struct EventCount {
  std::string name;        ///< of a state variable, e.g. "trigger.front_left"
  std::int64_t count = 0;  ///< ticks in which it happened
};

/// Observes the trial of one lane. Called from the thread that runs it.
class Observer {
 public:
  virtual ~Observer() = default;
  /// The robot was placed, before the first step.
  virtual void on_start(const physics::Engine& /*engine*/, int /*lane*/) {}
  /// After every step in which the simulation stayed healthy, the last included. `step` counts from 1.
  /// `targets_rad` are those of this step.
  virtual void on_step(int step, const physics::Engine& engine, const controllers::Batch& controllers,
                       const LaneArray& targets_rad, int lane) = 0;
};

/// A trial to be run.
struct Task {
  std::size_t index = 0;                                      ///< given back with the result
  std::shared_ptr<const controllers::Parameters> parameters;  ///< may be shared by several trials
  Observer* observer = nullptr;                               ///< not owned, may be null
  const Scenario* scenario = nullptr;                         ///< not owned; null: no noise
};

/// Where a runner's trials come from and where their results go. Both functions are called from the thread
/// that runs the trials; a queue that several runners share must be thread safe.
class TaskQueue {
 public:
  virtual ~TaskQueue() = default;
  /// The next controller to try, or nothing when there is no more.
  virtual std::optional<Task> next() = 0;
  /// The trial of a task has ended; `index` is its Task::index. Trials end in any order. Not called for
  /// trials that are dropped.
  virtual void done(std::size_t index, record::Trajectory trajectory) = 0;
};

/// Parameters of all trials of a runner. experiment::Problem::protocol() makes them of a problem.
struct Protocol {
  int steps = 1500;          ///< steps of a trial that completes, at least 1
  double timestep_s = 0.01;  ///< the engine's
  FirstCommand first_command = FirstCommand::before_first_step;  ///< when controllers first act
  record::PathSampling path;                                     ///< when Trajectory::com_path_m is sampled
  record::Measures measures;         ///< energy and effort: only with an engine that has motor torques
  std::vector<NumbTouch> numb = {};  ///< feet whose touch reads 0, in every trial
  Sensing sensing = {};              ///< torques and loads: only with an engine that has them
  std::optional<CommandSchedule> commands = {};  ///< for trials whose scenario has none; nothing: no commands
  robot::FallRule fall = {};                     ///< when a trial ends as fallen
  std::vector<double> max_torque_nm = {};        ///< by joint, 0: it has no motor; for measures.effort
  Quat start_rotation;                           ///< root axes → world axes in the robot's own start pose
};

/// Runs trials on one engine, as many at a time as it has lanes; a lane whose trial has ended takes the next
/// task at once. The result of a trial depends on its own controller and scenario alone, not on its lane, the
/// other lanes or the order. Not thread safe.
class Runner {
 public:
  /// `engine` and `controllers` must outlive the runner. AMBLE_CHECK: they have as many lanes; the engine
  /// measures torques if measures.energy or measures.effort is set; with the latter max_torque_nm is
  /// complete.
  Runner(physics::Engine& engine, controllers::Batch& controllers, const Protocol& protocol);

  /// Until the queue is empty and the last trial has ended, or `stop` is set (then trials in flight are
  /// dropped). `stop` is looked at before each step.
  void run(TaskQueue& queue, const std::atomic<bool>& stop);
  /// A part of run(): fills the lanes.
  void begin(TaskQueue& queue);
  /// A part of run(), after begin(): one step of all lanes; false when the last trial has ended.
  bool tick(TaskQueue& queue);

  /// From the next tick on the robots are those of another engine of as many lanes (AMBLE_CHECK), joints and
  /// legs, in which they are placed already; it must outlive the runner. Controllers and what they sense go
  /// on. AMBLE_CHECK: no trial has a scenario. `numb`: in place of Protocol::numb, its steps counted from the
  /// next one.
  void move_to(physics::Engine& engine, std::vector<NumbTouch> numb);

  /// From the next tick of this lane's trial on its robot is told another command. This changes
  /// Protocol::commands for good: all trials of this runner whose scenario has no commands are told so from
  /// the same tick of theirs, those that begin later, too. AMBLE_CHECK: Protocol::commands is there. Without
  /// effect on a lane whose scenario has commands.
  void tell(int lane, Command command);
  /// What the robot of a lane was told in its last step, or before the first is told in that; none without
  /// commands.
  std::optional<Command> told(int lane) const;

  /// The targets of the last tick, rad from the start pose, joints × lanes, as the engine got them.
  const LaneArray& targets_rad() const { return targets_rad_; }
  /// Steps simulated since the runner was made, those of all lanes added.
  std::uint64_t steps_simulated() const { return steps_simulated_; }
  /// Wall time spent in the engine since the runner was made.
  double physics_s() const { return physics_s_; }
  /// Wall time spent in controllers, senses and noise since the runner was made.
  double control_s() const { return control_s_; }

 private:
  struct Lane {
    Task task;
    record::Trajectory trajectory;
    Vec3 last_healthy_com_m;
    std::vector<double> angle_rad;     ///< after the last step; only where energy is measured
    std::vector<int> last_touch_step;  ///< by leg; only where footfalls are measured
    float yaw_rad = 0.0f;              ///< after the last step; only where headings are measured
    double speed_sum_m_s = 0.0, turn_sum_rad_s = 0.0;  ///< of commands in this second
    int second_begins = 0;                             ///< steps before this second
    bool busy = false;
  };

  void refill(int lane, TaskQueue& queue);
  void note_start(Lane& slot, int lane);
  void note_forward(int lane, double& x, double& y) const;
  void hold_first_steps();
  void after_step(int lane, TaskQueue& queue);
  std::optional<record::Outcome> advance(int lane);
  void measure(int lane);
  double upright(int lane) const;
  Quat turned(int lane) const;
  void note_work(int lane);
  void note_footfalls(int lane);
  void note_seconds(int lane);
  const CommandSchedule* commands_of(const Task& task) const;
  void note_missed_commands(Lane& slot) const;

  physics::Engine* engine_;
  controllers::Batch& controllers_;
  Protocol protocol_;
  LaneArray targets_rad_;
  Senses senses_;
  Disturbances disturbances_;
  std::vector<Lane> lanes_;
  int busy_ = 0;
  std::uint64_t steps_simulated_ = 0;
  double physics_s_ = 0.0, control_s_ = 0.0;
};

/// A queue of one task.
class OneTask : public TaskQueue {
 public:
  /// The arguments are those of Task.
  explicit OneTask(std::shared_ptr<const controllers::Parameters> parameters, Observer* observer = nullptr,
                   const Scenario* scenario = nullptr)
      : task_(Task{0, std::move(parameters), observer, scenario}) {}

  std::optional<Task> next() override { return std::exchange(task_, std::nullopt); }
  void done(std::size_t, record::Trajectory trajectory) override { result_ = std::move(trajectory); }
  /// Nothing until the trial has ended.
  const std::optional<record::Trajectory>& result() const { return result_; }

 private:
  std::optional<Task> task_;
  std::optional<record::Trajectory> result_;
};

}  // namespace amble::trial
