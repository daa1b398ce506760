#include "amble/gait/strides.hpp"

#include <algorithm>

#include "amble/core/check.hpp"
#include "amble/core/index.hpp"

namespace amble::gait {

void StrideSums::merge(const StrideSums& later) {
  AMBLE_CHECK(legs.size() == later.legs.size(), "sums of one robot");
  frames += later.frames;
  for (std::size_t i = 0; i < legs.size(); ++i) {
    legs[i].contact_frames += later.legs[i].contact_frames;
    legs[i].touchdowns += later.legs[i].touchdowns;
    legs[i].strides += later.legs[i].strides;
    legs[i].stance_frames += later.legs[i].stance_frames;
    legs[i].stride_frames += later.legs[i].stride_frames;
    legs[i].squared_stride_frames += later.legs[i].squared_stride_frames;
    for (std::size_t j = 0; j < legs.size(); ++j) phases[i][j].merge(later.phases[i][j]);
  }
}

std::optional<std::int64_t> StrideTracker::Foot::last_touchdown() const {
  if (touchdowns == 0) return std::nullopt;
  return landed_at[to_index(touchdowns - 1) % remembered];
}

StrideTracker::StrideTracker(std::size_t legs, std::int64_t longest_stride_frames)
    : longest_stride_frames_(longest_stride_frames), feet_(legs) {}

void StrideTracker::add(const std::vector<bool>& touch, StrideSums& sums) {
  ++sums.frames;
  // Strides end before new ones begin: feet that land together are then seen at the beginning of each other's
  // next stride, not at the end of the one before.
  if (frame_ > 0) {
    for (std::size_t leg = 0; leg < feet_.size(); ++leg)
      if (touch[leg] && !feet_[leg].touch) land(leg, sums);
  }
  for (std::size_t leg = 0; leg < feet_.size(); ++leg) {
    Foot& foot = feet_[leg];
    if (frame_ > 0 && touch[leg] && !foot.touch) {
      foot.landed_at[to_index(foot.touchdowns++) % remembered] = frame_;
      foot.stance_frames = 0;
    }
    foot.touch = touch[leg];
    foot.stance_frames += touch[leg];
    sums.legs[leg].contact_frames += touch[leg];
  }
  ++frame_;
}

bool StrideTracker::in_stride(std::size_t leg) const {
  const auto begin = feet_[leg].last_touchdown();
  return begin && frame_ - *begin <= longest_stride_frames_;
}

void StrideTracker::land(std::size_t leg, StrideSums& sums) {
  LegSums& sum = sums.legs[leg];
  ++sum.touchdowns;
  if (!in_stride(leg)) return;
  const std::int64_t begin = *feet_[leg].last_touchdown();
  const std::int64_t length = frame_ - begin;
  ++sum.strides;
  sum.stance_frames += feet_[leg].stance_frames;
  sum.stride_frames += length;
  sum.squared_stride_frames += static_cast<double>(length) * static_cast<double>(length);
  add_phases(leg, begin, sums);
}

void StrideTracker::add_phases(std::size_t leg, std::int64_t begin, StrideSums& sums) const {
  const auto length = static_cast<double>(frame_ - begin);
  for (std::size_t other = 0; other < feet_.size(); ++other) {
    const auto& landed_at = feet_[other].landed_at;
    const auto known = std::min<std::size_t>(to_index(feet_[other].touchdowns), remembered);
    // A foot that lands more often in one stride than is remembered has no phase relative to this one.
    if (known == remembered && std::ranges::min(landed_at) > begin) continue;
    for (std::size_t i = 0; i < known; ++i)
      if (landed_at[i] >= begin)
        sums.phases[leg][other].add(static_cast<double>(landed_at[i] - begin) / length);
  }
}

}  // namespace amble::gait
