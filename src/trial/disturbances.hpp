#pragma once

#include <cstddef>
#include <vector>

#include "amble/core/lanes.hpp"
#include "amble/physics/engine.hpp"
#include "amble/trial/scenario.hpp"

namespace amble::trial {

/// A foot whose touch is read as 0 from a step on, counted from 1.
struct NumbTouch {
  int leg = 0;
  int first_step = 1;
};

/// Applies scenarios and numb feet to the lanes of a runner: to sensors before controllers read them, and to
/// targets and robots before the engine steps. Without any of them both calls return at once.
class Disturbances {
 public:
  /// `sensors` gives the number of lanes, joints and angles; `numb` applies to every trial.
  explicit Disturbances(const robot::SensorFrame& sensors, std::vector<NumbTouch> numb = {});

  /// From the next tick on, `scenario` applies to this lane, from its beginning; null: none. Not copied.
  void load(int lane, const Scenario* scenario);

  /// The sensors as controllers read them in this tick. Valid until the next call.
  const robot::SensorFrame& read(const robot::SensorFrame& sensors);
  /// Delays the targets of this tick and pushes the robots. Once per tick, after read().
  void act(LaneArray& targets_rad, physics::Engine& engine);

 private:
  struct Lane {
    const Scenario* scenario = nullptr;
    int step = 0;  ///< the next one, from 1
    std::size_t next_push = 0, next_flip = 0;
    std::vector<float> delayed_rad;  ///< joints × latency: delayed targets, a ring buffer over ticks
  };

  void flip_touches(Lane& lane, int index);
  static void delay(Lane& lane, int index, LaneArray& targets_rad);

  std::vector<NumbTouch> numb_;
  std::vector<Lane> lanes_;
  LaneArray joint_offset_rad_, attitude_offset_rad_;  ///< shaped as the sensors
  robot::SensorFrame read_;
  int disturbed_ = 0;  ///< lanes that have a scenario
};

}  // namespace amble::trial
