#include "amble/morphology/missing_mass.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <mujoco/mujoco.h>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <map>
#include <numbers>
#include <set>
#include <utility>
#include <vector>

#include "amble/core/index.hpp"
#include "amble/morphology/model_shapes.hpp"
#include "amble/morphology/mujoco_handlers.hpp"
#include "amble/robot/doubts.hpp"

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

/// Mass, centre and principal moments of several bodies that are fixed to each other (parallel axis
/// theorem).
void combine_masses(const mjModel_& model, const std::vector<int>& members,
                    std::span<const robot::Pose> pose_in_group, robot::Body& body) {
  Vec3 weighted;
  for (const int m : members) {
    body.mass_kg += model.body_mass[m];
    weighted = weighted + model.body_mass[m] * (pose_in_group[to_index(m)] * vec3(model.body_ipos + 3 * m));
  }
  body.com_m = (1.0 / body.mass_kg) * weighted;

  std::array<mjtNum, 9> tensor{};
  for (const int m : members) {
    const robot::Pose own = pose_in_group[to_index(m)] *
                            robot::Pose{vec3(model.body_ipos + 3 * m), quat(model.body_iquat + 4 * m)};
    const Vec3 lever = own.position_m - body.com_m;
    const std::array<Vec3, 3> axes{rotate(own.rotation, {1, 0, 0}), rotate(own.rotation, {0, 1, 0}),
                                   rotate(own.rotation, {0, 0, 1})};
    const std::array<double, 3> d{lever.x, lever.y, lever.z};
    for (std::size_t r = 0; r < 3; ++r) {
      for (std::size_t c = 0; c < 3; ++c) {
        double moment = model.body_mass[m] * ((r == c ? dot(lever, lever) : 0.0) - d[r] * d[c]);
        for (std::size_t k = 0; k < 3; ++k) {
          const std::array<double, 3> axis{axes[k].x, axes[k].y, axes[k].z};
          moment += model.body_inertia[3 * to_index(m) + k] * axis[r] * axis[c];
        }
        tensor[3 * r + c] += moment;
      }
    }
  }
  std::array<mjtNum, 3> moments{};
  std::array<mjtNum, 9> vectors{};
  std::array<mjtNum, 4> rotation{};
  mju_eig3(moments.data(), vectors.data(), rotation.data(), tensor.data());
  body.inertia_kg_m2 = vec3(moments.data());
  body.inertia_rotation = quat(rotation.data());
}

constexpr double water_kg_m3 = 1000.0;
/// A body that weighs no more has its mass from placeholders of meshes.
constexpr double nothing_kg = 2e-6;

class MassMender {
 public:
  MassMender(mjModel_& model, const std::map<std::string, std::string>& missing_meshes)
      : model_(model), missing_meshes_(missing_meshes) {}

  std::set<int> mend(const ModelText& text, ReadingNotes& notes) {
    const std::vector<int> without_inertial = links_without_inertial(text);
    find_what_weighs(text, without_inertial);
    for (const auto& [name, given] : text.missing_masses) {
      const int b = body_of(name);
      if (b < 0) continue;
      if (given.mass_kg > 0.0 || !weighing_.contains(group_of(b)))
        mend(b, name, given.mass_kg);
      else
        set_weightless(b);
    }
    mend_links(without_inertial);
    mend_roots();
    const std::vector<bool> has_inertial = text.urdf ? std::vector<bool>(to_index(model_.nbody), true)
                                                     : bodies_with_inertial(text.root, model_.nbody);
    for (int b = 1; b < model_.nbody; ++b) {
      if (!(model_.body_mass[b] > 0.0) || !shows_placeholder(b)) continue;
      if (model_.body_mass[b] < nothing_kg)
        mend(b, name_of(b), 0.0);
      else if (!has_inertial[to_index(b)])
        mend_lost(b);
    }
    mend_templates();
    add_notes(notes);
    return mended_;
  }

