#include "amble/damage/stages.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <set>
#include <string>

#include "amble/core/check.hpp"
#include "amble/core/index.hpp"
#include "amble/damage/payload.hpp"

namespace amble::damage {
namespace {

using robot::RobotSpec;

template <typename Item>
std::size_t index_of(const std::vector<Item>& items, const std::string& name) {
  const auto found = std::ranges::find(items, name, &Item::name);
  AMBLE_CHECK(found != items.end(), "damage names what the robot has");
  return to_index(found - items.begin());
}

/// How far the stops of a locked joint are moved apart, so that it is never at one: there ODE's motors push
/// with all their torque.
constexpr double lock_margin_rad = 0.2;

/// Applies a part to a stage whose legs are all there yet.
void apply(const Part& part, const RobotSpec& intact, Stage& stage) {
  RobotSpec& robot = stage.robot;
  if (part.kind == Kind::payload) {
    const std::size_t body = part.body.empty() ? 0 : index_of(robot.bodies, part.body);
    add_point_mass(robot.bodies[body], part.mass_kg, {part.x_m, part.y_m, part.z_m});
    return;
  }
  if (part.kind == Kind::missing || part.kind == Kind::numb) return;
  const std::size_t joint = index_of(robot.joints, part.joint);
  robot::Joint& its = robot.joints[joint];
  const auto earlier = std::ranges::find(stage.locks, joint, &Lock::joint);
  if (earlier != stage.locks.end()) {
    its = intact.joints[joint];
    stage.locks.erase(earlier);
  }
  switch (part.kind) {
    case Kind::locked:
      its.servo = {
          .mode = robot::ServoMode::velocity, .gain_per_s = lock_gain_per_s, .max_torque_nm = lock_torque_nm};
      its.stiffness_nm_per_rad = its.rest_rad = 0.0;  // of a joint without a motor
      its.lower_rad -= lock_margin_rad;
      its.upper_rad += lock_margin_rad;
      stage.locks.push_back({joint, part.angle_rad});
      break;
    case Kind::slack:
      its.servo.max_torque_nm = 0.0;
      break;
    case Kind::weak:
      its.servo.max_torque_nm *= part.share;
      break;
    case Kind::missing:
    case Kind::numb:
    case Kind::payload:
      break;
  }
}

/// Keeps the items whose new index is not −1, in order.
template <typename Item>
std::vector<int> keep(std::vector<Item>& items, const std::vector<bool>& kept) {
  std::vector<int> new_index(items.size(), -1);
  std::vector<Item> remaining;
  for (std::size_t i = 0; i < items.size(); ++i) {
    if (!kept[i]) continue;
    new_index[i] = static_cast<int>(remaining.size());
    remaining.push_back(std::move(items[i]));
  }
  items = std::move(remaining);
  return new_index;
}

/// Old indices of those that were kept.
std::vector<int> inverse(const std::vector<int>& new_index) {
  std::vector<int> old;
  for (std::size_t i = 0; i < new_index.size(); ++i)
    if (new_index[i] >= 0) old.push_back(static_cast<int>(i));
  return old;
}

void renumber(int& index, const std::vector<int>& new_index) {
  if (index >= 0) index = new_index[to_index(index)];
}

void remove_legs(Stage& stage, const std::set<int>& missing) {
  RobotSpec& robot = stage.robot;
  std::vector<bool> bodies, joints, geoms, legs;
  for (int b = 0; b < static_cast<int>(robot.bodies.size()); ++b)
    bodies.push_back(!missing.contains(robot.leg_of_body(b)));
  for (const robot::Joint& joint : robot.joints) joints.push_back(bodies[to_index(joint.body)]);
  for (const robot::Geom& geom : robot.geoms) geoms.push_back(bodies[to_index(geom.body)]);
  for (int l = 0; l < static_cast<int>(robot.legs.size()); ++l) legs.push_back(!missing.contains(l));

  const std::vector<int> new_body = keep(robot.bodies, bodies), new_joint = keep(robot.joints, joints),
                         new_geom = keep(robot.geoms, geoms), new_leg = keep(robot.legs, legs);
  for (robot::Body& body : robot.bodies) renumber(body.parent, new_body);
  for (robot::Joint& joint : robot.joints) renumber(joint.body, new_body);
  for (robot::Geom& geom : robot.geoms) renumber(geom.body, new_body);
  for (robot::Leg& leg : robot.legs) {
    for (int& geom : leg.foot_geoms) renumber(geom, new_geom);
    for (int& joint : leg.joints) renumber(joint, new_joint);
  }
  stage.joint_of = inverse(new_joint);
  stage.leg_of = inverse(new_leg);
  std::erase_if(stage.locks, [&](const Lock& lock) { return new_joint[lock.joint] < 0; });
}

/// The robot with all damages that have begun by `from_s`.
Stage stage_from(const RobotSpec& robot, const std::vector<Part>& by_time, double from_s) {
  Stage stage{.from_s = from_s, .robot = robot, .joint_of = {}, .leg_of = {}, .locks = {}};
  std::set<int> missing;
  for (const Part& part : by_time) {
    if (part.from_s > from_s) continue;
    apply(part, robot, stage);
    if (part.kind == Kind::missing) missing.insert(static_cast<int>(index_of(robot.legs, part.leg)));
  }
  remove_legs(stage, missing);
  return stage;
}

}  // namespace

std::vector<Stage> stages_of(const RobotSpec& robot, const Settings& settings) {
  std::vector<Part> by_time = settings.parts;
  std::ranges::stable_sort(by_time, {}, &Part::from_s);
  std::set<double> moments{0.0};
  for (const Part& part : by_time)
    if (part.kind != Kind::numb) moments.insert(part.from_s);
  std::vector<Stage> stages;
  stages.reserve(moments.size());
  for (const double from_s : moments) stages.push_back(stage_from(robot, by_time, from_s));
  return stages;
}

RobotSpec robot_at_start(const RobotSpec& robot, const Settings& settings) {
  return stages_of(robot, settings).front().robot;
}

RobotSpec as_drawn(const RobotSpec& robot, const Settings& settings) {
  constexpr std::array pale{0.9f, 0.9f, 0.9f, 0.25f};
  RobotSpec drawn = robot;
  for (const Part& part : settings.parts) {
    if (part.kind != Kind::missing || part.from_s > 0.0) continue;
    const auto leg = static_cast<int>(index_of(robot.legs, part.leg));
    for (robot::Geom& geom : drawn.geoms)
      if (robot.leg_of_body(geom.body) == leg) geom.rgba = pale;
  }
  return drawn;
}

std::vector<NumbFoot> numb_feet(const RobotSpec& robot, const Settings& settings) {
  std::vector<NumbFoot> feet;
  for (const Part& part : settings.parts)
    if (part.kind == Kind::numb)
      feet.push_back({static_cast<int>(index_of(robot.legs, part.leg)), part.from_s});
  return feet;
}

int first_step(double from_s, double timestep_s) {
  constexpr double rounding = 1e-6;  // in steps
  const double steps_before = std::ceil(from_s / timestep_s - rounding);
  constexpr double most = std::numeric_limits<int>::max() - 1;
  return 1 + static_cast<int>(std::clamp(steps_before, 0.0, most));
}

}  // namespace amble::damage
