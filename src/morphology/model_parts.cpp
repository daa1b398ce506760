#include "amble/morphology/model_parts.hpp"

#include <mujoco/mujoco.h>

#include <array>
#include <cmath>
#include <map>
#include <string_view>

#include "amble/core/error.hpp"
#include "amble/core/index.hpp"
#include "amble/robot/pose.hpp"

namespace amble::morphology {
namespace {

Vec3 vec3(const mjtNum* numbers) {
  return {numbers[0], numbers[1], numbers[2]};
}
Quat quat(const mjtNum* numbers) {
  return {numbers[0], numbers[1], numbers[2], numbers[3]};
}

/// Extracts the parts of one compiled model, step by step.
class PartsExtractor {
 public:
  explicit PartsExtractor(const ModelFile& file) : file_(file), model_(*file.model) {}

  ModelParts extract() {
    refuse_loops();
    refuse_obstacles();
    check_root();
    group_bodies();
    for (int b = 1; b < model_.nbody; ++b) {
      if (starts_group(b)) add_body(b);
    }
    for (int j = 0; j < model_.njnt; ++j) {
      if (model_.jnt_bodyid[j] != 1) add_joint(j);
    }
    for (int g = 0; g < model_.ngeom; ++g) {
      if (model_.geom_bodyid[g] != 0) add_geom(g);
    }
    parts_.gravity_m_s2 = vec3(model_.opt.gravity);
    return std::move(parts_);
  }

 private:
  template <typename... Args>
  [[noreturn]] void refuse(fmt::format_string<Args...> text, Args&&... args) const {
    throw UserError(file_.path.string() + ": " + fmt::format(text, std::forward<Args>(args)...));
  }

  std::string_view body_name(int b) const { return model_.names + model_.name_bodyadr[b]; }
  std::string_view joint_name(int j) const { return model_.names + model_.name_jntadr[j]; }
  std::string_view geom_name(int g) const { return model_.names + model_.name_geomadr[g]; }
  bool collides(int g) const { return model_.geom_contype[g] != 0 || model_.geom_conaffinity[g] != 0; }

  void refuse_loops() const {
    if (model_.neq > 0) {
      refuse("equality constraint '{}': robots with closed loops are not supported",
             model_.names + model_.name_eqadr[0]);
    }
    if (model_.ntendon > 0)
      refuse("tendon '{}': tendons are not supported", model_.names + model_.name_tendonadr[0]);
  }

  void refuse_obstacles() const {
    for (int g = 0; g < model_.ngeom; ++g) {
      if (model_.geom_bodyid[g] != 0 || !collides(g)) continue;
      const Vec3 normal = rotate(quat(model_.geom_quat + 4 * g), {0.0, 0.0, 1.0});
      const bool ground =
          model_.geom_type[g] == mjGEOM_PLANE && model_.geom_pos[3 * g + 2] == 0.0 && normal.z == 1.0;
      if (!ground)
        refuse("geom '{}' of the world: the only ground is the plane z = 0, without obstacles", geom_name(g));
    }
  }

  void check_root() const {
    int roots = 0;
    for (int b = 1; b < model_.nbody; ++b) roots += model_.body_parentid[b] == 0 ? 1 : 0;
    if (roots != 1) refuse("expected one body in the world, the robot's root, but found {}", roots);
    const int joints = model_.body_jntnum[1];
    if (file_.root_is_welded && joints == 0) return;
    const bool free = joints == 1 && model_.jnt_type[model_.body_jntadr[1]] == mjJNT_FREE;
    if (!free)
      refuse("the root body '{}' must be free to move: give it a <freejoint/> and no other joint",
             body_name(1));
  }

  bool starts_group(int b) const { return b == 1 || model_.body_jntnum[b] > 0; }

  /// Assigns each body of the model to a rigid body of the robot, with its pose in that body's frame.
  void group_bodies() {
    group_.assign(to_index(model_.nbody), -1);
    pose_in_group_.resize(to_index(model_.nbody));
    int groups = 0;
    for (int b = 1; b < model_.nbody; ++b) {
      group_[to_index(b)] = starts_group(b) ? groups++ : group_[to_index(model_.body_parentid[b])];
      if (!starts_group(b)) pose_in_group_[to_index(b)] = pose_in_parent_group(b);
    }
  }

  robot::Pose pose_in_parent_group(int b) const {
    const robot::Pose own{vec3(model_.body_pos + 3 * b), quat(model_.body_quat + 4 * b)};
    return b == 1 ? own : pose_in_group_[to_index(model_.body_parentid[b])] * own;
  }

  void add_body(int b) {
    const robot::Pose pose = pose_in_parent_group(b);
    robot::Body body;
    body.name = body_name(b);
    body.parent = b == 1 ? -1 : group_[to_index(model_.body_parentid[b])];
    body.position_m = pose.position_m;
    body.rotation = pose.rotation;

    std::vector<int> members;
    for (int m = b; m < model_.nbody; ++m) {
      if (group_[to_index(m)] == group_[to_index(b)] && model_.body_mass[m] > 0.0) members.push_back(m);
    }
    if (members.empty()) refuse("body '{}' has no mass", body.name);
    if (members.size() == 1) {
      const int m = members[0];
      const robot::Pose inertia = pose_in_group_[to_index(m)] * robot::Pose{vec3(model_.body_ipos + 3 * m),
                                                                            quat(model_.body_iquat + 4 * m)};
      body.mass_kg = model_.body_mass[m];
      body.com_m = inertia.position_m;
      body.inertia_rotation = inertia.rotation;
      body.inertia_kg_m2 = vec3(model_.body_inertia + 3 * m);
    } else {
      combine_masses(members, body);
    }
    parts_.bodies.push_back(std::move(body));
  }

