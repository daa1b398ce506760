#include "python/robot_batch.hpp"

#include <algorithm>
#include <system_error>
#include <utility>

#include "amble/core/check.hpp"
#include "amble/core/error.hpp"
#include "amble/core/index.hpp"
#include "amble/damage/stages.hpp"
#include "amble/physics/damaged_engine.hpp"

namespace amble::python {

Team::Team(int shares, bool helps) : shares_(shares), helps_(helps) {
  AMBLE_CHECK(shares >= 1, "a team has a share");
  try {
    for (int share = helps ? 1 : 0; share < shares; ++share)
      threads_.emplace_back([this, share] { serve(share); });
  } catch (const std::system_error& error) {
    {
      const std::lock_guard lock(mutex_);
      quit_ = true;
    }
    wake_.notify_all();
    threads_.clear();
    fail(ExitCode::io, "cannot start {} threads: {}", shares, error.code().message());
  }
}

Team::~Team() {
  {
    const std::lock_guard lock(mutex_);
    quit_ = true;
  }
  wake_.notify_all();
}

void Team::run(const std::function<void(int)>& work) {
  {
    const std::lock_guard lock(mutex_);
    work_ = &work;
    working_ = static_cast<int>(threads_.size());
    ++round_;
  }
  if (!threads_.empty()) wake_.notify_all();
  if (helps_) guarded(0);
  std::unique_lock lock(mutex_);
  finished_.wait(lock, [this] { return working_ == 0; });
  if (failure_) std::rethrow_exception(std::exchange(failure_, nullptr));
}

void Team::serve(int share) {
  for (std::uint64_t seen = 0;;) {
    {
      std::unique_lock lock(mutex_);
      wake_.wait(lock, [&] { return quit_ || round_ != seen; });
      if (quit_) return;
      seen = round_;
    }
    guarded(share);
    const std::lock_guard lock(mutex_);
    if (--working_ == 0) finished_.notify_one();
  }
}

void Team::guarded(int share) {
  try {
    (*work_)(share);
  } catch (...) {
    const std::lock_guard lock(mutex_);
    if (!failure_) failure_ = std::current_exception();
  }
}

Observations::Observations(int robots_in, int joints_in, int legs_in, bool forces)
    : robots(robots_in),
      joints(joints_in),
      legs(legs_in),
      width(joints + legs + 6),
      values(to_index(robots) * to_index(width)),
      fallen(to_index(robots)),
      diverged(to_index(robots)),
      torque_nm(forces ? to_index(robots) * to_index(joints) : 0),
      load_n(forces ? to_index(robots) * to_index(legs) : 0) {}

namespace {

std::vector<trial::NumbTouch> numb_touches(const RobotBatch::Kind& kind) {
  std::vector<trial::NumbTouch> all;
  for (const damage::NumbFoot& foot : damage::numb_feet(kind.robot, kind.damage))
    all.push_back({foot.leg, damage::first_step(foot.from_s, kind.settings.timestep_s)});
  return all;
}

}  // namespace

RobotBatch::RobotBatch(Kind kind, int count, int threads, const std::atomic<bool>& stop)
    : kind_(std::move(kind)),
      numb_(numb_touches(kind_)),
      observations_(std::make_shared<Observations>(count, static_cast<int>(kind_.robot.joints.size()),
                                                   static_cast<int>(kind_.robot.legs.size()),
                                                   kind_.settings.torques && kind_.settings.loads)),
      // A caller that takes a share itself may be another thread at the next call.
      team_(std::make_unique<Team>(threads, !physics::engine_traits(kind_.engine).keeps_to_a_thread)) {
  for (int first = 0; first < count && !stop;) {
    Group group{
        .engine = physics::make_damaged_engine(kind_.engine, kind_.robot, kind_.damage, kind_.settings),
        .targets_rad = {},
        .steps = {},
        .first = first};
    group.size = std::min(group.engine->lanes(), count - first);
    group.targets_rad = LaneArray(observations_->joints, group.engine->lanes());
    group.steps.assign(to_index(group.size), 0);
    first += group.size;
    groups_.push_back(std::move(group));
  }
  reset({});
}

RobotBatch::~RobotBatch() {
  // In a forked process its threads are not there to be joined.
  if (!works_here()) static_cast<void>(team_.release());
}

void RobotBatch::each_group(const std::function<void(Group&)>& work) {
  const std::size_t groups = groups_.size(), shares = to_index(team_->shares());
  team_->run([&](int share) {
    const std::size_t begin = groups * to_index(share) / shares, end = groups * to_index(share + 1) / shares;
    for (std::size_t g = begin; g < end; ++g) work(groups_[g]);
  });
}

void RobotBatch::reset(std::span<const std::uint8_t> mask) {
  each_group([&](Group& group) { place(group, mask); });
}

void RobotBatch::place(Group& group, std::span<const std::uint8_t> mask) {
  for (int lane = 0; lane < group.size; ++lane) {
    const std::size_t robot = to_index(group.first + lane);
    if (!mask.empty() && mask[robot] == 0) continue;
    group.engine->place(lane);
    group.steps[to_index(lane)] = 0;
    observations_->diverged[robot] = 0;
    observe(group, lane);
  }
  numb(group);
}

bool RobotBatch::step(std::span<const float> targets_rad) {
  const std::size_t joints = to_index(observations_->joints);
  AMBLE_CHECK(targets_rad.size() == to_index(count()) * joints, "targets");
  int bad = 0;
  for (const float target_rad : targets_rad) bad |= static_cast<int>(target_rad != target_rad);
  if (bad != 0) return false;
  each_group([&](Group& group) { step(group, targets_rad.data() + to_index(group.first) * joints); });
  return true;
}

void RobotBatch::step(Group& group, const float* targets_rad) {
  const int joints = observations_->joints;
  for (int joint = 0; joint < joints; ++joint) {
    float* const row = group.targets_rad.row(joint);
    for (int lane = 0; lane < group.size; ++lane) row[lane] = targets_rad[lane * joints + joint];
  }
  group.engine->step(group.targets_rad);
  for (std::int64_t& steps : group.steps) ++steps;
  read(group);
  numb(group);
}

void RobotBatch::read(Group& group) {
  std::uint8_t* const diverged = observations_->diverged.data() + group.first;
  bool all_healthy = true;
  for (int lane = 0; lane < group.size; ++lane)
    all_healthy = all_healthy && diverged[lane] == 0 && group.engine->healthy(lane);
  if (all_healthy) return observe(group);
  for (int lane = 0; lane < group.size; ++lane) {
    if (diverged[lane] != 0) continue;
    if (group.engine->healthy(lane)) {
      observe(group, lane);
    } else {
      group.engine->retire(lane);
      diverged[lane] = 1;
    }
  }
}

void RobotBatch::observe(const Group& group, int lane) {
  const auto& sensors = group.engine->sensors();
  float* to = observations_->row(group.first + lane);
  for (const LaneArray* rows : {&sensors.joint_angle_rad, &sensors.touch, &sensors.attitude_rad})
    for (int r = 0; r < rows->rows(); ++r) *to++ = rows->at(r, lane);
  observe_body(group, lane);
}

void RobotBatch::observe(const Group& group) {
  const auto& sensors = group.engine->sensors();
  const int width = observations_->width;
  float* to = observations_->row(group.first);
  for (const LaneArray* rows : {&sensors.joint_angle_rad, &sensors.touch, &sensors.attitude_rad})
    for (int r = 0; r < rows->rows(); ++r, ++to) {
      const float* const from = rows->row(r);
      for (int lane = 0; lane < group.size; ++lane) to[lane * width] = from[lane];
    }
  for (int lane = 0; lane < group.size; ++lane) observe_body(group, lane);
}

void RobotBatch::numb(const Group& group) {
  for (const auto& [leg, first_step] : numb_)
    for (int lane = 0; lane < group.size; ++lane)
      if (group.steps[to_index(lane)] + 1 >= first_step)
        observations_->row(group.first + lane)[observations_->touch_column() + leg] = 0.0f;
}

void RobotBatch::observe_body(const Group& group, int lane) {
  float* const to = observations_->row(group.first + lane) + observations_->com_column();
  const Vec3 com_m = group.engine->com_m(lane);
  to[0] = static_cast<float>(com_m.x);
  to[1] = static_cast<float>(com_m.y);
  to[2] = static_cast<float>(com_m.z);
  // As Runner::advance, src/trial/trial.cpp, on the plane z = 0: no engine here is given another ground.
  observations_->fallen[to_index(group.first + lane)] = kind_.robot.fall_rule().met(
      group.engine->root_com_m(lane).z, kind_.robot.upright(group.engine->root_pose(lane).rotation));
  if (!observations_->torque_nm.empty()) observe_forces(group, lane);
}

void RobotBatch::observe_forces(const Group& group, int lane) {
  const auto copy = [&](const LaneArray* rows, std::vector<float>& all, int count) {
    float* const to = all.data() + to_index(group.first + lane) * to_index(count);
    for (int r = 0; r < count; ++r) to[r] = rows != nullptr ? rows->at(r, lane) : 0.0f;
  };
  copy(group.engine->motor_torque_nm(), observations_->torque_nm, observations_->joints);
  copy(group.engine->foot_load_n(), observations_->load_n, observations_->legs);
}

std::vector<std::uint64_t> RobotBatch::state_hashes() const {
  std::vector<std::uint64_t> hashes;
  for (const Group& group : groups_)
    for (int lane = 0; lane < group.size; ++lane) hashes.push_back(group.engine->state_hash(lane));
  return hashes;
}

}  // namespace amble::python
