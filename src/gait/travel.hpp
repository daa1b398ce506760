#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "amble/core/math.hpp"

namespace amble::gait {

/// Mechanical (not electrical) work of the motors.
struct MotorWork {
  double positive_j = 0.0;  ///< while torque and speed have the same sign
  double absolute_j = 0.0;  ///< braking work counted as positive too
};

/// The distance a robot travels and the work of its motors, frame by frame.
class TravelMeter {
 public:
  /// `angle_start_rad`: by joint, before the first frame.
  TravelMeter(Vec3 com_start_m, std::span<const float> angle_start_rad, double frame_s);

  /// The next frame: centre of mass, joint angles and the motors' torques in the step. If any frame has no
  /// torques (an empty span), there is no work().
  void add(Vec3 com_m, std::span<const float> angle_rad, std::span<const float> torque_nm);

  std::int64_t frames() const { return frames_; }
  /// From the start to the last frame, over the ground.
  double distance_m() const;
  /// Along the path, measured from second to second, so that the sway of single steps is not counted.
  double path_m() const;
  std::optional<MotorWork> work() const;

 private:
  void add_work(std::span<const float> angle_rad, std::span<const float> torque_nm);

  std::int64_t frames_per_leg_of_path_;
  std::int64_t frames_ = 0;
  Vec3 start_m_, path_point_m_, com_m_;
  double path_m_ = 0.0;
  MotorWork work_;
  bool torques_known_ = true;
  std::vector<double> angle_rad_;   ///< in the frame before
  std::vector<double> turned_rad_;  ///< in the step before
};

}  // namespace amble::gait
