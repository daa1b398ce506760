#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "amble/gait/circular.hpp"

namespace amble::gait {

/// Sums of one foot over a part of a trial. A stride goes from touch-down to touch-down and is counted in the
/// part in which it ends.
struct LegSums {
  std::int64_t contact_frames = 0;
  std::int64_t touchdowns = 0;
  std::int64_t strides = 0;
  std::int64_t stance_frames = 0;  ///< within the strides
  std::int64_t stride_frames = 0;
  double squared_stride_frames = 0.0;
};

/// Sums over a part of a trial from which the measurements of a gait follow. Those of consecutive parts can
/// be merged.
struct StrideSums {
  explicit StrideSums(std::size_t leg_count)
      : legs(leg_count), phases(leg_count, std::vector<CircularSum>(leg_count)) {}

  std::int64_t frames = 0;
  std::vector<LegSums> legs;
  /// phases[i][j]: when foot j lands in the strides of foot i, as a share of the stride.
  std::vector<std::vector<CircularSum>> phases;

  void merge(const StrideSums& later);
};

/// Finds touch-downs and strides in the debounced contacts of all feet, frame by frame. Remembers the last
/// few touch-downs per foot, however long the trial.
class StrideTracker {
 public:
  /// A time between two touch-downs of a foot that is longer than `longest_stride_frames` is a rest, not a
  /// stride.
  StrideTracker(std::size_t legs, std::int64_t longest_stride_frames);

  /// The next frame, leg by leg; its touch-downs and strides are added to `sums`. A foot that touches in the
  /// first frame has no touch-down in it.
  void add(const std::vector<bool>& touch, StrideSums& sums);

  /// Whether the foot's last touch-down is recent enough for the next one to end a stride.
  bool in_stride(std::size_t leg) const;

 private:
  static constexpr std::size_t remembered = 16;

  struct Foot {
    bool touch = false;
    std::int64_t stance_frames = 0;  ///< since the last touch-down
    std::int64_t touchdowns = 0;
    std::array<std::int64_t, remembered> landed_at{};  ///< frames of the last touch-downs, a ring buffer

    std::optional<std::int64_t> last_touchdown() const;
  };

  void land(std::size_t leg, StrideSums& sums);
  void add_phases(std::size_t leg, std::int64_t begin, StrideSums& sums) const;

  std::int64_t longest_stride_frames_;
  std::int64_t frame_ = 0;
  std::vector<Foot> feet_;
};

}  // namespace amble::gait
