#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "amble/core/math.hpp"
#include "amble/gait/gait.hpp"
#include "amble/gait/strides.hpp"

namespace amble::gait {

/// How long each classification lasted.
class ClassificationTally {
 public:
  void add(Classification classification, std::int64_t frames);
  void merge(const ClassificationTally& other);
  /// The longest; of equals the one that comes first in Gait and Irregular; none if the tally is empty.
  std::optional<Classification> longest() const;
  std::int64_t frames(Gait gait) const;

 private:
  std::array<std::array<std::int64_t, irregular_names.size()>, gait_names.size()> frames_{};
};

/// The sums over a part of a trial.
struct Stretch {
  std::int64_t first_frame = 0;
  StrideSums sums;
  Vec3 com_begin_m, com_end_m;
  ClassificationTally tally;

  /// Adds the stretch that follows this one.
  void merge(const Stretch& later);
};

/// The windows of a trial of any length: when there are more than `most`, they are merged in pairs, and later
/// ones are twice as long.
class Windows {
 public:
  static constexpr std::size_t most = 128;

  void add(Stretch window);
  const std::vector<Stretch>& list() const { return list_; }

 private:
  std::vector<Stretch> list_;
  std::int64_t added_per_window_ = 1;
  std::int64_t added_to_last_ = 0;
};

}  // namespace amble::gait
