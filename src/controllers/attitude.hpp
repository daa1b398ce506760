#pragma once

#include <span>

#include "amble/core/lanes.hpp"
#include "amble/substrate/sensor.hpp"
#include "amble/substrate/settings.hpp"

namespace amble::controllers {

/// What the sensor roll, pitch or yaw says in each lane, rad. `attitude_rad` is 3 × lanes: roll, pitch and
/// yaw of the root (robot::SensorFrame). The same bits on every CPU.
///
/// substrate::Attitude::true_angles: that angle. Attitude::misordered_quaternion: the authors' code takes its
/// angles from a quaternion (x, y, z, w) by arc tangents and an arc sine of
///   yaw: 2(xy + wz)/(w² + x² − y² − z²), pitch: 2(wy − xz), roll: 2(wx + yz)/(w² − x² − y² + z²),
/// but hands it ODE's (w, x, y, z). The three quotients then are the tangent of the roll, the sine of the
/// negative pitch, and the tangent of the negative yaw. The authors' robot looks along −x, which changes the
/// signs of roll and pitch. So the sensor roll says −yaw and the sensor yaw says −roll, both within ± π/2 as
/// an arc tangent leaves them, and the sensor pitch says the pitch.
void sense_attitude(substrate::Sensor::Kind kind, substrate::Attitude formula, const LaneArray& attitude_rad,
                    std::span<float> values_rad);

}  // namespace amble::controllers
