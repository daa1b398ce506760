#pragma once

#include <cstddef>
#include <vector>

#include "amble/core/index.hpp"
#include "amble/core/math.hpp"
#include "amble/physics/batch/batch_engine.hpp"
#include "amble/physics/batch/step.hpp"

namespace amble::physics::batch {

/// The states of sixteen robots, and what their controllers may know.
class Robots {
 public:
  /// All of them retired. `model` and `layout` must live longer.
  Robots(const Model& model, const Rows& layout);

  float& at(int row, int lane) { return rows_[to_index(row)].lane[to_index(lane)]; }
  float at(int row, int lane) const { return rows_[to_index(row)].lane[to_index(lane)]; }
  Vec3 vec3(int row, int lane) const {
    return {number(row, lane), number(row + 1, lane), number(row + 2, lane)};
  }
  void put(int row, int lane, Vec3 v);
  Quat rotation(int lane) const;
  /// From the torso's axes to the world's.
  Vec3 to_world(int lane, Vec3 v) const;

  /// The state proper; what follows from it is due to derive(). Impulses of the step before are forgotten.
  void put_state(int lane, const BatchState& state);
  BatchState state(int lane) const;
  /// Lane `to` becomes the robot in lane `from` of others, sensors included.
  void copy(int to, const Robots& others, int from);

  Row* rows() { return rows_.data(); }
  robot::SensorFrame& sensors() { return sensors_; }
  const robot::SensorFrame& sensors() const { return sensors_; }

 private:
  double number(int row, int lane) const { return static_cast<double>(at(row, lane)); }

  const Model& model_;
  const Rows& layout_;
  std::vector<Row> rows_;
  robot::SensorFrame sensors_;
};

}  // namespace amble::physics::batch
