#include "amble/morphology/model_parts.hpp"

#include <fmt/ranges.h>
#include <mujoco/mujoco.h>

#include <algorithm>
#include <limits>
#include <set>
#include <string_view>
#include <utility>

#include "amble/core/error.hpp"
#include "amble/core/index.hpp"
#include "amble/morphology/massless_links.hpp"
#include "amble/morphology/missing_mass.hpp"
#include "amble/morphology/model_shapes.hpp"
#include "amble/morphology/mujoco_handlers.hpp"
#include "amble/morphology/start_pose.hpp"
#include "amble/robot/pose.hpp"

namespace amble::morphology {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

/// Extracts the parts of one compiled model, step by step.
class PartsExtractor {
 public:
  PartsExtractor(const ModelFile& file, const ReadingOptions& options, const ModelParts* before)
      : file_(file), options_(options), before_(before), model_(*file.model), start_(file, options) {}

  ModelParts extract() {
    parts_.notes = file_.notes;
    find_root();
    note_what_is_left_out();
    find_fixed_joints();
    group_bodies();
    find_drives();
    for (int b = root_; b < model_.nbody; ++b) {
      if (group_[to_index(b)] >= 0 && starts_group(b)) add_body(b);
    }
    for (int j = 0; j < model_.njnt; ++j) {
      if (moves(j)) add_joint(j);
    }
    for (int g = 0; g < model_.ngeom; ++g) {
      if (group_[to_index(model_.geom_bodyid[g])] >= 0) add_geom(g);
    }
    if (const std::string faulty = merge_massless_links(parts_); !faulty.empty())
      refuse("links without mass that move: {}: give them mass and inertia (URDF: <inertial>){}", faulty,
             unread_meshes());
    note_feet_that_only_show();
    finish();
    parts_.gravity_m_s2 = is_disabled(mjDSBL_GRAVITY) ? Vec3{} : vec3(model_.opt.gravity);
    doubt_disabled();
    return std::move(parts_);
  }

 private:
  bool is_disabled(int flag) const { return (model_.opt.disableflags & flag) != 0; }

  /// What the model itself goes without, by <option><flag …="disable"/>.
  void doubt_disabled() {
    std::vector<std::string> disabled;
    for (const auto& [flag, name] : {std::pair(mjDSBL_CONTACT, "contact"), std::pair(mjDSBL_LIMIT, "limit"),
                                     std::pair(mjDSBL_ACTUATION, "actuation")})
      if (is_disabled(flag)) disabled.emplace_back(name);
    if (!disabled.empty())
      parts_.notes.add(
          Reading::replaced,
          fmt::format("<option><flag> disables {} in the model: here the robot has contacts, limits "
                      "and motors",
                      fmt::join(disabled, ", ")),
          true);
  }

  template <typename... Args>
  [[noreturn]] void refuse(fmt::format_string<Args...> text, Args&&... args) const {
    throw UserError(file_.path.string() + ": " + fmt::format(text, std::forward<Args>(args)...));
  }
  template <typename... Args>
  void note(Reading reading, fmt::format_string<Args...> text, Args&&... args) {
    parts_.notes.add(reading, fmt::format(text, std::forward<Args>(args)...));
  }

  std::string_view body_name(int b) const { return model_.names + model_.name_bodyadr[b]; }
  std::string_view joint_name(int j) const { return model_.names + model_.name_jntadr[j]; }
  std::string_view geom_name(int g) const { return model_.names + model_.name_geomadr[g]; }
  bool collides(int g) const { return morphology::collides(model_, g); }

