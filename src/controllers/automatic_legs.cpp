#include "amble/controllers/automatic_legs.hpp"

#include <algorithm>
#include <cmath>

#include "amble/core/index.hpp"

namespace amble::controllers {
namespace {

/// To four decimals, without −0.
double rounded(double value) {
  return std::round(value * 1e4) / 1e4 + 0.0;
}

}  // namespace

double evenly_spread(int index, int count) {
  return count < 2 ? 0.0 : rounded(2.0 * index / (count - 1.0) - 1.0);
}

AutomaticLegs::AutomaticLegs(const robot::RobotSpec& robot) : robot_(robot) {
  for (std::size_t type = 0; type < robot.joint_types.size(); ++type) {
    const auto drives = [&](const robot::Leg& leg) {
      return leg.joints[type] >= 0 && robot.joints[to_index(leg.joints[type])].driven();
    };
    if (std::ranges::any_of(robot.legs, drives)) types_.push_back(static_cast<int>(type));
  }
  place_pairs(robot::hips_m(robot, robot::start_poses(robot)));
}

void AutomaticLegs::place_pairs(const std::vector<Vec3>& hips_m) {
  pairs_ = robot::leg_pairs(hips_m);
  if (pairs_.empty()) return;
  const auto x_m = [&](const robot::LegPair& pair) {
    return 0.5 * (hips_m[to_index(pair.left)].x + hips_m[to_index(pair.right)].x);
  };
  const double front_m = x_m(pairs_.front()), hind_m = x_m(pairs_.back());
  for (const robot::LegPair& pair : pairs_)
    pair_y_.push_back(pairs_.size() == 1 ? 0.0
                                         : rounded(2.0 * (x_m(pair) - hind_m) / (front_m - hind_m) - 1.0));
  // Pairs so close that four decimals do not tell them apart are spread evenly with the others.
  if (std::ranges::adjacent_find(pair_y_) == pair_y_.end()) return;
  for (std::size_t pair = 0; pair < pairs_.size(); ++pair)
    pair_y_[pair] =
        evenly_spread(static_cast<int>(pairs_.size() - 1 - pair), static_cast<int>(pairs_.size()));
}

const std::string& AutomaticLegs::name(int leg) const {
  return robot_.legs[to_index(leg)].name;
}

std::vector<LegMotor> AutomaticLegs::motors(int leg) const {
  std::vector<LegMotor> found;
  for (int type = 0; type < types(); ++type) {
    const int index = types_[to_index(type)], joint = robot_.legs[to_index(leg)].joints[to_index(index)];
    if (joint >= 0 && robot_.joints[to_index(joint)].driven())
      found.push_back(
          {type, name(leg) + "." + robot_.joint_types[to_index(index)], robot_.joints[to_index(joint)].name});
  }
  return found;
}

int AutomaticLegs::place_across(int type, bool right) const {
  const int place = type % 2 == 0 ? type / 2 : types() - 1 - type / 2;
  return right ? types() - 1 - place : place;
}

std::vector<LegMotor> AutomaticLegs::motors_across(int leg) const {
  std::vector<LegMotor> found = motors(leg);
  std::ranges::sort(found, {},
                    [&](const LegMotor& motor) { return place_across(motor.type, is_right(leg)); });
  return found;
}

bool AutomaticLegs::is_right(int leg) const {
  return std::ranges::find(pairs_, leg, &robot::LegPair::right) != pairs_.end();
}

}  // namespace amble::controllers
