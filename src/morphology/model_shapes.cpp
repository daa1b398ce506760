#include "amble/morphology/model_shapes.hpp"

#include <mujoco/mujoco.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <vector>

#include "amble/core/index.hpp"
#include "amble/morphology/convex_hull.hpp"
#include "amble/morphology/model_parts.hpp"
#include "amble/morphology/mujoco_math.hpp"
#include "amble/morphology/round_shape.hpp"

namespace amble::morphology {
namespace {

std::vector<Vec3> vertices_of(const mjModel_& model, int mesh) {
  std::vector<Vec3> vertices;
  const float* numbers = model.mesh_vert + 3 * model.mesh_vertadr[mesh];
  for (int v = 0; v < model.mesh_vertnum[mesh]; ++v, numbers += 3)
    vertices.push_back({numbers[0], numbers[1], numbers[2]});
  return vertices;
}

/// Points on an ellipsoid, evenly over the sphere it is stretched from (Fibonacci lattice).
std::vector<Vec3> points_of_ellipsoid(Vec3 radii_m) {
  std::vector<Vec3> points;
  constexpr int count = most_collision_vertices;
  for (int i = 0; i < count; ++i) {
    const double z = 1.0 - (2.0 * i + 1.0) / count, r = std::sqrt(1.0 - z * z);
    const double turn = 2.0 * std::numbers::pi * i * (std::numbers::phi - 1.0);
    points.push_back({radii_m.x * r * std::cos(turn), radii_m.y * r * std::sin(turn), radii_m.z * z});
  }
  return points;
}

/// Axes about which a wheel may be drawn, in the geom's frame: those of its body, and the principal ones of
/// its mesh, which MuJoCo makes the geom's own.
std::array<Vec3, 6> axes_of(const mjModel_& model, int g) {
  const Quat back = conjugate(quat(model.geom_quat + 4 * g));
  const Vec3 x{1, 0, 0}, y{0, 1, 0}, z{0, 0, 1};
  return {rotate(back, x), rotate(back, y), rotate(back, z), x, y, z};
}

robot::Geom cylinder(const RoundShape& round) {
  robot::Geom geom;
  geom.shape = robot::Shape::cylinder;
  geom.size_m = {round.radius_m, round.half_length_m, 0.0};
  geom.position_m = round.pose.position_m;
  geom.rotation = round.pose.rotation;
  return geom;
}

std::optional<robot::Geom> hull_of(const std::vector<Vec3>& points, bool collides) {
  ConvexHull hull = convex_hull(points, collides ? most_collision_vertices : most_decoration_vertices);
  if (hull.triangles.size() < 4) return std::nullopt;
  robot::Geom geom;
  geom.shape = robot::Shape::mesh;
  for (const Vec3 vertex : hull.vertices_m) geom.size_m.x = std::max(geom.size_m.x, norm(vertex));
  geom.vertices_m = std::move(hull.vertices_m);
  geom.triangles = std::move(hull.triangles);
  return geom;
}

}  // namespace

bool collides(const mjModel_& model, int geom) {
  if (model.geom_contype[geom] != 0 || model.geom_conaffinity[geom] != 0) return true;
  const auto tree = [&](int g) { return model.body_rootid[model.geom_bodyid[g]]; };
  for (int p = 0; p < model.npair; ++p) {
    const int first = model.pair_geom1[p], second = model.pair_geom2[p];
    if ((first == geom || second == geom) && tree(first) != tree(second)) return true;
  }
  return false;
}

std::optional<robot::Geom> shape_of(const mjModel_& model, int g, bool collides) {
  static const std::map<int, robot::Shape> shapes{{mjGEOM_SPHERE, robot::Shape::sphere},
                                                  {mjGEOM_CAPSULE, robot::Shape::capsule},
                                                  {mjGEOM_CYLINDER, robot::Shape::cylinder},
                                                  {mjGEOM_BOX, robot::Shape::box}};
  const int type = model.geom_type[g];
  const mjtNum* size = model.geom_size + 3 * g;
  if (type == mjGEOM_ELLIPSOID) return hull_of(points_of_ellipsoid({size[0], size[1], size[2]}), collides);
  if (type == mjGEOM_MESH) {
    const std::vector<Vec3> vertices = vertices_of(model, model.geom_dataid[g]);
    if (collides)
      if (const auto round = cylinder_of(vertices, axes_of(model, g))) return cylinder(*round);
    return hull_of(vertices, collides);
  }
  const auto found = shapes.find(type);
  if (found == shapes.end()) return std::nullopt;
  robot::Geom geom;
  geom.shape = found->second;
  geom.size_m = {size[0], size[1], size[2]};
  return geom;
}

}  // namespace amble::morphology
