#pragma once

#include <cstddef>

namespace amble::report {

/// Confidence of every interval in a report, but for claims of a value, which have theirs at 1 − alpha.
inline constexpr double confidence = 0.95;

/// Bootstrap intervals are given from so many runs on. Resamples cannot leave the range of a sample, and the
/// whole range of n values holds the median with a probability of 1 − 2^(1 − n): below six not even that is
/// an interval of 95 %.
inline constexpr std::size_t fewest_resampled = 6;

/// Fewer runs of a condition decide no claim, whatever its test says. Five against five are the fewest with
/// which a rank test can reach the paper's level of 0.01 (0.008; four against four 0.029).
inline constexpr std::size_t fewest_judged = 5;

}  // namespace amble::report
