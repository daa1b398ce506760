#include "amble/experiment/start_look.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <set>

#include "amble/core/index.hpp"
#include "amble/experiment/plan/config.hpp"
#include "amble/io/text.hpp"
#include "amble/physics/engine.hpp"
#include "amble/robot/check.hpp"
#include "amble/robot/doubts.hpp"
#include "amble/robot/legs.hpp"
#include "amble/robot/pose.hpp"

namespace amble::experiment {
namespace {

using robot::RobotSpec;

/// For this long the start pose is held, s.
constexpr double hold_s = 1.0;
/// A trunk that is lower than this share of the legs' length is hardly carried by them.
constexpr double crouching_share = 0.15;
/// Shapes that collide are at least so dense: the paper's quadruped has 22 kg/m3.
constexpr double least_kg_per_m3 = 10.0, usual_kg_per_m3 = 1000.0;
/// The density of a cube as wide as the robot; iron has less.
constexpr double most_kg_per_m3 = 8000.0;
constexpr double largest_m = 15.0;

double volume_m3(const robot::Geom& geom) {
  const Vec3 size = geom.size_m;
  const double disc_m2 = std::numbers::pi * size.x * size.x;
  switch (geom.shape) {
    case robot::Shape::sphere:
      return 4.0 / 3.0 * disc_m2 * size.x;
    case robot::Shape::capsule:
      return 4.0 / 3.0 * disc_m2 * size.x + 2.0 * disc_m2 * size.y;
    case robot::Shape::cylinder:
      return 2.0 * disc_m2 * size.y;
    case robot::Shape::box:
      return 8.0 * size.x * size.y * size.z;
    case robot::Shape::mesh:
      break;
  }
  double tetrahedra_m3 = 0.0;
  for (const auto& corners : geom.triangles)
    tetrahedra_m3 +=
        dot(geom.vertices_m[to_index(corners[0])],
            cross(geom.vertices_m[to_index(corners[1])], geom.vertices_m[to_index(corners[2])])) /
        6.0;
  return std::abs(tetrahedra_m3);
}

/// The unit of lengths that are too large by a factor of about 10, 100 or 1000.
std::string unit_of(double kg_per_m3) {
  constexpr std::array units{"decimetres", "centimetres", "millimetres"};
  const double tens = std::log10(usual_kg_per_m3 / kg_per_m3) / 3.0;
  return units[to_index(std::clamp<int>(static_cast<int>(std::lround(tens)), 1, 3) - 1)];
}

/// The widest side of the box about all bodies' frames and shapes.
double width_m(const RobotSpec& robot) {
  const auto poses = robot::start_poses(robot);
  constexpr double none = std::numeric_limits<double>::infinity();
  Vec3 least{none, none, none}, most{-none, -none, -none};
  const auto include = [&](Vec3 centre, double radius_m) {
    least = {std::min(least.x, centre.x - radius_m), std::min(least.y, centre.y - radius_m),
             std::min(least.z, centre.z - radius_m)};
    most = {std::max(most.x, centre.x + radius_m), std::max(most.y, centre.y + radius_m),
            std::max(most.z, centre.z + radius_m)};
  };
  for (const robot::Pose& pose : poses) include(pose.position_m, 0.0);
  for (const robot::Geom& geom : robot.geoms) include(robot::centre_m(geom, poses), geom.size_m.x);
  const Vec3 sides = most - least;
  return std::max({sides.x, sides.y, sides.z});
}

/// Whatever it weighs, no robot that walks is so large: of shapes without a mass that are filled with a usual
/// density the mass tells nothing.
void look_at_size(double wide_m, std::vector<std::string>& odd) {
  constexpr double usual_m = 0.5;
  if (wide_m > largest_m)
    odd.push_back(
        fmt::format("size: {:.3g} m is more than any robot that walks: are its lengths in {}? amble takes "
                    "metres and kilograms",
                    wide_m, unit_of(usual_kg_per_m3 * std::pow(usual_m / wide_m, 3))));
}

void look_at_mass(const RobotSpec& robot, std::vector<std::string>& odd) {
  double all_m3 = 0.0;
  for (const robot::Geom& geom : robot.geoms)
    if (geom.collides) all_m3 += volume_m3(geom);
  const double mass_kg = robot.total_mass_kg(), wide_m = width_m(robot);
  if (const double kg_per_m3 = mass_kg / all_m3; !(all_m3 > 0.0) || kg_per_m3 >= least_kg_per_m3)
    look_at_size(wide_m, odd);
  else
    odd.push_back(fmt::format(
        "mass: {:.3g} kg on {:.3g} m, {:.2g} kg/m3, is less than foam: are its lengths in {}, or masses "
        "missing? amble takes metres and kilograms",
        mass_kg, wide_m, kg_per_m3, unit_of(kg_per_m3)));
  if (mass_kg > most_kg_per_m3 * wide_m * wide_m * wide_m)
    odd.push_back(fmt::format(
        "mass: {:.3g} kg on {:.3g} m is more than a cube of iron: are its masses in grams? amble takes "
        "metres and kilograms",
        mass_kg, wide_m));
}

/// From a body's centre of mass to the nearest ball around one of its shapes, or to its frame if it has none.
double far_from_shapes_m(const RobotSpec& robot, int body) {
  const robot::Body& own = robot.bodies[to_index(body)];
  double far_m = std::numeric_limits<double>::infinity();
  for (const robot::Geom& geom : robot.geoms) {
    if (geom.body != body) continue;
    double radius_m = norm(geom.size_m);
    for (const Vec3 corner : geom.vertices_m) radius_m = std::max(radius_m, norm(corner));
    far_m = std::min(far_m, std::max(0.0, norm(own.com_m - geom.position_m) - radius_m));
  }
  return std::isfinite(far_m) ? far_m : norm(own.com_m);
}

/// Centres of mass in another unit than lengths: no link's is farther from it than its robot is long.
void look_at_centres_of_mass(const RobotSpec& robot, std::vector<std::string>& odd) {
  const double wide_m = width_m(robot);
  std::vector<std::string> names;
  for (int b = 0; b < static_cast<int>(robot.bodies.size()); ++b)
    if (const double far_m = far_from_shapes_m(robot, b); far_m > wide_m)
      names.push_back(fmt::format("{} ({:.3g} m)", robot.bodies[to_index(b)].name, far_m));
  if (!names.empty())
    odd.push_back(fmt::format(
        "mass: centres of mass that are farther from their link than the robot is long, {:.3g} m: "
        "{}: are they in millimetres? amble takes metres (URDF: <origin> of <inertial>)",
        wide_m, io::first_few(names)));
}

std::string axis_of(Vec3 v) {
  const std::array sizes{std::abs(v.x), std::abs(v.y), std::abs(v.z)};
  const auto largest = std::ranges::max_element(sizes) - sizes.begin();
  const double value = largest == 0 ? v.x : largest == 1 ? v.y : v.z;
  return fmt::format("{}{}", value < 0.0 ? '-' : '+', "xyz"[largest]);
}

/// Gravity that is a little off is allowed, and a slope without end.
void look_at_gravity(const RobotSpec& robot, std::vector<std::string>& odd) {
  const Vec3 gravity = robot.gravity_m_s2;
  const double aside = std::hypot(gravity.x, gravity.y);
  const double tilt_deg = std::atan2(aside, -gravity.z) * 180.0 / std::numbers::pi;
  constexpr double least_deg = 0.5;
  if (tilt_deg > least_deg)
    odd.push_back(
        fmt::format("gravity: ({:.4g}, {:.4g}, {:.4g}) m/s2 is tilted by {:.2g} degrees: it pulls along {}, "
                    "as on a slope; "
                    "a config has slopes (ground.slope_x, slope_y)",
                    gravity.x, gravity.y, gravity.z, tilt_deg, axis_of({gravity.x, gravity.y, 0.0})));
}

/// The line of a robot file with which what points along `down` at the start points down.
std::string upright_line(const RobotSpec& robot, Vec3 down) {
  const Vec3 from = (1.0 / norm(down)) * down, axis = cross(from, {0.0, 0.0, -1.0});
  const double sine = norm(axis);
  const Quat turn = sine > 1e-9 ? axis_angle((1.0 / sine) * axis, std::atan2(sine, -from.z))
                                : axis_angle({1.0, 0.0, 0.0}, std::numbers::pi);
  const RollPitchYaw rpy = roll_pitch_yaw(turn * robot.bodies[0].rotation);
  const auto degrees = [](double rad) { return std::round(rad * 180.0 / std::numbers::pi) + 0.0; };
  return fmt::format("start_rpy_deg = [{}, {}, {}]", degrees(rpy.roll_rad), degrees(rpy.pitch_rad),
                     degrees(rpy.yaw_rad));
}

/// From the hip of each leg to its foot, all together: legs that spread to all sides point down.
void look_at_legs(const RobotSpec& robot, std::vector<std::string>& odd) {
  const auto poses = robot::start_poses(robot);
  Vec3 sum{};
  double lengths_m = 0.0;
  for (const robot::Leg& leg : robot.legs) {
    const int hip = robot::hip_joint(robot, leg);
    if (hip < 0) continue;
    const robot::Joint& joint = robot.joints[to_index(hip)];
    const Vec3 along = robot::foot_m(robot, leg, poses) - poses[to_index(joint.body)] * joint.anchor_m;
    sum = sum + along;
    lengths_m += norm(along);
  }
  constexpr double together = 0.3, steepness = 0.5;
  if (norm(sum) > together * lengths_m && sum.z > -steepness * norm(sum))
    odd.push_back(fmt::format(
        "legs: they point along {}, not down: if the model has another axis up than z, turn its root, in the "
        "robot file by {}",
        axis_of(sum), upright_line(robot, sum)));
}

/// What a held robot has done so far.
class Hold {
 public:
  Hold(const RobotSpec& robot, const std::string& engine, double timestep_s)
      : robot_(robot),
        timestep_s_(timestep_s),
        engine_(physics::make_engine(engine, robot, {.timestep_s = timestep_s})),
        targets_rad_(static_cast<int>(robot.joints.size()), engine_->lanes()) {
    engine_->place(0);
    start_ = engine_->root_pose(0);
    start_com_m_ = engine_->com_m(0).z;
    highest_com_m_ = start_com_m_;
  }

