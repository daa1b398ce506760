#pragma once

#include <cmath>

namespace amble {

/// A vector in three dimensions. Its variable's name and comment say unit and frame (docs/CONVENTIONS.md).
struct Vec3 {
  /// @{
  /// Along the axes of the frame it is given in.
  double x = 0.0, y = 0.0, z = 0.0;
  /// @}

  /// @{
  /// Component by component.
  friend Vec3 operator+(Vec3 a, Vec3 b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
  friend Vec3 operator-(Vec3 a, Vec3 b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
  friend Vec3 operator-(Vec3 a) { return {-a.x, -a.y, -a.z}; }
  friend Vec3 operator*(double s, Vec3 a) { return {s * a.x, s * a.y, s * a.z}; }
  /// @}
  friend bool operator==(const Vec3&, const Vec3&) = default;
};

/// a · b
inline double dot(Vec3 a, Vec3 b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}
/// a × b, right-handed
inline Vec3 cross(Vec3 a, Vec3 b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
/// |a|, in the unit of a
inline double norm(Vec3 a) {
  return std::sqrt(dot(a, a));
}

/// A rotation as a unit quaternion (w, x, y, z). rotate(q, v) takes v from the rotated frame to the fixed
/// one.
struct Quat {
  /// @{
  /// (cos a/2, sin a/2 × axis) of a rotation by a about a unit axis. By default no rotation.
  double w = 1.0, x = 0.0, y = 0.0, z = 0.0;
  /// @}

  /// Hamilton's product: first `b`, then `a`.
  friend Quat operator*(Quat a, Quat b) {
    return {a.w * b.w - a.x * b.x - a.y * b.y - a.z * b.z, a.w * b.x + a.x * b.w + a.y * b.z - a.z * b.y,
            a.w * b.y - a.x * b.z + a.y * b.w + a.z * b.x, a.w * b.z + a.x * b.y - a.y * b.x + a.z * b.w};
  }
  friend bool operator==(const Quat&, const Quat&) = default;
};

/// The inverse rotation; of a unit quaternion.
inline Quat conjugate(Quat q) {
  return {q.w, -q.x, -q.y, -q.z};
}
/// `v` turned by the unit quaternion `q`.
inline Vec3 rotate(Quat q, Vec3 v) {
  const Vec3 u{q.x, q.y, q.z};
  const Vec3 t = 2.0 * cross(u, v);
  return v + q.w * t + cross(u, t);
}
/// Rotation by `angle_rad` about the unit vector `axis`, right-handed.
inline Quat axis_angle(Vec3 axis, double angle_rad) {
  const double s = std::sin(0.5 * angle_rad);
  return {std::cos(0.5 * angle_rad), s * axis.x, s * axis.y, s * axis.z};
}

/// Rotation about x, y and z such that q = R_z(yaw) R_y(pitch) R_x(roll).
struct RollPitchYaw {
  double roll_rad = 0.0,  ///< −π … π; positive: the left side is up
      pitch_rad = 0.0,    ///< −π/2 … π/2; positive: the front is down
      yaw_rad = 0.0;      ///< −π … π; positive: to the left
};
/// The angles of a unit quaternion. Near a pitch of ± π/2 roll and yaw are not determined.
RollPitchYaw roll_pitch_yaw(Quat q);

}  // namespace amble