  /// Mass, centre and principal moments of several bodies that are fixed to each other (parallel axis
  /// theorem).
  void combine_masses(const std::vector<int>& members, robot::Body& body) const {
    Vec3 weighted;
    for (const int m : members) {
      body.mass_kg += model_.body_mass[m];
      weighted =
          weighted + model_.body_mass[m] * (pose_in_group_[to_index(m)] * vec3(model_.body_ipos + 3 * m));
    }
    body.com_m = (1.0 / body.mass_kg) * weighted;

    std::array<mjtNum, 9> tensor{};
    for (const int m : members) {
      const robot::Pose own = pose_in_group_[to_index(m)] *
                              robot::Pose{vec3(model_.body_ipos + 3 * m), quat(model_.body_iquat + 4 * m)};
      const Vec3 lever = own.position_m - body.com_m;
      const std::array<Vec3, 3> axes{rotate(own.rotation, {1, 0, 0}), rotate(own.rotation, {0, 1, 0}),
                                     rotate(own.rotation, {0, 0, 1})};
      const std::array<double, 3> d{lever.x, lever.y, lever.z};
      for (std::size_t r = 0; r < 3; ++r) {
        for (std::size_t c = 0; c < 3; ++c) {
          double moment = model_.body_mass[m] * ((r == c ? dot(lever, lever) : 0.0) - d[r] * d[c]);
          for (std::size_t k = 0; k < 3; ++k) {
            const std::array<double, 3> axis{axes[k].x, axes[k].y, axes[k].z};
            moment += model_.body_inertia[3 * to_index(m) + k] * axis[r] * axis[c];
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

  void add_joint(int j) {
    const int b = model_.jnt_bodyid[j];
    const std::string_view name = joint_name(j);
    if (name.empty()) refuse("body '{}' has a joint without a name", body_name(b));
    if (model_.jnt_type[j] != mjJNT_HINGE)
      refuse("joint '{}': only hinges are supported, no ball, slide or free joints", name);
    if (model_.jnt_limited[j] == 0) {
      refuse(
          "joint '{}' has no limits: give it a range (MJCF: limited=\"true\" range=\"…\"; URDF: "
          "type=\"revolute\")",
          name);
    }
    // MuJoCo counts angles from the joint's reference, amble from the start pose.
    const double start = model_.qpos0[model_.jnt_qposadr[j]];
    robot::Joint joint;
    joint.name = name;
    joint.body = group_[to_index(b)];
    joint.chain_index = j - model_.body_jntadr[b];
    joint.anchor_m = vec3(model_.jnt_pos + 3 * j);
    joint.axis = vec3(model_.jnt_axis + 3 * j);
    joint.lower_rad = model_.jnt_range[2 * j] - start;
    joint.upper_rad = model_.jnt_range[2 * j + 1] - start;
    parts_.joints.push_back(std::move(joint));
  }

  void add_geom(int g) {
    static const std::map<int, robot::Shape> shapes{{mjGEOM_SPHERE, robot::Shape::sphere},
                                                    {mjGEOM_CAPSULE, robot::Shape::capsule},
                                                    {mjGEOM_CYLINDER, robot::Shape::cylinder},
                                                    {mjGEOM_BOX, robot::Shape::box}};
    const auto shape = shapes.find(model_.geom_type[g]);
    if (shape == shapes.end()) {
      if (!collides(g)) return;
      refuse(
          "geom '{}': only spheres, capsules, cylinders and boxes can collide; a mesh must be decoration "
          "(contype=\"0\" conaffinity=\"0\")",
          name_or_place(g));
    }
    const int b = model_.geom_bodyid[g];
    const robot::Pose pose = pose_in_group_[to_index(b)] *
                             robot::Pose{vec3(model_.geom_pos + 3 * g), quat(model_.geom_quat + 4 * g)};
    const float* colour =
        model_.geom_matid[g] < 0 ? model_.geom_rgba + 4 * g : model_.mat_rgba + 4 * model_.geom_matid[g];
    robot::Geom geom;
    geom.name = name_or_place(g);
    geom.body = group_[to_index(b)];
    geom.collides = collides(g);
    geom.shape = shape->second;
    geom.size_m = vec3(model_.geom_size + 3 * g);
    geom.position_m = pose.position_m;
    geom.rotation = pose.rotation;
    geom.rgba = {colour[0], colour[1], colour[2], colour[3]};
    parts_.geoms.push_back(std::move(geom));
  }

  std::string name_or_place(int g) const {
    if (!geom_name(g).empty()) return std::string(geom_name(g));
    const int b = model_.geom_bodyid[g];
    if (model_.body_geomnum[b] == 1) return std::string(body_name(b));
    return fmt::format("{}.{}", body_name(b), g - model_.body_geomadr[b]);
  }

  const ModelFile& file_;
  const mjModel& model_;
  std::vector<int> group_;
  std::vector<robot::Pose> pose_in_group_;
  ModelParts parts_;
};

}  // namespace

ModelParts extract_parts(const ModelFile& file) {
  return PartsExtractor(file).extract();
}

}  // namespace amble::morphology