  void look(std::vector<std::string>& odd) {
    const auto steps = static_cast<int>(std::lround(hold_s / timestep_s_));
    if (fallen())
      odd.push_back(
          fmt::format("start: it has fallen before its first step: its root's centre of mass is at {:.3g} m, "
                      "fall_height_m is {:.3g}",
                      engine_->root_com_m(0).z, robot_.fall_height_m));
    else
      for (int step = 1; step <= steps && odd_.empty(); ++step) advance(step);
    if (odd_.empty() && !fallen()) at_end();
    odd.insert(odd.end(), odd_.begin(), odd_.end());
  }

 private:
  bool fallen() const {
    return robot_.fall_rule().met(engine_->root_com_m(0).z, robot_.upright(engine_->root_pose(0).rotation));
  }

  void advance(int step) {
    engine_->step(targets_rad_);
    const double at_s = step * timestep_s_;
    if (!engine_->healthy(0)) {
      odd_.push_back(
          fmt::format("held in its start pose it diverges after {:.2f} s: look for links that are far "
                      "lighter than their motors are strong, or a start in the ground",
                      at_s));
      return;
    }
    highest_com_m_ = std::max(highest_com_m_, engine_->com_m(0).z);
    if (fallen()) odd_.push_back(fmt::format("held in its start pose it falls within {:.2f} s", at_s));
  }

