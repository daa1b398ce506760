#include "amble/controllers/attitude.hpp"

#include <algorithm>

#include "amble/core/check.hpp"

namespace amble::controllers {
namespace {

constexpr int roll_row = 0, pitch_row = 1, yaw_row = 2;

/// The arc tangent of the tangent of −angle, for an angle within ± 3/2 π.
float negative_arc_tangent(float angle_rad) {
  constexpr float half_turn = 3.14159265f, quarter_turn = 1.57079633f;
  const float above = angle_rad > quarter_turn ? half_turn : 0.0f;
  const float below = angle_rad < -quarter_turn ? half_turn : 0.0f;
  return above - below - angle_rad;
}

}  // namespace

void sense_attitude(substrate::Sensor::Kind kind, substrate::Attitude formula, const LaneArray& attitude_rad,
                    std::span<float> values_rad) {
  using Kind = substrate::Sensor::Kind;
  AMBLE_CHECK(kind == Kind::roll || kind == Kind::pitch || kind == Kind::yaw, "no sensor of the attitude");
  AMBLE_CHECK(attitude_rad.rows() == 3 && static_cast<std::size_t>(attitude_rad.lanes()) == values_rad.size(),
              "the attitude is 3 × lanes");
  const bool swapped = formula == substrate::Attitude::misordered_quaternion && kind != Kind::pitch;
  const int own_row = kind == Kind::roll ? roll_row : kind == Kind::pitch ? pitch_row : yaw_row;
  if (!swapped) {
    std::copy_n(attitude_rad.row(own_row), values_rad.size(), values_rad.begin());
    return;
  }
  const float* const other_rad = attitude_rad.row(kind == Kind::roll ? yaw_row : roll_row);
  for (std::size_t lane = 0; lane < values_rad.size(); ++lane)
    values_rad[lane] = negative_arc_tangent(other_rad[lane]);
}

}  // namespace amble::controllers
