#include "amble/core/math.hpp"

#include <algorithm>

namespace amble {

RollPitchYaw roll_pitch_yaw(Quat q) {
  // From R = R_z(yaw) R_y(pitch) R_x(roll): R31 = −sin pitch, R32 / R33 = tan roll, R21 / R11 = tan yaw.
  const double sine_of_pitch = std::clamp(2.0 * (q.w * q.y - q.z * q.x), -1.0, 1.0);
  return {std::atan2(2.0 * (q.w * q.x + q.y * q.z), 1.0 - 2.0 * (q.x * q.x + q.y * q.y)),
          std::asin(sine_of_pitch),
          std::atan2(2.0 * (q.w * q.z + q.x * q.y), 1.0 - 2.0 * (q.y * q.y + q.z * q.z))};
}

}  // namespace amble