  std::vector<robot::Pose> poses() const {
    const auto root = engine_->root_pose(0);
    std::vector<double> angles_rad;
    angles_rad.reserve(to_index(targets_rad_.rows()));
    for (int j = 0; j < targets_rad_.rows(); ++j)
      angles_rad.push_back(double{engine_->sensors().joint_angle_rad.at(j, 0)});
    return robot::poses_at(robot_, {root.position_m, root.rotation}, angles_rad);
  }

  void at_end() {
    constexpr double tipped_cosine = 0.7, thrown_share = 0.5, sunk_share = 0.25;
    const Vec3 up_now = rotate(engine_->root_pose(0).rotation, Vec3{0.0, 0.0, 1.0}),
               up_then = rotate(start_.rotation, Vec3{0.0, 0.0, 1.0});
    if (dot(up_now, up_then) < tipped_cosine) odd_.push_back("held in its start pose it tips over");
    // Shares of a height below the ground say nothing.
    const bool above_ground = start_com_m_ > 0.0;
    if (above_ground && highest_com_m_ > (1.0 + thrown_share) * start_com_m_)
      odd_.push_back(
          fmt::format("held in its start pose it is thrown up by {:.3g} m: it starts in the ground, or in "
                      "itself",
                      highest_com_m_ - start_com_m_));
    if (const double sunk_m = start_com_m_ - engine_->com_m(0).z;
        above_ground && sunk_m > sunk_share * start_com_m_)
      odd_.push_back(
          fmt::format("held in its start pose it sinks by {:.3g} m of {:.3g}: its servos are weak for its "
                      "weight, or its start is in the air",
                      sunk_m, start_com_m_));
    what_carries(poses());
  }