 private:
  void add_notes(ReadingNotes& notes) const {
    const auto note = [&](Reading reading, const char* what, const std::vector<std::string>& names,
                          bool is_doubt = false) {
      if (!names.empty()) notes.add(reading, fmt::format("{}: {}", what, fmt::join(names, ", ")), is_doubt);
    };
    note(Reading::kept, "links without a mass of their own weigh nothing, welded to links that have one",
         weightless_);
    note(Reading::replaced,
         "links without <inertial>, welded to none that has a mass: theirs is that of their shapes filled "
         "with water, 1000 kg/m3; give them mass and inertia",
         links_of_water_, true);
    note(Reading::replaced,
         "moments of inertia that are missing or 0, by those of the shapes with the body's mass", by_shapes_);
    note(Reading::replaced,
         "masses that are missing or 0, by those of the shapes filled with water, 1000 kg/m3", filled_, true);
    note(Reading::replaced,
         "moments of inertia that are missing or 0, without shapes, by those of a ball of water", balls_);
    note(
        Reading::replaced,
        "moments of inertia of bodies with a mesh that cannot be read, by those of their other shapes, or of "
        "a ball of water, with the mass that their geoms have",
        lost_);
    note(Reading::replaced,
         "moments of inertia that would need a body larger than the robot, by those of the shapes with the "
         "body's mass; check inertia, mass and units",
         templates_, true);
  }

  std::string name_of(int b) const { return model_.names + model_.name_bodyadr[b]; }

  /// By its name, or "#3"; negative: none.
  int body_of(const std::string& name) const {
    const int b =
        name.starts_with('#') ? std::atoi(name.c_str() + 1) : mj_name2id(&model_, mjOBJ_BODY, name.c_str());
    return b > 0 && b < model_.nbody ? b : -1;
  }

  /// A number for all bodies that are welded to each other. For MuJoCo all roots of URDFs are welded to the
  /// world.
  int group_of(int b) const {
    return model_.body_weldid[b] == 0 ? -model_.body_rootid[b] : model_.body_weldid[b];
  }

  /// Of a URDF, unless it says itself that all masses come from shapes.
  std::vector<int> links_without_inertial(const ModelText& text) const {
    std::vector<int> links;
    const XmlElement* extension = text.urdf ? text.root.child("mujoco") : nullptr;
    const XmlElement* compiler = extension != nullptr ? extension->child("compiler") : nullptr;
    if (!text.urdf || (compiler != nullptr && compiler->attribute_or("inertiafromgeom", "") == "true"))
      return links;
    for (const XmlElement& link : text.root.children) {
      if (link.name != "link" || link.child("inertial") != nullptr) continue;
      if (const int b = body_of(link.attribute_or("name", "")); b > 0) links.push_back(b);
    }
    return links;
  }

  void find_what_weighs(const ModelText& text, const std::vector<int>& without_inertial) {
    std::set<int> unknown(without_inertial.begin(), without_inertial.end());
    for (const auto& [name, given] : text.missing_masses)
      if (!(given.mass_kg > 0.0)) unknown.insert(body_of(name));
    for (int b = 1; b < model_.nbody; ++b)
      if (model_.body_mass[b] > 0.0 && !unknown.contains(b)) weighing_.insert(group_of(b));
  }

  void set_weightless(int b) {
    if (model_.body_geomnum[b] > 0) weightless_.push_back(name_of(b));
    set(b, 0.0, {});
  }

  /// MuJoCo fills what collides with water. ROS knows links that weigh nothing, as its bases do: what they
  /// are welded to has their mass.
  void mend_links(const std::vector<int>& without_inertial) {
    for (const int b : without_inertial) {
      if (!(model_.body_mass[b] > 0.0)) continue;
      if (weighing_.contains(group_of(b)))
        set_weightless(b);
      else if (model_.body_mass[b] >= nothing_kg || !shows_placeholder(b))
        links_of_water_.push_back(name_of(b));
    }
  }

  bool is_placeholder(int g) const { return morphology::is_placeholder(model_, g, missing_meshes_); }

  bool shows_placeholder(int b) const {
    for (int g = model_.body_geomadr[b], end = g + model_.body_geomnum[b]; g < end; ++g)
      if (is_placeholder(g)) return true;
    return false;
  }

