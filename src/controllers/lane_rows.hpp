#pragma once

#include <array>
#include <cstddef>
#include <vector>

namespace amble::controllers {

/// Rows of float32 over the lanes, as vector instructions want them: each begins on a cache line and has room
/// for a multiple of 16 lanes. Lanes beyond those asked for are 0 until written, and mean nothing.
class LaneRows {
 public:
  static constexpr int line_lanes = 16;  ///< lanes of a cache line

  LaneRows() = default;
  LaneRows(int rows, int lanes)
      : lines_(static_cast<std::size_t>(lanes + line_lanes - 1) / line_lanes),
        storage_(static_cast<std::size_t>(rows) * lines_) {}

  /// Floats from one row to the next.
  std::size_t stride() const { return lines_ * line_lanes; }
  float* row(int r) { return data() + static_cast<std::size_t>(r) * stride(); }
  const float* row(int r) const { return data() + static_cast<std::size_t>(r) * stride(); }
  float& at(int r, int lane) { return row(r)[lane]; }
  float at(int r, int lane) const { return row(r)[lane]; }
  float* data() { return reinterpret_cast<float*>(storage_.data()); }
  const float* data() const { return reinterpret_cast<const float*>(storage_.data()); }

 private:
  struct alignas(64) Line {
    std::array<float, line_lanes> lane{};
  };

  std::size_t lines_ = 0;
  std::vector<Line> storage_;
};

}  // namespace amble::controllers