  void what_carries(const std::vector<robot::Pose>& poses) {
    if (robot_.legs.empty()) return;
    double legs_m = 0.0;
    for (const robot::Leg& leg : robot_.legs)
      legs_m = std::max(legs_m, robot::leg_length_m(robot_, leg, poses));
    // On more than four legs, which spread to all sides, a low trunk is no fall.
    const double crouching_m = robot_.legs.size() > 4 ? 0.0 : crouching_share * legs_m;
    double lowest_m = std::max(crouching_m, 0.01 * legs_m);
    std::string lowest;
    std::set<int> feet;
    for (const robot::Leg& leg : robot_.legs) feet.insert(leg.foot_geoms.begin(), leg.foot_geoms.end());
    for (int g = 0; g < static_cast<int>(robot_.geoms.size()); ++g) {
      const robot::Geom& geom = robot_.geoms[to_index(g)];
      if (!geom.collides || feet.contains(g) || robot_.leg_of_body(geom.body) >= 0) continue;
      const double bottom_m = robot::bottom_m(geom, poses);
      if (bottom_m >= lowest_m) continue;
      lowest_m = bottom_m;
      lowest = robot_.bodies[to_index(geom.body)].name;
    }
    if (!lowest.empty())
      odd_.push_back(fmt::format(
          "held in its start pose it {}: '{}' is {:.2g} m over the ground, its legs are {:.2g} m long. Give "
          "it a start in "
          "which it stands (start, start_height_m and [start_angle] in the robot file)",
          lowest_m < 0.01 * legs_m ? "lies" : "crouches", lowest, std::max(lowest_m, 0.0), legs_m));
    const auto& touch = engine_->sensors().touch;
    bool touches = false;
    for (int leg = 0; leg < touch.rows(); ++leg) touches = touches || touch.at(leg, 0) != 0.0f;
    if (!touches) odd_.push_back("held in its start pose it touches the ground with no foot");
  }

  const RobotSpec& robot_;
  const double timestep_s_;
  std::unique_ptr<physics::Engine> engine_;
  LaneArray targets_rad_;
  physics::RootPose start_;
  double start_com_m_ = 0.0, highest_com_m_ = 0.0;
  std::vector<std::string> odd_;
};

}  // namespace

std::vector<std::string> odd_at_start(const RobotSpec& robot, const std::string& engine, double timestep_s) {
  std::vector<std::string> odd;
  if (const auto fault = robot::gravity_fault(robot.gravity_m_s2); !fault.empty())
    odd.push_back(fault);
  else
    look_at_gravity(robot, odd);
  look_at_mass(robot, odd);
  look_at_centres_of_mass(robot, odd);
  const std::vector<std::string> pose = odd_pose(robot, engine, timestep_s);
  odd.insert(odd.end(), pose.begin(), pose.end());
  return odd;
}

std::vector<std::string> odd_for_run(const RobotSpec& robot, const Config& config) {
  auto odd = odd_at_start(robot, config.engine, config.trial.timestep_s);
  if (config.ground.slope_x != 0.0 || config.ground.slope_y != 0.0)
    std::erase_if(odd, [](const std::string& line) { return line.starts_with("gravity:"); });
  if (const auto weak = robot::weak_joints(robot); !weak.empty())
    odd.push_back(
        fmt::format("motors too weak to hold the weight on half of the legs: {}; `amble robot` says more",
                    fmt::join(weak, ", ")));
  return odd;
}

std::vector<std::string> odd_pose(const RobotSpec& robot, const std::string& engine, double timestep_s) {
  std::vector<std::string> odd;
  look_at_legs(robot, odd);
  if (!robot.legs.empty()) Hold(robot, engine, timestep_s).look(odd);
  return odd;
}

}  // namespace amble::experiment
