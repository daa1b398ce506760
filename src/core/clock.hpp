#pragma once

#include <chrono>

namespace amble {

/// Seconds of a monotonic clock; only differences are meaningful.
inline double now_s() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

/// Adds its lifetime to `seconds`.
class Stopwatch {
 public:
  explicit Stopwatch(double& seconds) : seconds_(seconds), start_s_(now_s()) {}
  ~Stopwatch() { seconds_ += now_s() - start_s_; }
  Stopwatch(const Stopwatch&) = delete;
  Stopwatch& operator=(const Stopwatch&) = delete;

 private:
  double& seconds_;
  double start_s_;
};

}  // namespace amble
