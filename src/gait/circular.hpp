#pragma once

#include <cmath>
#include <cstdint>
#include <numbers>

namespace amble::gait {

/// The difference of two phases, or any angle in turns, wrapped into (−½, ½].
inline double wrapped(double turns) {
  return turns - std::ceil(turns - 0.5);
}

/// The distance of two phases on the circle, in [0, ½].
inline double phase_distance(double a, double b) {
  return std::abs(wrapped(a - b));
}

/// Circular mean and resultant of phases (in turns): the mean of 0.9 and 0.1 is 0. Holds sums only, so two of
/// them can be merged.
class CircularSum {
 public:
  void add(double phase) {
    const double angle_rad = 2.0 * std::numbers::pi * phase;
    cos_ += std::cos(angle_rad);
    sin_ += std::sin(angle_rad);
    ++count_;
  }
  void merge(const CircularSum& other) {
    cos_ += other.cos_;
    sin_ += other.sin_;
    count_ += other.count_;
  }

  std::int64_t count() const { return count_; }
  /// In [0, 1); undefined without phases, and of little meaning when resultant() is near 0.
  double mean() const {
    const double turns = std::atan2(sin_, cos_) / (2.0 * std::numbers::pi);
    const double positive = turns < 0.0 ? turns + 1.0 : turns;
    return positive < 1.0 ? positive : 0.0;
  }
  /// Length of the mean of the unit vectors: 1 if all phases are equal, near 0 if they are uniform (Mardia &
  /// Jupp, Directional Statistics, 2000, sec. 2.3). 0 without phases.
  double resultant() const {
    return count_ == 0 ? 0.0 : std::hypot(cos_, sin_) / static_cast<double>(count_);
  }

 private:
  double cos_ = 0.0, sin_ = 0.0;
  std::int64_t count_ = 0;
};

/// The drift of a phase over a long time: takes its means over successive windows and unwraps them, assuming
/// that it moves by less than half a turn from one window to the next.
class PhaseDrift {
 public:
  void add(double time_s, double phase) {
    if (count_ > 0) drift_ += wrapped(phase - last_);
    last_ = phase;
    ++count_;
    // Welford's update of a linear regression, which stays accurate over hours.
    const double n = static_cast<double>(count_), dt = time_s - mean_t_;
    mean_t_ += dt / n;
    mean_drift_ += (drift_ - mean_drift_) / n;
    var_t_ += dt * (time_s - mean_t_);
    covar_ += dt * (drift_ - mean_drift_);
  }

  std::int64_t count() const { return count_; }
  /// From the first to the last, turns.
  double turns() const { return drift_; }
  /// Slope of the regression line, turns per second; 0 with fewer than two phases.
  double turns_per_s() const { return var_t_ > 0.0 ? covar_ / var_t_ : 0.0; }

 private:
  std::int64_t count_ = 0;
  double last_ = 0.0, drift_ = 0.0;
  double mean_t_ = 0.0, mean_drift_ = 0.0, var_t_ = 0.0, covar_ = 0.0;
};

}  // namespace amble::gait
