#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "amble/analysis/gait_class.hpp"
#include "amble/analysis/strides.hpp"
#include "amble/core/math.hpp"

namespace amble::analysis {

/// How long each verdict held.
class VerdictTally {
 public:
  void add(Verdict verdict, std::int64_t frames);
  void merge(const VerdictTally& other);
  /// Of equals the one that stands first in Gait and Irregular; nothing if the tally is empty.
  std::optional<Verdict> longest() const;
  std::int64_t frames(Gait gait) const;

 private:
  std::array<std::array<std::int64_t, irregular_names.size()>, gait_names.size()> frames_{};
};

/// A part of a trial with what was seen in it.
struct Stretch {
  std::int64_t first_frame = 0;
  StrideSums sums;
  Vec3 com_begin_m, com_end_m;
  VerdictTally tally;

  /// Takes the stretch that follows this one.
  void merge(const Stretch& later);
};

/// The windows of a trial, which may be of any length: when there are too many, they are merged two by two,
/// and those to come will be twice as long.
class GaitWindows {
 public:
  static constexpr std::size_t most = 128;

  void add(Stretch window);
  const std::vector<Stretch>& list() const { return list_; }

 private:
  std::vector<Stretch> list_;
  std::int64_t added_per_window_ = 1;
  std::int64_t added_to_last_ = 0;
};

}  // namespace amble::analysis
