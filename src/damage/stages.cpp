#include "amble/damage/stages.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <set>
#include <string>

#include "amble/core/check.hpp"
#include "amble/core/index.hpp"

namespace amble::damage {
namespace {

using Matrix = std::array<std::array<double, 3>, 3>;

/// Columns: the images of the axes.
Matrix matrix_of(Quat q) {
  const Vec3 x = rotate(q, {1, 0, 0}), y = rotate(q, {0, 1, 0}), z = rotate(q, {0, 0, 1});
  return {{{x.x, y.x, z.x}, {x.y, y.y, z.y}, {x.z, y.z, z.z}}};
}

/// I = R diag(moments) Rᵀ.
Matrix inertia_of(const robot::Body& body) {
  const Matrix axes = matrix_of(body.inertia_rotation);
  const std::array<double, 3> moments{body.inertia_kg_m2.x, body.inertia_kg_m2.y, body.inertia_kg_m2.z};
  Matrix inertia{};
  for (std::size_t r = 0; r < 3; ++r)
    for (std::size_t c = 0; c < 3; ++c)
      for (std::size_t k = 0; k < 3; ++k) inertia[r][c] += moments[k] * axes[r][k] * axes[c][k];
  return inertia;
}

/// The inertia of a point mass at `arm_m`, m (|r|² 1 − r rᵀ): the parallel axis theorem.
void add_parallel_axis(Matrix& inertia, double mass_kg, Vec3 arm_m) {
  const std::array<double, 3> arm{arm_m.x, arm_m.y, arm_m.z};
  for (std::size_t r = 0; r < 3; ++r)
    for (std::size_t c = 0; c < 3; ++c)
      inertia[r][c] += mass_kg * ((r == c ? dot(arm_m, arm_m) : 0.0) - arm[r] * arm[c]);
}

/// One Jacobi rotation in the plane of the axes p and q, after which a[p][q] = 0 (Golub & Van Loan 2013, sec.
/// 8.5); returns it as a quaternion. Without sines, whose last bits differ between CPUs.
Quat rotate_away(Matrix& a, std::size_t p, std::size_t q) {
  const double ratio = (a[q][q] - a[p][p]) / (2.0 * a[p][q]);
  const double t = (ratio >= 0.0 ? 1.0 : -1.0) / (std::abs(ratio) + std::sqrt(1.0 + ratio * ratio));
  const double c = 1.0 / std::sqrt(1.0 + t * t), s = t * c;
  for (std::size_t k = 0; k < 3; ++k) {
    const double kp = a[k][p], kq = a[k][q];
    a[k][p] = c * kp - s * kq;
    a[k][q] = s * kp + c * kq;
  }
  for (std::size_t k = 0; k < 3; ++k) {
    const double pk = a[p][k], qk = a[q][k];
    a[p][k] = c * pk - s * qk;
    a[q][k] = s * pk + c * qk;
  }
  // The new axis p is c e_p − s e_q: a turn by −asin(s) about e_p × e_q; half angles from c = 1 − 2
  // sin²(φ/2).
  const double half_cosine = std::sqrt(0.5 * (1.0 + c)), half_sine = -s / (2.0 * half_cosine);
  const double sign = (q == (p + 1) % 3) ? 1.0 : -1.0;
  std::array<double, 3> axis{};
  axis[3 - p - q] = sign * half_sine;
  return {half_cosine, axis[0], axis[1], axis[2]};
}

/// Principal moments and axes of a symmetric matrix.
void set_principal(robot::Body& body, Matrix inertia) {
  constexpr int most_sweeps = 30;
  constexpr double negligible = 1e-17;
  const double size = inertia[0][0] + inertia[1][1] + inertia[2][2];
  Quat axes;
  for (int sweep = 0; sweep < most_sweeps; ++sweep)
    for (std::size_t p = 0; p < 3; ++p)
      for (std::size_t q = p + 1; q < 3; ++q)
        if (std::abs(inertia[p][q]) > negligible * size) axes = axes * rotate_away(inertia, p, q);
  const double length = std::sqrt(axes.w * axes.w + axes.x * axes.x + axes.y * axes.y + axes.z * axes.z);
  body.inertia_kg_m2 = {inertia[0][0], inertia[1][1], inertia[2][2]};
  body.inertia_rotation = {axes.w / length, axes.x / length, axes.y / length, axes.z / length};
}

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

void add_point_mass(robot::Body& body, double mass_kg, Vec3 at_m) {
  const double both_kg = body.mass_kg + mass_kg;
  const Vec3 com_m = (1.0 / both_kg) * (body.mass_kg * body.com_m + mass_kg * at_m);
  Matrix inertia = inertia_of(body);
  add_parallel_axis(inertia, body.mass_kg, body.com_m - com_m);
  add_parallel_axis(inertia, mass_kg, at_m - com_m);
  body.mass_kg = both_kg;
  body.com_m = com_m;
  set_principal(body, inertia);
}

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
  RobotSpec drawn = robot;
  for (const Part& part : settings.parts) {
    if (part.kind != Kind::missing || part.from_s > 0.0) continue;
    const auto leg = static_cast<int>(index_of(robot.legs, part.leg));
    for (robot::Geom& geom : drawn.geoms)
      if (robot.leg_of_body(geom.body) == leg) geom.rgba = robot::gone_rgba;
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
