#include "amble/robot/spec.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "amble/core/index.hpp"

namespace amble::robot {

Servo Joint::acting_servo() const {
  if (has_motor()) return servo;
  return {.mode = ServoMode::torque,
          .gain_per_s = 0.0,
          .max_torque_nm = std::numeric_limits<double>::infinity(),
          .kp_nm_per_rad = stiffness_nm_per_rad,
          .kd_nm_s_per_rad = 0.0};
}

bool FallRule::met(double height_m, double up) const {
  return height_m < below_m || height_m > above_m || (std::isfinite(tilt_rad) && up < std::cos(tilt_rad));
}

double RobotSpec::upright(const Quat& root_rotation) const {
  return rotate(turned(root_rotation), {0.0, 0.0, 1.0}).z;
}

bool Leg::has_foot_geom(int geom) const {
  return std::ranges::find(foot_geoms, geom) != foot_geoms.end();
}

int RobotSpec::foot_body(const Leg& leg) const {
  return geoms[to_index(leg.foot_geoms.front())].body;
}

double RobotSpec::total_mass_kg() const {
  double mass = 0.0;
  for (const Body& body : bodies) mass += body.mass_kg;
  return mass;
}

std::size_t RobotSpec::leg_joint_count() const {
  std::size_t count = 0;
  for (const Leg& leg : legs)
    count += to_index(std::ranges::count_if(leg.joints, [](int joint) { return joint >= 0; }));
  return count;
}

std::vector<int> RobotSpec::joints_of_body(int body) const {
  std::vector<int> found;
  for (int j = 0; j < static_cast<int>(joints.size()); ++j) {
    if (joints[to_index(j)].body == body) found.push_back(j);
  }
  const auto place = [this](int j) { return joints[to_index(j)].chain_index; };
  std::stable_sort(found.begin(), found.end(), [&](int a, int b) { return place(a) < place(b); });
  return found;
}

int RobotSpec::leg_of_body(int body) const {
  // The legs whose feet it carries.
  int carried = -1;
  for (std::size_t leg = 0; leg < legs.size(); ++leg) {
    int b = foot_body(legs[leg]);
    while (b > body) b = bodies[to_index(b)].parent;
    if (b != body) continue;
    if (carried >= 0) return -1;
    carried = static_cast<int>(leg);
  }
  for (int b = body; b >= 0; b = bodies[to_index(b)].parent)
    for (std::size_t leg = 0; leg < legs.size(); ++leg)
      for (const int joint : legs[leg].joints)
        if (joint >= 0 && joints[to_index(joint)].body == b) return static_cast<int>(leg);
  return -1;
}

}  // namespace amble::robot
