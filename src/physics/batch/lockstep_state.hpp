#pragma once

#include <cstddef>
#include <vector>

#include "amble/core/index.hpp"
#include "amble/core/math.hpp"
#include "amble/physics/batch/batch_engine.hpp"
#include "amble/physics/batch/step.hpp"

namespace amble::physics::batch {

/// The states of sixteen robots, row by row (StateRows), and the sensors derived from them.
class LockstepState {
 public:
  /// All robots are retired. Keeps references to `model` and `layout`.
  LockstepState(const Model& model, const StateRows& layout);

  float& at(int row, int lane) { return rows_[to_index(row)].lane[to_index(lane)]; }
  float at(int row, int lane) const { return rows_[to_index(row)].lane[to_index(lane)]; }
  Vec3 vec3(int row, int lane) const {
    return {number(row, lane), number(row + 1, lane), number(row + 2, lane)};
  }
  void put(int row, int lane, Vec3 v);
  Quat rotation(int lane) const;
  /// A vector in torso axes in world axes.
  Vec3 to_world(int lane, Vec3 v) const;

  /// Sets the state itself; derive() must follow. Drops the last step's impulses.
  void set_state(int lane, const RobotState& state);
  RobotState state(int lane) const;
  /// Copies the robot in lane `from` of `others` to lane `to`, sensors included.
  void copy(int to, const LockstepState& others, int from);

  Row* rows() { return rows_.data(); }
  robot::SensorFrame& sensors() { return sensors_; }
  const robot::SensorFrame& sensors() const { return sensors_; }

 private:
  double number(int row, int lane) const { return static_cast<double>(at(row, lane)); }

  const Model& model_;
  const StateRows& layout_;
  std::vector<Row> rows_;
  robot::SensorFrame sensors_;
};

}  // namespace amble::physics::batch
