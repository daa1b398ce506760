#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "amble/core/math.hpp"

namespace amble::analysis {

/// Energy that motors gave and took, as mechanical work (not electrical).
struct MotorWork {
  double positive_j = 0.0;  ///< where torque and speed have one sign
  double absolute_j = 0.0;  ///< that, and braking counted as if it cost as much
};

/// How far a robot went and what work its motors did, frame by frame.
class TravelMeter {
 public:
  TravelMeter(Vec3 com_start_m, std::size_t joints, double frame_s);

  /// The next frame: centre of mass, joint angles and what the motors gave in the step. Without torques (an
  /// empty span) in any frame there is no work().
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
  std::vector<double> angle_rad_;   ///< in the frame before; in the start pose all are 0
  std::vector<double> turned_rad_;  ///< in the step before
};

}  // namespace amble::analysis
