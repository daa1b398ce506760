#pragma once

#include <cstddef>
#include <vector>

#include "amble/core/index.hpp"

namespace amble {

/// `rows` quantities for each of `lanes` robots that advance together, stored quantity by quantity (structure
/// of arrays), float32. row(r) is contiguous over the lanes, so that one SIMD instruction serves many robots.
/// Indices are not checked.
class LaneArray {
 public:
  /// No rows, no lanes: what an engine or a trial leaves out.
  LaneArray() = default;
  /// All values are 0.
  LaneArray(int rows, int lanes) : rows_(rows), lanes_(lanes), values_(to_index(rows) * to_index(lanes)) {}

  int rows() const { return rows_; }    ///< 0 if it was left out
  int lanes() const { return lanes_; }  ///< as many as the engine's
  /// @{
  /// One quantity of one robot.
  float& at(int row, int lane) { return values_[index(row, lane)]; }
  float at(int row, int lane) const { return values_[index(row, lane)]; }
  /// @}
  /// @{
  /// One quantity of all robots: lanes() numbers, valid until the whole array is assigned to.
  float* row(int r) { return values_.data() + index(r, 0); }
  const float* row(int r) const { return values_.data() + index(r, 0); }
  /// @}
  /// Sets all quantities of one robot to the same value.
  void set_lane(int lane, float value) {
    for (int r = 0; r < rows_; ++r) at(r, lane) = value;
  }

 private:
  std::size_t index(int row, int lane) const { return to_index(row) * to_index(lanes_) + to_index(lane); }

  int rows_ = 0;
  int lanes_ = 0;
  std::vector<float> values_;
};

}  // namespace amble
