#pragma once

#include <cstdint>
#include <optional>
#include <vector>

namespace amble::analysis {

/// Takes the chatter out of a foot's touch sensor, frame by frame: first every gap of fewer than
/// `debounce_frames` frames between two touches is closed, then every stance of fewer frames is dropped. What
/// is left keeps its first and last frame, so nothing is delayed but the answer. With 0 or 1 frames the
/// sensor passes as it is.
class ContactFilter {
 public:
  explicit ContactFilter(int debounce_frames);

  /// The next frame's touch in; out comes the settled touch of the frame lag() frames earlier, or nothing
  /// while there is none.
  std::optional<bool> add(bool touch);
  /// When there are no more frames: the settled touch of the last lag() frames (or of all, if they are
  /// fewer).
  std::vector<bool> finish() const;
  int lag() const { return static_cast<int>(settled_.size()) - 1; }

 private:
  std::size_t slot(std::int64_t frame) const;

  int debounce_frames_;
  std::vector<char> settled_;  ///< of the last lag() + 1 frames, a ring
  std::int64_t frames_ = 0;
  std::int64_t first_ = 0, last_ = 0;  ///< frames of the present stance; meaningless without one
  bool stance_ = false;                ///< there has been a touch
  bool confirmed_ = false;             ///< the present stance is long enough
};

/// The same for a whole record.
std::vector<bool> debounced(const std::vector<bool>& touch, int debounce_frames);

}  // namespace amble::analysis
