#pragma once

#include <cstddef>
#include <vector>

#include "amble/core/lanes.hpp"
#include "amble/physics/engine.hpp"
#include "amble/trial/scenario.hpp"

namespace amble::trial {

/// Lets scenarios act on the lanes of a runner. Stands between sensors and controllers, and between
/// controllers and engine. While no lane has a scenario, both calls return at once.
class Disturbances {
 public:
  /// `sensors` shows the shape of what is to come.
  explicit Disturbances(const robot::SensorFrame& sensors);

  /// From the next tick on, `scenario` acts on this lane from its beginning; null: nothing does. Not copied.
  void load(int lane, const Scenario* scenario);

  /// What the controllers are to read in this tick. Valid until the next call.
  const robot::SensorFrame& read(const robot::SensorFrame& sensors);
  /// Delays the targets of this tick and pushes the robots. Once per tick, after read().
  void act(LaneArray& targets_rad, physics::Engine& engine);

 private:
  struct Lane {
    const Scenario* scenario = nullptr;
    int step = 0;  ///< that is about to be taken, from 1
    std::size_t next_push = 0, next_flip = 0;
    std::vector<float> late_rad;  ///< joints × latency: targets on their way, a ring over the latency
  };

  void flip_touches(Lane& lane, int index);
  static void delay(Lane& lane, int index, LaneArray& targets_rad);

  std::vector<Lane> lanes_;
  LaneArray joint_offset_rad_, attitude_offset_rad_;  ///< shaped as the sensors
  robot::SensorFrame read_;
  int disturbed_ = 0;  ///< lanes that have a scenario
};

}  // namespace amble::trial
