#pragma once

#include <cstdint>
#include <optional>
#include <vector>

namespace amble::gait {

/// Debounces a foot's touch sensor frame by frame: every gap of fewer than `debounce_frames` frames between
/// two touches is closed, then every stance of fewer frames is dropped. The stances that remain keep their
/// first and last frames; only the output is delayed, by lag() frames. With 0 or 1 frames the signal is
/// unchanged.
class ContactFilter {
 public:
  explicit ContactFilter(int debounce_frames);

  /// Takes the next frame's touch; returns the debounced touch of the frame lag() frames earlier, if there is
  /// one.
  std::optional<bool> add(bool touch);
  /// After the last frame: the debounced touch of the last lag() frames (or of all, if there are fewer).
  std::vector<bool> finish() const;
  int lag() const { return static_cast<int>(debounced_.size()) - 1; }

 private:
  std::size_t slot(std::int64_t frame) const;

  int debounce_frames_;
  std::vector<char> debounced_;  ///< of the last lag() + 1 frames, a ring buffer
  std::int64_t frames_ = 0;
  std::int64_t first_ = 0, last_ = 0;  ///< frames of the current stance; meaningless without one
  bool stance_ = false;                ///< there has been a touch
  bool confirmed_ = false;             ///< the current stance is long enough
};

/// The same for a whole signal.
std::vector<bool> debounced(const std::vector<bool>& touch, int debounce_frames);

}  // namespace amble::gait