  /// The root is the body of the world with joints behind it; if none has any, the one that moves; if none
  /// does, the only one.
  void find_root() {
    std::vector<int> roots, moving, with_joints;
    for (int b = 1; b < model_.nbody; ++b) {
      if (model_.body_parentid[b] != 0) continue;
      roots.push_back(b);
      if (model_.body_jntnum[b] > 0) moving.push_back(b);
      for (int j = 0; j < model_.njnt; ++j) {
        const int of = model_.jnt_bodyid[j];
        if (of == b || model_.body_rootid[of] != b) continue;
        with_joints.push_back(b);
        break;
      }
    }
    const std::vector<int>& candidates = !with_joints.empty() ? with_joints
                                         : !moving.empty()    ? moving
                                                              : roots;
    if (candidates.size() != 1)
      refuse("expected one body in the world, the robot's root, but found {}{}", candidates.size(),
             candidates.size() < 2 ? ""
                                   : "; if they are limbs of one robot, put <body name=\"root\"><freejoint/> "
                                     "… </body> around them");
    root_ = candidates[0];
    for (const int other : roots)
      if (other != root_) note(Reading::left_out, "body '{}': it stands in the world", body_name(other));
    free_root();
  }

  void free_root() {
    const int joints = model_.body_jntnum[root_], first = model_.body_jntadr[root_];
    parts_.root_is_free = joints == 0 || (joints == 1 && model_.jnt_type[first] == mjJNT_FREE);
    if (joints == 1 && parts_.root_is_free) return;
    if (joints == 0 && file_.root_is_welded) return;
    std::vector<std::string> names;
    for (int j = first; j < first + joints; ++j) {
      const std::string name(joint_name(j));
      const int type = model_.jnt_type[j];
      names.push_back(!name.empty()         ? name
                      : type == mjJNT_SLIDE ? "a slide joint"
                      : type == mjJNT_HINGE ? "a hinge"
                      : type == mjJNT_BALL  ? "a ball joint"
                                            : "a free joint");
    }
    if (joints == 0)
      note(Reading::replaced, "root '{}' was fixed to the world: it is free to move", body_name(root_));
    else
      note(Reading::replaced, "root '{}' moved by {}: it is free to move", body_name(root_),
           fmt::join(names, ", "));
  }

  void note_what_is_left_out() {
    for (int g = 0; g < model_.ngeom; ++g) {
      if (model_.geom_bodyid[g] != 0 || !collides(g)) continue;
      const Vec3 normal = rotate(quat(model_.geom_quat + 4 * g), {0.0, 0.0, 1.0});
      const bool ground =
          model_.geom_type[g] == mjGEOM_PLANE && model_.geom_pos[3 * g + 2] == 0.0 && normal.z == 1.0;
      if (!ground)
        obstacles_.push_back(geom_name(g).empty() ? "one without a name" : fmt::format("'{}'", geom_name(g)));
    }
    if (!obstacles_.empty())
      note(Reading::left_out, "{} geoms of the world: {}: the ground is amble's own, the plane z = 0",
           obstacles_.size(), fmt::join(obstacles_, ", "));
    std::vector<std::string> seen;
    for (const auto& [count, what] :
         {std::pair{model_.ncam, "camera"}, {model_.nlight, "light"}, {model_.nsite, "site"}})
      if (count > 0) seen.push_back(fmt::format("{} {}{}", count, what, count == 1 ? "" : "s"));
    if (!seen.empty()) note(Reading::left_out, "{}", fmt::join(seen, ", "));
    if (model_.nexclude + model_.npair > 0)
      note(Reading::left_out, "pairs of contacts and their exclusion: see self_collision in the robot file");
    if (model_.opt.density != 0.0 || model_.opt.viscosity != 0.0)
      note(Reading::left_out, "density and viscosity of the air");
  }

  void find_fixed_joints() {
    fixed_.assign(to_index(model_.njnt), false);
    for (const std::string& name : options_.fixed_joints) {
      int j = 0;
      while (j < model_.njnt && name != joint_name(j)) ++j;
      if (j == model_.njnt) refuse("no joint '{}', which is named as fixed", name);
      fixed_[to_index(j)] = true;
      note(Reading::replaced, "joint '{}': fixed where it starts", name);
    }
    for (int j = 0; j < model_.njnt; ++j) {
      const int type = model_.jnt_type[j];
      if (moves(j) && type != mjJNT_HINGE)
        refuse("joint '{}': only hinges are supported, no ball, slide or free joints", joint_name(j));
    }
  }

