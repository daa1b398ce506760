#include "amble/morphology/robot_file.hpp"

#include <fmt/ranges.h>
#include <mujoco/mujoco.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "amble/core/error.hpp"
#include "amble/core/index.hpp"
#include "amble/morphology/model_file.hpp"
#include "amble/morphology/model_parts.hpp"
#include "amble/morphology/model_shapes.hpp"
#include "amble/morphology/original_model.hpp"
#include "amble/morphology/servo_guess.hpp"
#include "amble/morphology/side_file.hpp"
#include "amble/robot/check.hpp"
#include "amble/robot/pose.hpp"

namespace amble::morphology {
namespace {

/// A foot this deep in the ground at the start is a mistake in the model, not softness.
constexpr double deepest_foot_m = 0.01;
/// Armature of a joint that repeats another, as a share of its body's inertia.
constexpr double repeated_share = 1e-3;

template <typename T>
std::string list_of_names(const std::vector<T>& items) {
  std::string names;
  for (const T& item : items) names += (names.empty() ? "" : ", ") + item.name;
  return names.empty() ? "none" : names;
}

template <typename T>
int index_of(const std::vector<T>& items, const std::string& name) {
  const auto found =
      std::find_if(items.begin(), items.end(), [&](const T& item) { return item.name == name; });
  return found == items.end() ? -1 : static_cast<int>(found - items.begin());
}

/// Puts the model's joints into control order, leg by leg and type by type, then those that are held, and
/// gives them their servos and ranges of command.
class JointOrder {
 public:
  JointOrder(const std::string& what, const SideFile& side, const ModelParts& parts, robot::RobotSpec& robot)
      : what_(what), side_(side), parts_(parts), robot_(robot), named_(parts.joints.size()) {}

  void add() {
    for (std::size_t l = 0; l < side_.legs.size(); ++l) add_leg(l);
    for (std::size_t h = 0; h < side_.held.size(); ++h) {
      const int j = index_of(parts_.joints, side_.held[h]);
      if (j < 0)
        fail(ExitCode::bad_input, "{}: 'held' names a joint '{}', but {} has: {}", what_, side_.held[h],
             side_.model.string(), list_of_names(parts_.joints));
      robot::Joint& joint = add_joint(j, side_.held_servos[h], true);
      joint.command = robot::AngleRange{0.0, 0.0};
    }
    add_passive();
    refuse_unnamed();
    refuse_endless();
  }

  /// What was decided about motors and springs.
  void add_notes(ReadingNotes& notes) const {
    const auto note = [&](Reading reading, std::string_view text, const std::vector<std::string>& joints) {
      if (!joints.empty()) notes.add(reading, fmt::format("{}: {}", text, fmt::join(joints, ", ")));
    };
    note(Reading::kept, "joints without a motor, which move freely", passive_);
    note(Reading::kept, "the springs of joints", springs_);
    note(Reading::left_out, "the springs of joints with a motor", lost_springs_);
    note(Reading::replaced, "joints without an actuator, which get a motor", given_motors_);
    note(Reading::replaced, "joints without an actuator of their own, which a servo holds", held_);
    note(Reading::replaced,
         "no armature of joints about the axis of another of their body: a thousandth of the body's inertia",
         repeated_);
  }

 private:
  void add_passive() {
    for (const std::string& name : side_.passive) {
      const int j = index_of(parts_.joints, name);
      if (j < 0)
        fail(ExitCode::bad_input, "{}: 'passive' names a joint '{}', but {} has: {}", what_, name,
             side_.model.string(), list_of_names(parts_.joints));
      robot::Joint& joint =
          add_joint(j, {.mode = robot::ServoMode::none, .gain_per_s = 0.0, .max_torque_nm = 0.0});
      joint.command = robot::AngleRange{0.0, 0.0};
      if (joint.armature_kg_m2 == 0.0 && repeats_another(joint)) {
        joint.armature_kg_m2 = repeated_share * inertia_about(joint);
        repeated_.push_back(fmt::format("'{}'", name));
      }
    }
  }

  /// Whether its body turns about the same axis by another joint, as with play in a gear: without an inertia
  /// of its own nothing says which of both moves.
  bool repeats_another(const robot::Joint& joint) const {
    constexpr double same = 1e-6;
    return std::ranges::any_of(parts_.joints, [&](const robot::Joint& other) {
      return other.body == joint.body && other.chain_index != joint.chain_index &&
             norm(cross(other.axis, joint.axis)) < same &&
             norm(cross(other.anchor_m - joint.anchor_m, joint.axis)) < same;
    });
  }