  /// MuJoCo asks bodies for no mass or moments that are fixed to the world, as a URDF's root is for it.
  void mend_roots() {
    for (int root = 1; root < model_.nbody; ++root) {
      if (model_.body_parentid[root] != 0 || model_.body_weldid[root] != 0) continue;
      double inertia = 0.0, mass_kg = 0.0;
      bool carries = false;  // what moves
      const auto is_part = [&](int b) { return model_.body_rootid[b] == root && model_.body_weldid[b] == 0; };
      for (int b = root; b < model_.nbody; ++b) {
        carries = carries || (model_.body_rootid[b] == root && !is_part(b));
        mass_kg += is_part(b) ? model_.body_mass[b] : 0.0;
        for (int i = 0; i < 3; ++i) inertia += is_part(b) ? model_.body_inertia[3 * b + i] : 0.0;
      }
      const bool lacks_mass = carries && !(mass_kg > 0.0), lacks_moments = inertia < mjMINVAL;
      for (int b = root; b < model_.nbody; ++b)
        if (is_part(b) && (lacks_mass || (lacks_moments && model_.body_mass[b] > 0.0)))
          mend(b, name_of(b), model_.body_mass[b]);
    }
  }

  /// How far the shapes of the body's robot reach from its root, with all joints as the file has them.
  double reach_m(int root) const {
    std::vector<robot::Pose> poses(to_index(model_.nbody));
    double reach = 0.0;
    for (int b = root; b < model_.nbody; ++b) {
      if (model_.body_rootid[b] != root) continue;
      if (b != root)
        poses[to_index(b)] = poses[to_index(model_.body_parentid[b])] *
                             robot::Pose{vec3(model_.body_pos + 3 * b), quat(model_.body_quat + 4 * b)};
      for (int g = model_.body_geomadr[b], end = g + model_.body_geomnum[b]; g < end; ++g) {
        const robot::Pose at = poses[to_index(b)] * robot::Pose{vec3(model_.geom_pos + 3 * g), {}};
        if (!is_placeholder(g)) reach = std::max(reach, norm(at.position_m) + model_.geom_rbound[g]);
      }
    }
    return reach;
  }

  /// Moments as templates have them, whatever the body. Without shapes they stay, and are doubted.
  void mend_templates() {
    std::map<int, double> reaches_m;
    for (int b = 1; b < model_.nbody; ++b) {
      const int root = model_.body_rootid[b];
      const auto [reach, is_new] = reaches_m.try_emplace(root, 0.0);
      if (is_new) reach->second = reach_m(root);
      const double mass_kg = model_.body_mass[b];
      const mjtNum* const moments = model_.body_inertia + 3 * b;
      if (!robot::is_larger_than_robot(moments[0] + moments[1] + moments[2], mass_kg, reach->second))
        continue;
      Solid solid = solid_of(b, true);
      if (!(solid.volume_m3 > 0.0)) solid = solid_of(b, false);
      if (!(solid.volume_m3 > 0.0) || !(mass_kg > 0.0)) continue;
      set(b, mass_kg, solid.inertia_kg_m2(mass_kg));
      templates_.push_back(name_of(b));
    }
  }

  /// A shape in its body's frame.
  struct Placed {
    robot::Geom shape;
    robot::Pose pose;
  };

  /// A cylinder with a ball of its radius about each end is a capsule, of which half of either ball is new.
  static void join_capsules(std::vector<Placed>& shapes) {
    const auto ball_at = [&shapes](Vec3 end_m, double radius_m) {
      return std::ranges::find_if(shapes, [=](const Placed& ball) {
        return ball.shape.shape == robot::Shape::sphere &&
               std::abs(ball.shape.size_m.x - radius_m) <= 1e-6 * radius_m &&
               norm(ball.pose.position_m - end_m) <= 1e-6 * radius_m;
      });
    };
    for (std::size_t i = 0; i < shapes.size(); ++i) {
      if (shapes[i].shape.shape != robot::Shape::cylinder) continue;
      const double radius_m = shapes[i].shape.size_m.x, half_m = shapes[i].shape.size_m.y;
      const auto ends = {shapes[i].pose * Vec3{0.0, 0.0, -half_m}, shapes[i].pose * Vec3{0.0, 0.0, half_m}};
      if (std::ranges::any_of(ends, [&](Vec3 end) { return ball_at(end, radius_m) == shapes.end(); }))
        continue;
      shapes[i].shape.shape = robot::Shape::capsule;
      for (const Vec3 end : ends) ball_at(end, radius_m)->shape.size_m.x = 0.0;
    }
    std::erase_if(shapes, [](const Placed& each) {
      return each.shape.size_m.x == 0.0 && each.shape.shape == robot::Shape::sphere;
    });
  }