  /// Whether it is a joint of the robot.
  bool moves(int j) const {
    const int b = model_.jnt_bodyid[j];
    return b != root_ && model_.body_rootid[b] == root_ && !fixed_[to_index(j)];
  }

  bool starts_group(int b) const {
    if (b == root_) return true;
    for (int j = model_.body_jntadr[b], end = j + model_.body_jntnum[b]; j < end; ++j)
      if (!fixed_[to_index(j)]) return true;
    return false;
  }

  /// Assigns each body of the model to a rigid body of the robot, with its pose in that body's frame.
  void group_bodies() {
    group_.assign(to_index(model_.nbody), -1);
    pose_in_group_.resize(to_index(model_.nbody));
    int groups = 0;
    for (int b = 1; b < model_.nbody; ++b) {
      if (model_.body_rootid[b] != root_) continue;
      group_[to_index(b)] = starts_group(b) ? groups++ : group_[to_index(model_.body_parentid[b])];
      if (!starts_group(b)) pose_in_group_[to_index(b)] = pose_in_parent_group(b);
    }
  }

  void find_drives() {
    const RobotOfModel robot{[this](int j) { return moves(j); },
                             [this](int b) { return group_[to_index(b)]; }};
    drives_ = drives_of(file_, robot, parts_.notes);
  }

  robot::Pose pose_in_parent_group(int b) const {
    robot::Pose own = start_.pose_in_parent(b);
    if (b == root_ && options_.start_rotation) own.rotation = *options_.start_rotation;
    return b == root_ ? own : pose_in_group_[to_index(model_.body_parentid[b])] * own;
  }

  void add_body(int b) {
    const robot::Pose pose = pose_in_parent_group(b);
    robot::Body body;
    body.name = body_name(b);
    body.parent = b == root_ ? -1 : group_[to_index(model_.body_parentid[b])];
    body.position_m = pose.position_m;
    body.rotation = pose.rotation;

    std::vector<int> members;
    for (int m = b; m < model_.nbody; ++m) {
      if (group_[to_index(m)] == group_[to_index(b)] && model_.body_mass[m] > 0.0) members.push_back(m);
    }
    if (!members.empty()) set_mass(model_, members, pose_in_group_, body);
    parts_.bodies.push_back(std::move(body));
  }

  void add_joint(int j) {
    const int b = model_.jnt_bodyid[j];
    const std::string_view name = joint_name(j);
    if (name.empty()) refuse("body '{}' has a joint without a name", body_name(b));
    // MuJoCo counts angles from the joint's reference, amble from the start pose.
    const double start = start_.angle_rad(j);
    const robot::Pose after = start_.after(j);
    const Vec3 anchor = vec3(model_.jnt_pos + 3 * j), axis = vec3(model_.jnt_axis + 3 * j);
    const bool turned = !(after.rotation == Quat{});
    const int dof = model_.jnt_dofadr[j];
    robot::Joint joint;
    joint.name = name;
    joint.body = group_[to_index(b)];
    for (int k = model_.body_jntadr[b]; k < j; ++k) joint.chain_index += moves(k) ? 1 : 0;
    joint.anchor_m = turned ? rotate(conjugate(after.rotation), anchor - after.position_m) : anchor;
    joint.axis = turned ? rotate(conjugate(after.rotation), axis) : axis;
    const bool limited = model_.jnt_limited[j] != 0;
    joint.lower_rad = limited ? model_.jnt_range[2 * j] - start : -infinity;
    joint.upper_rad = limited ? model_.jnt_range[2 * j + 1] - start : infinity;
    joint.armature_kg_m2 = model_.dof_armature[dof];
    joint.damping_nm_s_per_rad = model_.dof_damping[dof];
    joint.friction_loss_nm = model_.dof_frictionloss[dof];
    joint.stiffness_nm_per_rad = model_.jnt_stiffness[j];
    if (joint.stiffness_nm_per_rad != 0.0) joint.rest_rad = model_.qpos_spring[model_.jnt_qposadr[j]] - start;
    parts_.joints.push_back(std::move(joint));
    parts_.start_rad.push_back(start);
    parts_.model_joints.push_back(j);
    parts_.drives.push_back(drives_[to_index(j)]);
  }

