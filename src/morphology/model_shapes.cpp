#include "amble/morphology/model_shapes.hpp"

#include <fmt/format.h>
#include <mujoco/mujoco.h>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>
#include <vector>

#include "amble/core/index.hpp"
#include "amble/morphology/convex_hull.hpp"
#include "amble/morphology/model_parts.hpp"
#include "amble/morphology/mujoco_handlers.hpp"
#include "amble/robot/pose.hpp"

namespace amble::morphology {
namespace {

/// The apothem of a polygon of twelve corners, as a share of its radius, is 0.966.
constexpr double roundest = 0.96;
/// A ball fills 0.67 of its cylinder, a ball-ended bar up to 0.83, a tyre with round shoulders about 0.88.
constexpr double least_filling = 0.85;
constexpr int directions = 72;

double volume_of(std::span<const Vec3> points_m) {
  constexpr std::size_t corners = 100;
  const ConvexHull hull = convex_hull(points_m, corners);
  double volume = 0.0;
  for (const auto& triangle : hull.triangles) {
    const auto at = [&](std::size_t k) { return hull.vertices_m[static_cast<std::size_t>(triangle[k])]; };
    volume += dot(at(0), cross(at(1), at(2))) / 6.0;
  }
  return volume;
}

/// The turn that takes z to a unit vector.
Quat from_z_to(Vec3 axis) {
  const Quat half{1.0 + axis.z, -axis.y, axis.x, 0.0};
  const double length = std::sqrt(half.w * half.w + half.x * half.x + half.y * half.y);
  if (length < 1e-9) return {0.0, 1.0, 0.0, 0.0};
  return {half.w / length, half.x / length, half.y / length, 0.0};
}

std::optional<RoundShape> about(std::span<const Vec3> points_m, Vec3 axis, double volume_m3) {
  const Quat turn = from_z_to(axis);
  std::vector<Vec3> points;
  points.reserve(points_m.size());
  for (const Vec3 point : points_m) points.push_back(rotate(conjugate(turn), point));
  const auto [low, high] = std::ranges::minmax(points, {}, &Vec3::z);
  // How far the outline reaches in each direction; its mean, weighted by direction, is the centre.
  std::vector<Vec3> ways;
  std::vector<double> reach;
  Vec3 centre{0.0, 0.0, 0.5 * (low.z + high.z)};
  for (int k = 0; k < directions; ++k) {
    const double angle = 2.0 * std::numbers::pi * k / directions;
    ways.push_back({std::cos(angle), std::sin(angle), 0.0});
    double most = -std::numeric_limits<double>::infinity();
    for (const Vec3 point : points) most = std::max(most, dot(ways.back(), point));
    reach.push_back(most);
    centre = centre + (2.0 / directions * most) * ways.back();
  }
  double radius = 0.0, nearest = std::numeric_limits<double>::infinity();
  for (const Vec3 point : points)
    radius = std::max(radius, std::hypot(point.x - centre.x, point.y - centre.y));
  for (std::size_t k = 0; k < ways.size(); ++k)
    nearest = std::min(nearest, reach[k] - dot(ways[k], {centre.x, centre.y, 0.0}));
  const double half_length = 0.5 * (high.z - low.z);
  const double cylinder = 2.0 * std::numbers::pi * radius * radius * half_length;
  if (nearest < roundest * radius || volume_m3 < least_filling * cylinder) return std::nullopt;
  return RoundShape{radius, half_length, {rotate(turn, centre), turn}};
}

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

/// The poses of all bodies, in the model's own start pose.
std::vector<robot::Pose> poses_of(const mjModel_& model) {
  std::vector<robot::Pose> poses(to_index(model.nbody));
  for (int b = 1; b < model.nbody; ++b)
    poses[to_index(b)] = poses[to_index(model.body_parentid[b])] *
                         robot::Pose{vec3(model.body_pos + 3 * b), quat(model.body_quat + 4 * b)};
  return poses;
}

bool has_children(const mjModel_& model, int body) {
  for (int b = body + 1; b < model.nbody; ++b)
    if (model.body_parentid[b] == body) return true;
  return false;
}

bool is_on_a_limb(const mjModel_& model, int root, int body) {
  for (int b = body; b > root; b = model.body_parentid[b])
    if (model.body_jntnum[b] > 0) return true;
  return false;
}

}  // namespace

std::optional<RoundShape> cylinder_of(std::span<const Vec3> points_m, std::span<const Vec3> axes) {
  constexpr std::size_t fewest_points = 24;
  if (points_m.size() < fewest_points) return std::nullopt;
  const double volume_m3 = volume_of(points_m);
  if (!(volume_m3 > 0.0)) return std::nullopt;
  for (const Vec3 axis : axes)
    if (const auto shape = about(points_m, axis, volume_m3)) return shape;
  return std::nullopt;
}

bool moves_as_root(const mjModel_& model, int body) {
  const int joints = model.body_jntnum[body], first = model.body_jntadr[body];
  if (joints == 1 && model.jnt_type[first] == mjJNT_FREE) return true;
  return joints > 0 && std::all_of(model.jnt_type + first, model.jnt_type + first + joints,
                                   [](int type) { return type == mjJNT_SLIDE || type == mjJNT_HINGE; });
}

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

bool is_placeholder(const mjModel_& model, int geom,
                    const std::map<std::string, std::string>& missing_meshes) {
  return model.geom_type[geom] == mjGEOM_MESH &&
         missing_meshes.contains(model.names + model.name_meshadr[model.geom_dataid[geom]]);
}

bool ends_a_leg(const mjModel_& model, int root, int body) {
  if (has_children(model, body) || !is_on_a_limb(model, root, body)) return false;
  const std::vector<robot::Pose> poses = poses_of(model);
  const auto height_m = [&](int b) { return (poses[to_index(b)] * vec3(model.body_ipos + 3 * b)).z; };
  double lowest = height_m(body);
  for (int b = root; b < model.nbody; ++b)
    if (model.body_rootid[b] == root) lowest = std::min(lowest, height_m(b));
  constexpr double level_m = 1e-6;
  return height_m(body) <= 0.5 * (height_m(root) + lowest) + level_m;
}

bool is_of_a_foot(const mjModel_& model, int root, int geom,
                  const std::map<std::string, std::string>& missing_meshes) {
  const int body = model.geom_bodyid[geom];
  if (!ends_a_leg(model, root, body)) return false;
  const robot::Pose pose = poses_of(model)[to_index(body)];
  const auto height_m = [&](int g) { return (pose * vec3(model.geom_pos + 3 * g)).z; };
  // The placeholder's centre, of which its height is known, is that far beside the mesh's origin.
  constexpr double placeholder_m = 1e-3;
  for (int g = model.body_geomadr[body], end = g + model.body_geomnum[body]; g < end; ++g) {
    if (!is_placeholder(model, g, missing_meshes) && collides(model, g) &&
        height_m(g) < height_m(geom) - placeholder_m)
      return false;
  }
  return true;
}

bool is_ground(const mjModel_& model, int geom) {
  if (model.geom_type[geom] != mjGEOM_PLANE || !collides(model, geom)) return false;
  int body = model.geom_bodyid[geom];
  if (model.body_weldid[body] != 0) return false;
  robot::Pose pose{vec3(model.geom_pos + 3 * geom), quat(model.geom_quat + 4 * geom)};
  for (; body != 0; body = model.body_parentid[body])
    pose = robot::Pose{vec3(model.body_pos + 3 * body), quat(model.body_quat + 4 * body)} * pose;
  return std::abs(pose.position_m.z) < 1e-9 && rotate(pose.rotation, {0.0, 0.0, 1.0}).z > 1.0 - 1e-12;
}

void let_visuals_collide(mjModel_& model, ReadingNotes& notes) {
  // A tree of bodies of which none moves is not the robot.
  std::vector<bool> moves(to_index(model.nbody));
  for (int body = 1; body < model.nbody; ++body)
    if (model.body_weldid[body] != 0) moves[to_index(model.body_rootid[body])] = true;
  std::vector<int> shapes;
  for (int g = 0; g < model.ngeom; ++g) {
    const int body = model.geom_bodyid[g];
    if (body == 0 || !moves[to_index(model.body_rootid[body])]) continue;
    if (collides(model, g)) return;
    shapes.push_back(g);
  }
  if (shapes.empty()) return;
  for (const int g : shapes) model.geom_contype[g] = model.geom_conaffinity[g] = 1;
  notes.add(Reading::replaced,
            fmt::format("that nothing of the robot collides: its {} shapes to look at do", shapes.size()));
}

}  // namespace amble::morphology
