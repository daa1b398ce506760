#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "amble/robot/spec.hpp"

namespace amble::gait {

/// How a robot's targets pass from one cycle of a leg's timer to the next. A leg jumps in a frame in which it
/// was triggered, or its timer fell, stopped or started.
struct SeamReport {
  std::int64_t jumps = 0;  ///< of all legs
  double mean_rad =
      0.0;  ///< mean over the jumps of how far the leg's farthest moving target went in that frame
  double largest_rad = 0.0;  ///< the farthest
  /// Mean over the 0.1 s after each jump of the leg's motors' power, braking counted like driving, W; none if
  /// torques are not known.
  std::optional<double> power_after_w;
};

/// Measures seams frame by frame.
class SeamMeter {
 public:
  SeamMeter(const robot::RobotSpec& robot, double frame_s);

  struct Frame {
    std::span<const float> target_rad, angle_rad;  ///< by joint
    std::span<const float> torque_nm;              ///< by joint; empty: not known
    std::span<const float> timer, trigger;         ///< by leg: ticks, −1 while stopped; 1 or 0
  };
  void add(const Frame& frame);
  SeamReport report() const;

 private:
  void add_leg(std::size_t leg, const Frame& frame);
  bool jumped(std::size_t leg, const Frame& frame) const;

  std::vector<std::vector<std::size_t>> joints_of_leg_;
  double frame_s_;
  int frames_after_;
  std::vector<float> target_rad_, angle_rad_, timer_;  ///< of the frame before; empty before the first
  std::vector<int> left_;                              ///< by leg: frames in which power is still taken
  bool with_torques_ = true;
  std::int64_t jumps_ = 0, power_frames_ = 0;
  double sum_rad_ = 0.0, largest_rad_ = 0.0, power_sum_w_ = 0.0;
};

}  // namespace amble::gait
