#include "amble/morphology/robot_file.hpp"

#include <algorithm>
#include <string>
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

/// Puts the model's joints into control order, leg by leg and type by type, and gives them their servos.
void add_legs(const std::string& what, const SideFile& side, const ModelParts& parts,
              robot::RobotSpec& robot) {
  std::vector<bool> named(parts.joints.size());
  for (std::size_t l = 0; l < side.legs.size(); ++l) {
    robot::Leg leg;
    leg.name = side.legs[l];
    for (std::size_t t = 0; t < side.joint_types.size(); ++t) {
      const std::string& name = side.names[l].joints[t];
      const int j = index_of(parts.joints, name);
      if (j < 0) {
        fail(ExitCode::bad_input, "{}: leg '{}' needs a joint '{}' ({}), but {} has: {}", what, leg.name,
             name, side.joint_types[t], side.model.string(), list_of_names(parts.joints));
      }
      if (named[to_index(j)]) fail(ExitCode::bad_input, "{}: joint '{}' is named twice", what, name);
      named[to_index(j)] = true;
      leg.joints.push_back(static_cast<int>(robot.joints.size()));
      robot.joints.push_back(parts.joints[to_index(j)]);
      robot.joints.back().servo = side.servos[l * side.joint_types.size() + t];
    }
    leg.foot_geom = index_of(parts.geoms, side.names[l].foot);
    if (leg.foot_geom < 0) {
      fail(ExitCode::bad_input, "{}: leg '{}' needs a foot geom '{}', but {} has: {}", what, leg.name,
           side.names[l].foot, side.model.string(), list_of_names(parts.geoms));
    }
    robot.legs.push_back(std::move(leg));
  }
  for (std::size_t j = 0; j < named.size(); ++j) {
    if (!named[j]) {
      fail(ExitCode::bad_input,
           "{}: joint '{}' of {} belongs to no leg: every joint must be named by legs and joint_types", what,
           parts.joints[j].name, side.model.string());
    }
  }
}

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

robot::RobotSpec load_robot(const std::filesystem::path& path) {
  const SideFile side = read_side_file(path);
  ModelParts parts = extract_parts(compile_model(side.model));
  const std::string what = path.string();

  robot::RobotSpec robot;
  robot.name = side.name;
  robot.joint_types = side.joint_types;
  add_legs(what, side, parts, robot);
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
  return robot;
}

}  // namespace amble::morphology