  /// Why a mass may be missing.
  std::string unread_meshes() const {
    std::vector<std::string> files;
    for (const auto& [name, file] : file_.missing_meshes) files.push_back(file);
    return files.empty() ? ""
                         : fmt::format(", or the meshes that cannot be read: {}", fmt::join(files, ", "));
  }

  /// Links that a leg may stand on, and that nothing touches.
  void note_feet_that_only_show() {
    std::vector<std::string> names;
    for (int b = root_ + 1; b < model_.nbody; ++b) {
      const int first = model_.body_geomadr[b], count = model_.body_geomnum[b];
      bool shows = false, touches = false;
      for (int g = first; g < first + count; ++g) (collides(g) ? touches : shows) = true;
      if (model_.body_rootid[b] == root_ && shows && !touches && ends_a_leg(model_, root_, b))
        names.push_back(fmt::format("'{}'", body_name(b)));
    }
    if (!names.empty())
      note(Reading::left_out,
           "contacts of links at the end of a limb, which have shapes to look at and none that collides: {}",
           fmt::join(names, ", "));
  }

  void add_geom(int g) {
    const int type = model_.geom_type[g];
    const std::string mesh =
        type == mjGEOM_MESH ? model_.names + model_.name_meshadr[model_.geom_dataid[g]] : "";
    const auto missing = file_.missing_meshes.find(mesh);
    if (missing != file_.missing_meshes.end() && type == mjGEOM_MESH) {
      const std::string what = fmt::format("{} of '{}'", missing->second, body_name(model_.geom_bodyid[g]));
      if (collides(g) && is_of_a_foot(model_, root_, g, file_.missing_meshes))
        lost_.insert(missing->second);
      else
        (collides(g) ? unread_ : unseen_).push_back(what);
      return;
    }
    std::optional<robot::Geom> shape = shape_before(g);
    if (!shape) shape = shape_of(model_, g, collides(g));
    if (!shape) {
      if (collides(g) && (type != mjGEOM_MESH || is_of_a_foot(model_, root_, g, file_.missing_meshes)))
        refuse("geom '{}': planes, height fields and flat meshes cannot collide", name_or_place(g));
      note(Reading::left_out, "geom '{}': a flat mesh or another shape that cannot be shown",
           name_or_place(g));
      return;
    }
    if (type == mjGEOM_ELLIPSOID)
      ++ellipsoids_;
    else if (type == mjGEOM_MESH && shape->shape == robot::Shape::cylinder)
      ++cylinders_;
    else if (shape->shape == robot::Shape::mesh)
      ++(collides(g) ? hulls_ : shown_hulls_);
    const int b = model_.geom_bodyid[g];
    robot::Pose pose = pose_in_group_[to_index(b)] *
                       robot::Pose{vec3(model_.geom_pos + 3 * g), quat(model_.geom_quat + 4 * g)};
    if (type == mjGEOM_MESH && shape->shape == robot::Shape::cylinder)
      pose = pose * robot::Pose{shape->position_m, shape->rotation};
    const float* colour =
        model_.geom_matid[g] < 0 ? model_.geom_rgba + 4 * g : model_.mat_rgba + 4 * model_.geom_matid[g];
    robot::Geom& geom = *shape;
    geom.name = name_or_place(g);
    geom.body = group_[to_index(b)];
    geom.collides = collides(g);
    geom.position_m = pose.position_m;
    geom.rotation = pose.rotation;
    geom.rgba = {colour[0], colour[1], colour[2], colour[3]};
    parts_.geoms.push_back(std::move(geom));
    parts_.model_geoms.push_back(g);
    parts_.welded_links.push_back(starts_group(b) ? -1 : b);
  }

