#pragma once

#include <atomic>
#include <condition_variable>
#include <cstdint>
#include <exception>
#include <functional>
#include <memory>
#include <mutex>
#include <span>
#include <string>
#include <thread>
#include <vector>

#include "amble/core/lanes.hpp"
#include "amble/core/process.hpp"
#include "amble/damage/settings.hpp"
#include "amble/physics/engine.hpp"
#include "amble/robot/spec.hpp"
#include "amble/trial/disturbances.hpp"

namespace amble::python {

/// Threads that share work again and again: each call of run() runs a function once per share, and returns
/// when all have ended.
class Team {
 public:
  /// `shares` ≥ 1. The caller of run() takes share 0 itself if it `helps`; every other share always has the
  /// same thread. Throws UserError(ExitCode::io) if the system refuses threads.
  Team(int shares, bool helps);
  ~Team();

  int shares() const { return shares_; }
  /// Rethrows the first exception of a share.
  void run(const std::function<void(int share)>& work);

 private:
  void serve(int share);
  void guarded(int share);

  const int shares_;
  const bool helps_;
  std::mutex mutex_;
  std::condition_variable wake_, finished_;
  const std::function<void(int)>* work_ = nullptr;
  std::uint64_t round_ = 0;
  int working_ = 0;
  bool quit_ = false;
  std::exception_ptr failure_;
  std::vector<std::jthread> threads_;
};

/// What Robots shows of its robots, row by row; one allocation for its whole life, so that views stay valid.
struct Observations {
  /// `forces`: with torques and loads.
  Observations(int robots, int joints, int legs, bool forces);

  int robots, joints, legs;
  int width;                  ///< of a row: angles, touches, attitude (3), centre of mass (3)
  std::vector<float> values;  ///< robots × width
  std::vector<std::uint8_t> fallen, diverged;
  std::vector<float> torque_nm, load_n;  ///< robots × joints, robots × legs; empty without forces

  float* row(int robot) {
    return values.data() + static_cast<std::size_t>(robot) * static_cast<std::size_t>(width);
  }
  int touch_column() const { return joints; }
  int attitude_column() const { return joints + legs; }
  int com_column() const { return joints + legs + 3; }
};

/// Any number of copies of one robot on the plane z = 0, each in a lane of one of several engines, which
/// advance together on several threads. Not one bit depends on their number.
class RobotBatch {
 public:
  /// What there are copies of.
  struct Kind {
    robot::RobotSpec robot;  ///< intact
    damage::Settings damage;
    std::string engine;
    physics::EngineSettings settings;
  };
  /// All robots are placed; fewer than `count` are made if `stop` was set meanwhile. `count` ≥ 1, `threads`
  /// ≥ 1. Throws UserError for an unknown engine or a robot that it cannot simulate.
  RobotBatch(Kind kind, int count, int threads, const std::atomic<bool>& stop);
  ~RobotBatch();

  /// False in a process that was forked from the one that made it: there it can only be destroyed.
  bool works_here() const { return made_in_.is_this(); }
  const robot::RobotSpec& robot() const { return kind_.robot; }
  int count() const { return observations_->robots; }
  int threads() const { return team_->shares(); }
  double timestep_s() const { return kind_.settings.timestep_s; }
  const std::shared_ptr<Observations>& observations() const { return observations_; }

  /// Advances each robot by one timestep towards its targets, rad, robots × joints; does nothing and returns
  /// false if one is NaN. A robot that has diverged keeps its last healthy row until it is reset.
  bool step(std::span<const float> targets_rad);
  /// Places robots in the start pose, at rest: those whose mask is not 0, or all if it is empty.
  void reset(std::span<const std::uint8_t> mask);
  /// physics::Engine::state_hash of each robot.
  std::vector<std::uint64_t> state_hashes() const;

 private:
  struct Group {
    std::unique_ptr<physics::Engine> engine;
    LaneArray targets_rad;
    std::vector<std::int64_t> steps;  ///< by robot: since it was placed
    int first = 0, size = 0;          ///< robots in its lanes
  };

  void each_group(const std::function<void(Group&)>& work);
  void place(Group& group, std::span<const std::uint8_t> mask);
  void step(Group& group, const float* targets_rad);
  /// Observes after a step; retires who has diverged in it.
  void read(Group& group);
  void observe(const Group& group, int lane);
  /// The same of all robots of a group.
  void observe(const Group& group);
  void observe_body(const Group& group, int lane);
  /// Touches that are read as 0.
  void numb(const Group& group);
  void observe_forces(const Group& group, int lane);

  const Kind kind_;
  const std::vector<trial::NumbTouch> numb_;
  std::shared_ptr<Observations> observations_;
  std::vector<Group> groups_;
  std::unique_ptr<Team> team_;
  MakingProcess made_in_;
};

}  // namespace amble::python
