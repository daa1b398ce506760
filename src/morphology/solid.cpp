#include "amble/morphology/solid.hpp"

#include <numbers>

#include "amble/core/index.hpp"

namespace amble::morphology {
namespace {

using Tensor = std::array<double, 9>;

std::array<double, 3> components_of(Vec3 v) {
  return {v.x, v.y, v.z};
}

Tensor diagonal(double x, double y, double z) {
  return {x, 0, 0, 0, y, 0, 0, 0, z};
}

Tensor outer(Vec3 left, Vec3 right) {
  const auto a = components_of(left), b = components_of(right);
  Tensor product{};
  for (std::size_t r = 0; r < 3; ++r)
    for (std::size_t c = 0; c < 3; ++c) product[3 * r + c] = a[r] * b[c];
  return product;
}

void add_times(Tensor& sum, double factor, const Tensor& tensor) {
  for (std::size_t i = 0; i < 9; ++i) sum[i] += factor * tensor[i];
}

/// About the origin of the mesh's axes: tetrahedra with their fourth corner there.
Solid mesh(const robot::Geom& geom) {
  Solid solid;
  for (const auto& triangle : geom.triangles) {
    const Vec3 a = geom.vertices_m[to_index(triangle[0])], b = geom.vertices_m[to_index(triangle[1])],
               c = geom.vertices_m[to_index(triangle[2])], sum = a + b + c;
    const double volume = dot(a, cross(b, c)) / 6.0;
    solid.volume_m3 += volume;
    solid.first_m4 = solid.first_m4 + 0.25 * volume * sum;
    for (const Vec3 corner : {a, b, c, sum}) add_times(solid.second_m5, volume / 20.0, outer(corner, corner));
  }
  return solid;
}

/// About the shape's centre.
Solid of_shape(const robot::Geom& geom) {
  const Vec3 s = geom.size_m;
  const double r = s.x, h = s.y, pi = std::numbers::pi;
  const double ball = 4.0 / 3.0 * pi * r * r * r, tube = 2.0 * pi * r * r * h, across = tube * r * r / 4.0;
  switch (geom.shape) {
    case robot::Shape::sphere:
      return {ball, {}, diagonal(ball * r * r / 5.0, ball * r * r / 5.0, ball * r * r / 5.0)};
    case robot::Shape::cylinder:
      return {tube, {}, diagonal(across, across, tube * h * h / 3.0)};
    case robot::Shape::capsule: {
      const double side = across + ball * r * r / 5.0;
      return {tube + ball,
              {},
              diagonal(side, side, tube * h * h / 3.0 + ball * (r * r / 5.0 + 0.75 * h * r + h * h))};
    }
    case robot::Shape::box: {
      const double volume = 8.0 * s.x * s.y * s.z;
      return {
          volume, {}, diagonal(volume * s.x * s.x / 3.0, volume * s.y * s.y / 3.0, volume * s.z * s.z / 3.0)};
    }
    case robot::Shape::mesh:
      return mesh(geom);
  }
  return {};
}

/// R T Rᵀ.
Tensor turned(const Tensor& tensor, Quat by) {
  const std::array<Vec3, 3> axes{rotate(by, {1, 0, 0}), rotate(by, {0, 1, 0}), rotate(by, {0, 0, 1})};
  Tensor result{};
  for (std::size_t r = 0; r < 3; ++r)
    for (std::size_t c = 0; c < 3; ++c) add_times(result, tensor[3 * r + c], outer(axes[r], axes[c]));
  return result;
}

}  // namespace

std::array<double, 9> Solid::inertia_kg_m2(double mass_kg) const {
  Tensor spread = second_m5;
  add_times(spread, -volume_m3, outer(centre_m(), centre_m()));
  const double trace = spread[0] + spread[4] + spread[8], density = mass_kg / volume_m3;
  Tensor inertia = diagonal(density * trace, density * trace, density * trace);
  add_times(inertia, -density, spread);
  return inertia;
}

void add(Solid& solid, const robot::Geom& geom, const robot::Pose& pose) {
  const Solid own = of_shape(geom);
  const Vec3 shift = pose.position_m, first = rotate(pose.rotation, own.first_m4);
  solid.volume_m3 += own.volume_m3;
  solid.first_m4 = solid.first_m4 + first + own.volume_m3 * shift;
  add_times(solid.second_m5, 1.0, turned(own.second_m5, pose.rotation));
  add_times(solid.second_m5, 1.0, outer(shift, first));
  add_times(solid.second_m5, 1.0, outer(first, shift));
  add_times(solid.second_m5, own.volume_m3, outer(shift, shift));
}

}  // namespace amble::morphology
