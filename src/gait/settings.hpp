#pragma once

namespace amble::gait {

/// How footfalls are found (docs/GAIT.md says why these are the defaults).
struct Settings {
  double debounce_s = 0.08;       ///< shorter gaps in a stance, then shorter stances, are chatter
  double transient_s = 2.0;       ///< at the beginning; not counted in anything about footfalls
  double window_s = 5.0;          ///< the gait is classified anew for each window of at least this length
  double longest_stride_s = 5.0;  ///< a longer time between two touch-downs is a rest

  /// Throws UserError(ExitCode::bad_input) unless debounce is in [0, 1] s, transient in [0, 1e6] s, window in
  /// [0.1, 3600] s and the longest stride in (0, 3600] s.
  void validate() const;
};

/// A window is extended up to this many times window_s while a foot that strides has made fewer than
/// min_strides strides in it.
inline constexpr int longest_window = 5;

}  // namespace amble::gait
