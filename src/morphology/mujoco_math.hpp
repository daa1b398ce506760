#pragma once

#include <mujoco/mujoco.h>

#include "amble/core/math.hpp"

namespace amble::morphology {

/// Three or four numbers of one of MuJoCo's arrays.
inline Vec3 vec3(const mjtNum* numbers) {
  return {numbers[0], numbers[1], numbers[2]};
}
inline Quat quat(const mjtNum* numbers) {
  return {numbers[0], numbers[1], numbers[2], numbers[3]};
}

}  // namespace amble::morphology
