#include "amble/damage/payload.hpp"

#include <array>
#include <cmath>

#include "amble/core/index.hpp"

namespace amble::damage {
namespace {

using Matrix = std::array<std::array<double, 3>, 3>;

/// Columns: the images of the axes.
Matrix matrix_of(Quat q) {
  const Vec3 x = rotate(q, {1, 0, 0}), y = rotate(q, {0, 1, 0}), z = rotate(q, {0, 0, 1});
  return {{{x.x, y.x, z.x}, {x.y, y.y, z.y}, {x.z, y.z, z.z}}};
}

/// I = R diag(moments) Rᵀ.
Matrix inertia_of(const robot::Body& body) {
  const Matrix axes = matrix_of(body.inertia_rotation);
  const std::array<double, 3> moments{body.inertia_kg_m2.x, body.inertia_kg_m2.y, body.inertia_kg_m2.z};
  Matrix inertia{};
  for (std::size_t r = 0; r < 3; ++r)
    for (std::size_t c = 0; c < 3; ++c)
      for (std::size_t k = 0; k < 3; ++k) inertia[r][c] += moments[k] * axes[r][k] * axes[c][k];
  return inertia;
}

/// The inertia of a point mass at `arm_m`, m (|r|² 1 − r rᵀ): the parallel axis theorem.
void add_parallel_axis(Matrix& inertia, double mass_kg, Vec3 arm_m) {
  const std::array<double, 3> arm{arm_m.x, arm_m.y, arm_m.z};
  for (std::size_t r = 0; r < 3; ++r)
    for (std::size_t c = 0; c < 3; ++c)
      inertia[r][c] += mass_kg * ((r == c ? dot(arm_m, arm_m) : 0.0) - arm[r] * arm[c]);
}

/// One Jacobi rotation in the plane of the axes p and q, after which a[p][q] = 0 (Golub & Van Loan 2013, sec.
/// 8.5); returns it as a quaternion. Without sines, whose last bits differ between CPUs.
Quat rotate_away(Matrix& a, std::size_t p, std::size_t q) {
  const double ratio = (a[q][q] - a[p][p]) / (2.0 * a[p][q]);
  const double t = (ratio >= 0.0 ? 1.0 : -1.0) / (std::abs(ratio) + std::sqrt(1.0 + ratio * ratio));
  const double c = 1.0 / std::sqrt(1.0 + t * t), s = t * c;
  for (std::size_t k = 0; k < 3; ++k) {
    const double kp = a[k][p], kq = a[k][q];
    a[k][p] = c * kp - s * kq;
    a[k][q] = s * kp + c * kq;
  }
  for (std::size_t k = 0; k < 3; ++k) {
    const double pk = a[p][k], qk = a[q][k];
    a[p][k] = c * pk - s * qk;
    a[q][k] = s * pk + c * qk;
  }
  // The new axis p is c e_p − s e_q: a turn by −asin(s) about e_p × e_q; half angles from c = 1 − 2
  // sin²(φ/2).
  const double half_cosine = std::sqrt(0.5 * (1.0 + c)), half_sine = -s / (2.0 * half_cosine);
  const double sign = (q == (p + 1) % 3) ? 1.0 : -1.0;
  std::array<double, 3> axis{};
  axis[3 - p - q] = sign * half_sine;
  return {half_cosine, axis[0], axis[1], axis[2]};
}

/// Principal moments and axes of a symmetric matrix.
void set_principal(robot::Body& body, Matrix inertia) {
  constexpr int most_sweeps = 30;
  constexpr double negligible = 1e-17;
  const double size = inertia[0][0] + inertia[1][1] + inertia[2][2];
  Quat axes;
  for (int sweep = 0; sweep < most_sweeps; ++sweep)
    for (std::size_t p = 0; p < 3; ++p)
      for (std::size_t q = p + 1; q < 3; ++q)
        if (std::abs(inertia[p][q]) > negligible * size) axes = axes * rotate_away(inertia, p, q);
  const double length = std::sqrt(axes.w * axes.w + axes.x * axes.x + axes.y * axes.y + axes.z * axes.z);
  body.inertia_kg_m2 = {inertia[0][0], inertia[1][1], inertia[2][2]};
  body.inertia_rotation = {axes.w / length, axes.x / length, axes.y / length, axes.z / length};
}

}  // namespace

void add_point_mass(robot::Body& body, double mass_kg, Vec3 at_m) {
  const double both_kg = body.mass_kg + mass_kg;
  const Vec3 com_m = (1.0 / both_kg) * (body.mass_kg * body.com_m + mass_kg * at_m);
  Matrix inertia = inertia_of(body);
  add_parallel_axis(inertia, body.mass_kg, body.com_m - com_m);
  add_parallel_axis(inertia, mass_kg, at_m - com_m);
  body.mass_kg = both_kg;
  body.com_m = com_m;
  set_principal(body, inertia);
}

}  // namespace amble::damage
