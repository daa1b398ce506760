#include "amble/score/direction.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace amble::score {
namespace {

/// Cosine and sine of an angle of at most 45 degrees, by their Taylor series up to the last bit. The
/// library's functions have other last bits on other CPUs.
Direction small_turn(double angle_rad) {
  Direction turn{1.0, angle_rad};
  double cosine_term = 1.0, sine_term = angle_rad;
  for (int n = 2; n <= 20; n += 2) {
    cosine_term *= -angle_rad * angle_rad / (n * (n - 1));
    sine_term *= -angle_rad * angle_rad / (n * (n + 1));
    turn.x += cosine_term;
    turn.y += sine_term;
  }
  return turn;
}

}  // namespace

Direction unit_direction(double angle_deg) {
  const double quarters = std::nearbyint(angle_deg / 90.0);
  Direction turn = small_turn((angle_deg - 90.0 * quarters) * (std::numbers::pi / 180.0));
  for (int i = 0; i < (static_cast<int>(quarters) % 4 + 4) % 4; ++i) turn = {-turn.y, turn.x};
  return turn;
}

Direction turned(const record::Trajectory& trajectory, double angle_deg) {
  const Direction turn = unit_direction(angle_deg);
  const Direction forward{trajectory.forward_x, trajectory.forward_y};
  return {forward.x * turn.x - forward.y * turn.y, forward.x * turn.y + forward.y * turn.x};
}

/// By the series of the arc tangent: as small_turn(), not by the library's function.
double angle_deg(Direction direction) {
  const double x = std::abs(direction.x), y = std::abs(direction.y);
  const double low = std::min(x, y), high = std::max(x, y);
  if (high == 0.0) return 0.0;
  // The series of the half angle, whose tangent is at most tan 22.5° = 0.41: tan(φ/2) = sin φ / (1 + cos φ).
  const double tangent = low / (high + std::sqrt(low * low + high * high));
  double sum = 0.0, power = tangent;
  for (int n = 1; n <= 41; n += 2) {
    sum += (n % 4 == 1 ? power : -power) / n;
    power *= tangent * tangent;
  }
  double angle = 2.0 * sum * (180.0 / std::numbers::pi);
  if (y > x) angle = 90.0 - angle;
  if (direction.x < 0.0) angle = 180.0 - angle;
  return direction.y < 0.0 ? -angle : angle;
}

}  // namespace amble::score