  Solid solid_of(int b, bool colliding) const {
    std::vector<Placed> shapes;
    for (int g = model_.body_geomadr[b], end = g + model_.body_geomnum[b]; g < end; ++g) {
      if (collides(model_, g) != colliding || is_placeholder(g)) continue;
      if (const auto shape = shape_of(model_, g, colliding))
        shapes.push_back({*shape, robot::Pose{vec3(model_.geom_pos + 3 * g), quat(model_.geom_quat + 4 * g)} *
                                      robot::Pose{shape->position_m, shape->rotation}});
    }
    join_capsules(shapes);
    Solid solid;
    for (const Placed& placed : shapes) add(solid, placed.shape, placed.pose);
    return solid;
  }

  /// The mass is right, but a placeholder's moments are nearly 0.
  void mend_lost(int b) {
    const double mass_kg = model_.body_mass[b];
    lost_.push_back(name_of(b));
    Solid solid = solid_of(b, true);
    if (!(solid.volume_m3 > 0.0)) solid = solid_of(b, false);
    if (!(solid.volume_m3 > 0.0)) {
      set_ball(b, mass_kg);
      return;
    }
    set_centre(b, solid.centre_m());
    set(b, mass_kg, solid.inertia_kg_m2(mass_kg));
  }

  void mend(int b, const std::string& name, double mass_kg) {
    Solid solid = solid_of(b, true);
    if (!(solid.volume_m3 > 0.0)) solid = solid_of(b, false);
    const bool shaped = solid.volume_m3 > 0.0, weighs = mass_kg > 0.0;
    if (!shaped && !weighs) {
      set(b, 0.0, {});
      return;
    }
    (!shaped ? balls_ : weighs ? by_shapes_ : filled_).push_back(name);
    if (!weighs) {
      mass_kg = water_kg_m3 * solid.volume_m3;
      set_centre(b, solid.centre_m());
    }
    if (shaped)
      set(b, mass_kg, solid.inertia_kg_m2(mass_kg));
    else
      set_ball(b, mass_kg);
  }

  void set_centre(int b, Vec3 centre) {
    for (const auto& [at, value] : {std::pair{0, centre.x}, {1, centre.y}, {2, centre.z}})
      model_.body_ipos[3 * b + at] = value;
  }

  void set_ball(int b, double mass_kg) {
    const double radius_m = std::cbrt(mass_kg / (4.0 / 3.0 * std::numbers::pi * water_kg_m3));
    const double moment = 0.4 * mass_kg * radius_m * radius_m;
    set(b, mass_kg, {moment, 0, 0, 0, moment, 0, 0, 0, moment});
  }

  void set(int b, double mass_kg, const std::array<mjtNum, 9>& tensor) {
    std::array<mjtNum, 9> axes{};
    mended_.insert(b);
    model_.body_mass[b] = mass_kg;
    mju_eig3(model_.body_inertia + 3 * b, axes.data(), model_.body_iquat + 4 * b, tensor.data());
  }

  mjModel_& model_;
  const std::map<std::string, std::string>& missing_meshes_;
  std::set<int> weighing_;  ///< groups of which a part has a mass in the file
  std::vector<std::string> weightless_, links_of_water_, by_shapes_, filled_, balls_, lost_, templates_;
  std::set<int> mended_;
};

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

void set_mass(const mjModel_& model, const std::vector<int>& members,
              std::span<const robot::Pose> pose_in_group, robot::Body& body) {
  if (members.size() > 1) {
    combine_masses(model, members, pose_in_group, body);
    return;
  }
  const int m = members.front();
  const robot::Pose inertia =
      pose_in_group[to_index(m)] * robot::Pose{vec3(model.body_ipos + 3 * m), quat(model.body_iquat + 4 * m)};
  body.mass_kg = model.body_mass[m];
  body.com_m = inertia.position_m;
  body.inertia_rotation = inertia.rotation;
  body.inertia_kg_m2 = vec3(model.body_inertia + 3 * m);
}

std::set<int> mend_masses(mjModel_& model, const ModelText& text, ReadingNotes& notes) {
  return MassMender(model, text.missing_meshes).mend(text, notes);
}

}  // namespace amble::morphology