  /// The inertia of a joint's body about its axis, kg m².
  double inertia_about(const robot::Joint& joint) const {
    const robot::Body& body = parts_.bodies[to_index(joint.body)];
    const Vec3 along = rotate(conjugate(body.inertia_rotation), joint.axis), moments = body.inertia_kg_m2;
    const Vec3 arm = cross(body.com_m - joint.anchor_m, joint.axis);
    return moments.x * along.x * along.x + moments.y * along.y * along.y + moments.z * along.z * along.z +
           body.mass_kg * dot(arm, arm);
  }

  robot::Joint& add_joint(int j, const robot::Servo& servo, bool holds = false) {
    const robot::Joint& joint = parts_.joints[to_index(j)];
    if (named_[to_index(j)]) fail(ExitCode::bad_input, "{}: joint '{}' is named twice", what_, joint.name);
    named_[to_index(j)] = true;
    robot_.joints.push_back(joint);
    robot::Joint& added = robot_.joints.back();
    added.servo = servo;
    const std::string quoted = fmt::format("'{}'", joint.name);
    if (joint.stiffness_nm_per_rad != 0.0) (added.has_motor() ? lost_springs_ : springs_).push_back(quoted);
    if (!added.has_motor()) {
      passive_.push_back(quoted);
      return added;
    }
    const Drive drive = parts_.drives[to_index(j)];
    if (drive != Drive::motor) (drive == Drive::held && holds ? held_ : given_motors_).push_back(quoted);
    added.stiffness_nm_per_rad = added.rest_rad = 0.0;
    return added;
  }

  void add_leg(std::size_t l) {
    robot::Leg leg;
    leg.name = side_.legs[l];
    for (std::size_t t = 0; t < side_.joint_types.size(); ++t) {
      const std::string& name = side_.names[l].joints[t];
      if (name.empty()) {
        leg.joints.push_back(-1);
        continue;
      }
      const int j = index_of(parts_.joints, name);
      if (j < 0)
        fail(ExitCode::bad_input, "{}: leg '{}' needs a joint '{}' ({}), but {} has: {}", what_, leg.name,
             name, side_.joint_types[t], side_.model.string(), list_of_names(parts_.joints));
      leg.joints.push_back(static_cast<int>(robot_.joints.size()));
      const std::size_t place = l * side_.joint_types.size() + t;
      robot::Joint& joint = add_joint(j, side_.servos[place]);
      if (const auto& range = side_.commands[place]) {
        const double start = parts_.start_rad[to_index(j)];
        joint.command = robot::AngleRange{range->lower_rad - start, range->upper_rad - start};
        check_command(joint, start);
      } else if (!std::isfinite(joint.lower_rad) || !std::isfinite(joint.upper_rad)) {
        endless_.push_back(fmt::format("command.{}.{} ({})", leg.name, side_.joint_types[t], name));
      }
    }
    for (const std::string& name : side_.names[l].foot) {
      const int geom = index_of(parts_.geoms, name);
      if (geom < 0)
        fail(ExitCode::bad_input, "{}: leg '{}' needs a foot geom '{}', but {} has: {}", what_, leg.name,
             name, side_.model.string(), list_of_names(parts_.geoms));
      leg.foot_geoms.push_back(geom);
    }
    robot_.legs.push_back(std::move(leg));
  }

  void check_command(const robot::Joint& joint, double start) const {
    constexpr double rounding_rad = 1e-9;
    if (joint.servo.hold_torque) return;
    if (joint.command->lower_rad >= joint.lower_rad - rounding_rad &&
        joint.command->upper_rad <= joint.upper_rad + rounding_rad) {
      robot::Joint& own = robot_.joints.back();
      own.command->lower_rad = std::max(own.command->lower_rad, own.lower_rad);
      own.command->upper_rad = std::min(own.command->upper_rad, own.upper_rad);
      return;
    }
    fail(
        ExitCode::bad_input,
        "{}: joint '{}': its range of command {:.6g} … {:.6g} rad goes beyond its stops {:.6g} … {:.6g} rad: "
        "correct it under [command], or make the file anew with `amble robot --init`",
        what_, joint.name, joint.command->lower_rad + start, joint.command->upper_rad + start,
        joint.lower_rad + start, joint.upper_rad + start);
  }

