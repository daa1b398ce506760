#include "amble/gait/contact_filter.hpp"

#include <algorithm>

#include "amble/core/index.hpp"

namespace amble::gait {

// A stance is confirmed at the latest 2 × debounce − 2 frames after its first: when a gap of debounce − 1
// frames began just before it was long enough.
ContactFilter::ContactFilter(int debounce_frames)
    : debounce_frames_(std::max(debounce_frames, 1)), debounced_(to_index(2 * debounce_frames_ - 1)) {}

std::optional<bool> ContactFilter::add(bool touch) {
  const std::int64_t frame = frames_++;
  debounced_[slot(frame)] = 0;
  if (touch) {
    if (!stance_ || frame - last_ > debounce_frames_) {
      first_ = frame;
      confirmed_ = false;
    } else if (confirmed_) {
      for (std::int64_t gap = last_ + 1; gap < frame; ++gap) debounced_[slot(gap)] = 1;
    }
    stance_ = true;
    last_ = frame;
    if (confirmed_) {
      debounced_[slot(frame)] = 1;
    } else if (frame - first_ + 1 >= debounce_frames_) {
      confirmed_ = true;
      for (std::int64_t past = first_; past <= frame; ++past) debounced_[slot(past)] = 1;
    }
  }
  if (frame < lag()) return std::nullopt;
  return debounced_[slot(frame - lag())] != 0;
}

std::vector<bool> ContactFilter::finish() const {
  std::vector<bool> rest;
  for (std::int64_t frame = std::max<std::int64_t>(0, frames_ - lag()); frame < frames_; ++frame)
    rest.push_back(debounced_[slot(frame)] != 0);
  return rest;
}

std::size_t ContactFilter::slot(std::int64_t frame) const {
  return to_index(frame % static_cast<std::int64_t>(debounced_.size()));
}

std::vector<bool> debounced(const std::vector<bool>& touch, int debounce_frames) {
  ContactFilter filter(debounce_frames);
  std::vector<bool> output;
  for (const bool frame : touch)
    if (const auto value = filter.add(frame)) output.push_back(*value);
  for (const bool value : filter.finish()) output.push_back(value);
  return output;
}

}  // namespace amble::gait
