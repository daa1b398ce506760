#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "amble/record/recording.hpp"
#include "amble/robot/spec.hpp"
#include "amble/trial/commands.hpp"
#include "amble/trial/trial.hpp"

namespace amble::trial {

/// One hash per step of a trial: 32 bits of the engine's state hash. Names the first step at which two trials
/// differ.
class TraceObserver : public Observer {
 public:
  void on_step(int step, const physics::Engine& engine, const controllers::Batch& controllers,
               const LaneArray& targets_rad, int lane) override;
  const std::vector<std::uint32_t>& trace() const { return trace_; }

 private:
  std::vector<std::uint32_t> trace_;
};

/// Counts the events of a controller (controllers::Batch::events).
class EventObserver : public Observer {
 public:
  explicit EventObserver(const controllers::Batch& controllers);
  void on_step(int step, const physics::Engine& engine, const controllers::Batch& controllers,
               const LaneArray& targets_rad, int lane) override;
  const std::vector<EventCount>& counts() const { return counts_; }

 private:
  std::vector<std::size_t> columns_;
  std::vector<EventCount> counts_;
  std::vector<float> state_;
};

/// The joint angles of a lane; empty if they are those of the start pose, 0.
std::vector<float> bent_start(const LaneArray& angle_rad, int lane);

/// Writes every step of a trial to a recording (record/recording.hpp).
class RecordingObserver : public Observer {
 public:
  /// `header` with everything but the columns and the start; `robot` is intact, or as the header has it.
  /// Motor torques and loads of feet are recorded if the engine measures them, and `commands` (not copied) if
  /// there are any.
  RecordingObserver(const std::filesystem::path& path, record::RecordingHeader header,
                    const robot::RobotSpec& robot, const physics::Engine& engine,
                    const controllers::Batch& controllers, const CommandSchedule* commands = nullptr);
  /// Opens the file: throws UserError(ExitCode::io).
  void on_start(const physics::Engine& engine, int lane) override;
  void on_step(int step, const physics::Engine& engine, const controllers::Batch& controllers,
               const LaneArray& targets_rad, int lane) override;
  /// AMBLE_CHECK: a trial was begun.
  void finish(record::Outcome outcome);

 private:
  std::filesystem::path path_;
  record::RecordingHeader header_;
  Vec3 com_start_m_;
  std::optional<record::RecordingWriter> writer_;
  std::size_t state_count_;
  const CommandSchedule* commands_;
  std::vector<float> frame_;
};

/// Forwards every step to several observers, in order.
class ObserverList : public Observer {
 public:
  void add(Observer& observer) { observers_.push_back(&observer); }
  void on_start(const physics::Engine& engine, int lane) override;
  void on_step(int step, const physics::Engine& engine, const controllers::Batch& controllers,
               const LaneArray& targets_rad, int lane) override;

 private:
  std::vector<Observer*> observers_;
};

}  // namespace amble::trial
