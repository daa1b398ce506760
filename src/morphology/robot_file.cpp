#include "amble/morphology/robot_file.hpp"

#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "amble/core/error.hpp"
#include "amble/core/index.hpp"
#include "amble/morphology/model_file.hpp"
#include "amble/morphology/model_parts.hpp"
#include "amble/morphology/side_file.hpp"
#include "amble/robot/check.hpp"
#include "amble/robot/pose.hpp"

namespace amble::morphology {
namespace {

/// A foot this deep in the ground at the start is a mistake in the model, not softness.
constexpr double deepest_foot_m = 0.01;

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
      robot::Joint& joint = add_joint(j, side_.held_servos[h]);
      joint.command = robot::AngleRange{0.0, 0.0};
    }
    refuse_unnamed();
    refuse_endless();
  }

 private:
  robot::Joint& add_joint(int j, const robot::Servo& servo) {
    const robot::Joint& joint = parts_.joints[to_index(j)];
    if (named_[to_index(j)]) fail(ExitCode::bad_input, "{}: joint '{}' is named twice", what_, joint.name);
    named_[to_index(j)] = true;
    robot_.joints.push_back(joint);
    robot_.joints.back().servo = servo;
    return robot_.joints.back();
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
    leg.foot_geom = index_of(parts_.geoms, side_.names[l].foot);
    if (leg.foot_geom < 0) {
      fail(ExitCode::bad_input, "{}: leg '{}' needs a foot geom '{}', but {} has: {}", what_, leg.name,
           side_.names[l].foot, side_.model.string(), list_of_names(parts_.geoms));
    }
    robot_.legs.push_back(std::move(leg));
  }

  void check_command(const robot::Joint& joint, double start) const {
    constexpr double rounding_rad = 1e-9;
    if (joint.command->lower_rad >= joint.lower_rad - rounding_rad &&
        joint.command->upper_rad <= joint.upper_rad + rounding_rad) {
      robot::Joint& own = robot_.joints.back();
      own.command->lower_rad = std::max(own.command->lower_rad, own.lower_rad);
      own.command->upper_rad = std::min(own.command->upper_rad, own.upper_rad);
      return;
    }
    fail(ExitCode::bad_input,
         "{}: joint '{}': its range of command {:.6g} … {:.6g} rad goes beyond its stops {:.6g} … {:.6g} rad",
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
           "(its servo holds it) or fixed = [...] (welded)",
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
};

void check_feet(const std::string& what, const robot::RobotSpec& robot) {
  for (const robot::Leg& leg : robot.legs) {
    const double clearance_m = robot::start_clearance_m(robot, leg.foot_geom);
    if (clearance_m < -deepest_foot_m) {
      fail(ExitCode::bad_input,
           "{}: foot '{}' starts {:.3f} m below the ground: raise the root, or set start_height_m", what,
           robot.geoms[to_index(leg.foot_geom)].name, -clearance_m);
    }
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
}

}  // namespace

robot::RobotSpec load_robot(const std::filesystem::path& path, ReadingNotes* notes) {
  const SideFile side = read_side_file(path);
  ModelParts parts = extract_parts(compile_model(side.model), {side.start, side.start_rad, side.fixed});
  const std::string what = path.string();

  robot::RobotSpec robot;
  robot.name = side.name;
  robot.joint_types = side.joint_types;
  JointOrder(what, side, parts, robot).add();
  robot.bodies = std::move(parts.bodies);
  robot.geoms = std::move(parts.geoms);
  if (side.root_height_m > 0.0) robot.bodies[0].position_m.z = side.root_height_m;
  robot.contact = side.contact;
  robot.gravity_m_s2 = parts.gravity_m_s2;
  robot.fall_height_m = side.fall_height_m;
  robot.self_collision = side.self_collision;

  robot::check_robot(robot,
                     [&](const std::string& problem) { fail(ExitCode::bad_input, "{}: {}", what, problem); });
  check_feet(what, robot);
  check_height(what, robot);
  if (notes != nullptr) notes->add(parts.notes);
  return robot;
}

}  // namespace amble::morphology
