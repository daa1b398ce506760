#include "amble/gait/windows.hpp"

#include <numeric>
#include <utility>

#include "amble/core/index.hpp"

namespace amble::gait {

void ClassificationTally::add(Classification classification, std::int64_t frames) {
  frames_[to_index(classification.gait)][to_index(classification.reason)] += frames;
}

void ClassificationTally::merge(const ClassificationTally& other) {
  for (std::size_t gait = 0; gait < frames_.size(); ++gait)
    for (std::size_t reason = 0; reason < frames_[gait].size(); ++reason)
      frames_[gait][reason] += other.frames_[gait][reason];
}

std::optional<Classification> ClassificationTally::longest() const {
  std::optional<Classification> longest;
  std::int64_t most = 0;
  for (std::size_t gait = 0; gait < frames_.size(); ++gait) {
    for (std::size_t reason = 0; reason < frames_[gait].size(); ++reason) {
      if (frames_[gait][reason] <= most) continue;
      most = frames_[gait][reason];
      longest = Classification{static_cast<Gait>(gait), static_cast<Irregular>(reason)};
    }
  }
  return longest;
}

std::int64_t ClassificationTally::frames(Gait gait) const {
  const auto& reasons = frames_[to_index(gait)];
  return std::accumulate(reasons.begin(), reasons.end(), std::int64_t{0});
}

void Stretch::merge(const Stretch& later) {
  sums.merge(later.sums);
  com_end_m = later.com_end_m;
  tally.merge(later.tally);
}

void Windows::add(Stretch window) {
  if (!list_.empty() && added_to_last_ < added_per_window_) {
    list_.back().merge(window);
    ++added_to_last_;
    return;
  }
  if (list_.size() == most) {
    for (std::size_t i = 0; i < most / 2; ++i) {
      Stretch merged = std::move(list_[2 * i]);
      merged.merge(list_[2 * i + 1]);
      list_[i] = std::move(merged);
    }
    list_.erase(list_.begin() + most / 2, list_.end());
    added_per_window_ *= 2;
  }
  list_.push_back(std::move(window));
  added_to_last_ = 1;
}

}  // namespace amble::gait
