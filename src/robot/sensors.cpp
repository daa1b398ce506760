#include "amble/robot/sensors.hpp"

#include <cmath>

namespace amble::robot {

Quat horizontal_frame(Vec3 gravity_m_s2) {
  if (gravity_m_s2.x == 0.0 && gravity_m_s2.y == 0.0) return {};
  const Vec3 up = (-1.0 / norm(gravity_m_s2)) * gravity_m_s2;
  // From z to `up` by the angle a about z × up: (1 + cos a, sin a × axis) is twice cos(a/2) times the
  // quaternion.
  const double scale = 1.0 / std::sqrt(2.0 * (1.0 + up.z));
  return {scale * (1.0 + up.z), -scale * up.y, scale * up.x, 0.0};
}

}  // namespace amble::robot