  void refuse_unnamed() const {
    std::vector<std::string> unnamed;
    for (std::size_t j = 0; j < named_.size(); ++j)
      if (!named_[j]) unnamed.push_back(fmt::format("'{}'", parts_.joints[j].name));
    if (!unnamed.empty())
      fail(ExitCode::bad_input,
           "{}: {} {} of {} belong{} to no leg: name every joint by legs and joint_types, or in held = [...] "
           "(its servo holds it), passive = [...] (it has no motor) or fixed = [...] (welded)",
           what_, unnamed.size() == 1 ? "joint" : "joints", fmt::join(unnamed, ", "), side_.model.string(),
           unnamed.size() == 1 ? "s" : "");
  }

  void refuse_endless() const {
    if (!endless_.empty())
      fail(ExitCode::bad_input,
           "{}: joints without limits in {} need a range of command, [lower, upper] in rad: {}", what_,
           side_.model.string(), fmt::join(endless_, ", "));
  }

  const std::string& what_;
  const SideFile& side_;
  const ModelParts& parts_;
  robot::RobotSpec& robot_;
  std::vector<bool> named_;
  std::vector<std::string> endless_;
  std::vector<std::string> passive_, springs_, lost_springs_, given_motors_, held_,
      repeated_;  ///< quoted names, for the notes
};

void check_feet(const std::string& what, const robot::RobotSpec& robot) {
  for (const robot::Leg& leg : robot.legs) {
    for (const int geom : leg.foot_geoms)
      if (const double clearance_m = robot::start_clearance_m(robot, geom); clearance_m < -deepest_foot_m)
        fail(ExitCode::bad_input,
             "{}: foot '{}' starts {:.3f} m below the ground: raise the root, or set start_height_m", what,
             robot.geoms[to_index(geom)].name, -clearance_m);
  }
}

void check_height(const std::string& what, const robot::RobotSpec& robot) {
  const robot::Body& root = robot.bodies[0];
  const double start_m = (root.position_m + rotate(root.rotation, root.com_m)).z;
  if (start_m <= robot.fall_height_m)
    fail(ExitCode::bad_input,
         "{}: 'fall_height_m' = {}: expected less than {:.3f} m, where the root's centre of mass starts, or "
         "every trial would end at once",
         what, robot.fall_height_m, start_m);
  if (start_m >= robot.fall_above_m)
    fail(ExitCode::bad_input,
         "{}: 'fall_above_m' = {}: expected more than {:.3f} m, where the root's centre of mass starts, or "
         "every trial would end at once",
         what, robot.fall_above_m, start_m);
}

/// Whether shapes that collide stand about a model's robot, besides the ground.
bool has_obstacles(const mjModel_& model) {
  for (int g = 0; g < model.ngeom; ++g)
    if (model.body_weldid[model.geom_bodyid[g]] == 0 && collides(model, g) && !is_ground(model, g))
      return true;
  return false;
}

}  // namespace

robot::RobotSpec load_robot(const std::filesystem::path& path, ReadingNotes* notes) {
  const SideFile side = read_side_file(path);
  return make_robot(side, compile_model(side.model), path.string(), notes);
}

robot::RobotSpec make_robot(const SideFile& side, const ModelFile& model, const std::string& what,
                            ReadingNotes* notes, const ModelParts* before) {
  const ReadingOptions options{side.start, side.start_rad, side.fixed, side.start_rotation};
  ModelParts parts = extract_parts(model, options, before);
  robot::RobotSpec robot;
  robot.name = side.name;
  robot.joint_types = side.joint_types;
  JointOrder order(what, side, parts, robot);
  order.add();
  if (side.keep_model) robot.original = keep_model(model, options, parts, robot, parts.notes);
  robot.bodies = std::move(parts.bodies);
  robot.geoms = std::move(parts.geoms);
  // Robots start above the origin (docs/CONVENTIONS.md), unless they keep what stands about them in the
  // model.
  if (parts.root_is_free && !(robot.original && has_obstacles(*model.model)))
    robot.bodies[0].position_m.x = robot.bodies[0].position_m.y = 0.0;
  if (side.root_height_m != 0.0) robot.bodies[0].position_m.z = side.root_height_m;
  robot.contact = side.contact;
  robot.gravity_m_s2 = parts.gravity_m_s2;
  robot.fall_height_m = side.fall_height_m;
  robot.fall_above_m = side.fall_above_m;
  robot.fall_tilt_rad = side.fall_tilt_rad;
  robot.self_collision = side.self_collision;

  robot::check_robot(robot,
                     [&](const std::string& problem) { fail(ExitCode::bad_input, "{}: {}", what, problem); });
  check_feet(what, robot);
  check_height(what, robot);
  if (notes != nullptr) {
    notes->add(parts.notes);
    order.add_notes(*notes);
    note_other_limits(model, robot, *notes);
  }
  return robot;
}

}  // namespace amble::morphology