  /// The hull that was made of a mesh before.
  std::optional<robot::Geom> shape_before(int g) const {
    if (before_ == nullptr || model_.geom_type[g] != mjGEOM_MESH) return std::nullopt;
    const auto found = std::ranges::find(before_->model_geoms, g);
    if (found == before_->model_geoms.end()) return std::nullopt;
    const robot::Geom& geom =
        before_->geoms[to_index(static_cast<int>(found - before_->model_geoms.begin()))];
    if (geom.shape != robot::Shape::mesh) return std::nullopt;
    return geom;
  }

  void finish() {
    if (!lost_.empty())
      throw UserError(fmt::format("{}: collision meshes of feet that cannot be read: {}; they are looked for "
                                  "beside the model, in the folders above it, and in meshes/",
                                  file_.path.string(), fmt::join(lost_, ", ")),
                      ExitCode::io);
    const auto counted = [](std::size_t count, std::string_view one, std::string_view many) {
      return fmt::format("{} {}", count, count == 1 ? one : many);
    };
    note(Reading::kept, "{}, {}, {}, {}", counted(parts_.bodies.size(), "body", "bodies"),
         counted(parts_.joints.size(), "joint", "joints"),
         counted(parts_.geoms.size() - to_index(hulls_ + shown_hulls_ + ellipsoids_ + cylinders_), "geom",
                 "geoms"),
         counted(to_index(model_.nkey), "keyframe", "keyframes"));
    if (!unread_.empty())
      note(Reading::left_out, "collision shapes whose mesh cannot be read: {}", fmt::join(unread_, ", "));
    if (!unseen_.empty())
      note(Reading::left_out, "what is only to look at and whose mesh cannot be read: {}",
           fmt::join(unseen_, ", "));
    if (hulls_ > 0)
      note(Reading::replaced, "{} meshes that collide: the convex hull of each, with at most {} corners",
           hulls_, most_collision_vertices);
    if (cylinders_ > 0)
      note(Reading::replaced, "{} meshes that collide and are round about an axis: a cylinder each",
           cylinders_);
    if (shown_hulls_ > 0)
      note(Reading::replaced, "{} meshes to look at: the convex hull of each, with at most {} corners",
           shown_hulls_, most_decoration_vertices);
    if (ellipsoids_ > 0)
      note(Reading::replaced, "{} ellipsoids: convex hulls of {} points", ellipsoids_,
           most_collision_vertices);
  }

  std::string name_or_place(int g) const {
    if (!geom_name(g).empty()) return std::string(geom_name(g));
    const int b = model_.geom_bodyid[g], first = model_.body_geomadr[b];
    // Visual geoms of a URDF's link are numbered separately.
    const bool apart = file_.root_is_welded;
    int before = 0, count = 0;
    for (int other = first; other < first + model_.body_geomnum[b]; ++other) {
      if (apart && collides(other) != collides(g)) continue;
      ++count;
      if (other < g) ++before;
    }
    const std::string name = std::string(body_name(b)) + (apart && !collides(g) ? ".visual" : "");
    return count == 1 ? name : fmt::format("{}.{}", name, before);
  }

  const ModelFile& file_;
  const ReadingOptions& options_;
  const ModelParts* before_;
  const mjModel& model_;
  StartPose start_;
  int root_ = 1;
  std::vector<bool> fixed_;
  std::vector<int> group_;
  std::vector<robot::Pose> pose_in_group_;
  int hulls_ = 0, shown_hulls_ = 0, ellipsoids_ = 0, cylinders_ = 0;
  std::set<std::string> lost_;
  std::vector<std::string> obstacles_, unread_, unseen_;
  std::vector<Drive> drives_;
  ModelParts parts_;
};

}  // namespace

ModelParts extract_parts(const ModelFile& file, const ReadingOptions& options, const ModelParts* before) {
  return PartsExtractor(file, options, before).extract();
}

}  // namespace amble::morphology
