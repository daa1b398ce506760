#include "amble/analysis/robot_model.hpp"

#include <algorithm>
#include <array>
#include <string_view>

#include "amble/io/json_file.hpp"

namespace amble::analysis {
namespace {

using io::JsonView;

Vec3 read_vector(const JsonView& json) {
  if (json.size() != 3) json.bad("a list of 3 numbers");
  return {json.at(std::size_t{0}).finite_number(), json.at(1).finite_number(), json.at(2).finite_number()};
}

Quat read_rotation(const JsonView& json) {
  if (json.size() != 4) json.bad("a list of 4 numbers");
  return {json.at(std::size_t{0}).finite_number(), json.at(1).finite_number(), json.at(2).finite_number(),
          json.at(3).finite_number()};
}

/// An integer in [lowest, end).
int read_index(const JsonView& json, int lowest, std::size_t end) {
  const std::int64_t index = json.integer();
  if (index < lowest || index >= static_cast<std::int64_t>(end))
    json.bad("a whole number from " + std::to_string(lowest) + " to " +
             std::to_string(static_cast<std::int64_t>(end) - 1));
  return static_cast<int>(index);
}

Shape read_shape(const JsonView& json) {
  constexpr std::array<std::string_view, 4> names{"sphere", "capsule", "cylinder", "box"};
  const auto found = std::find(names.begin(), names.end(), json.text());
  if (found == names.end()) json.bad("one of sphere, capsule, cylinder, box");
  return static_cast<Shape>(found - names.begin());
}

Body read_body(const JsonView& json, std::size_t own_index) {
  Body body;
  body.parent = read_index(json.at("parent"), own_index == 0 ? -1 : 0, own_index);
  body.position_m = read_vector(json.at("position_m"));
  body.rotation = read_rotation(json.at("rotation"));
  body.mass_kg = json.at("mass_kg").finite_number();
  body.com_m = read_vector(json.at("com_m"));
  return body;
}

Joint read_joint(const JsonView& json, std::size_t bodies) {
  Joint joint;
  joint.name = json.at("name").text();
  joint.body = read_index(json.at("body"), 0, bodies);
  joint.chain_index = static_cast<int>(json.at("chain_index").integer());
  joint.anchor_m = read_vector(json.at("anchor_m"));
  joint.axis = read_vector(json.at("axis"));
  joint.lower_rad = json.at("lower_rad").finite_number();
  joint.upper_rad = json.at("upper_rad").finite_number();
  return joint;
}

Geom read_geom(const JsonView& json, std::size_t bodies) {
  Geom geom;
  geom.body = read_index(json.at("body"), 0, bodies);
  geom.shape = read_shape(json.at("shape"));
  geom.size_m = read_vector(json.at("size_m"));
  geom.position_m = read_vector(json.at("position_m"));
  geom.rotation = read_rotation(json.at("rotation"));
  return geom;
}

Leg read_leg(const JsonView& json, const RobotModel& robot) {
  Leg leg;
  leg.name = json.at("name").text();
  leg.foot_geom = read_index(json.at("foot_geom"), 0, robot.geoms.size());
  const JsonView joints = json.at("joints");
  if (joints.size() != robot.joint_types.size()) joints.bad("a list with a joint for each joint type");
  for (std::size_t i = 0; i < joints.size(); ++i)
    leg.joints.push_back(read_index(joints.at(i), 0, robot.joints.size()));
  return leg;
}

}  // namespace

std::vector<int> RobotModel::joints_of_body(int body) const {
  std::vector<int> chain;
  for (std::size_t j = 0; j < joints.size(); ++j)
    if (joints[j].body == body) chain.push_back(static_cast<int>(j));
  const auto place = [this](int joint) { return joints[static_cast<std::size_t>(joint)].chain_index; };
  std::ranges::stable_sort(chain, {}, place);
  return chain;
}

int RobotModel::leg_of_body(int body) const {
  for (int b = body; b >= 0; b = bodies[static_cast<std::size_t>(b)].parent)
    for (std::size_t leg = 0; leg < legs.size(); ++leg)
      for (const int joint : legs[leg].joints)
        if (joints[static_cast<std::size_t>(joint)].body == b) return static_cast<int>(leg);
  return -1;
}

Vec3 RobotModel::com_at_start_m() const {
  std::vector<Body> in_world = bodies;
  Vec3 sum;
  double mass_kg = 0.0;
  for (Body& body : in_world) {
    if (body.parent >= 0) {
      const Body& parent = in_world[static_cast<std::size_t>(body.parent)];
      body.position_m = parent.position_m + rotate(parent.rotation, body.position_m);
      body.rotation = parent.rotation * body.rotation;
    }
    sum = sum + body.mass_kg * (body.position_m + rotate(body.rotation, body.com_m));
    mass_kg += body.mass_kg;
  }
  return (1.0 / mass_kg) * sum;
}

RobotModel parse_robot(const std::string& robot_json, const std::string& what) {
  const io::Json document = io::parse_json(robot_json, what);
  const JsonView json(document, what);
  RobotModel robot;
  robot.name = json.at("name").text();
  const JsonView bodies = json.at("bodies");
  for (std::size_t i = 0; i < bodies.size(); ++i) robot.bodies.push_back(read_body(bodies.at(i), i));
  double mass_kg = 0.0;
  for (const Body& body : robot.bodies) mass_kg += body.mass_kg;
  if (!(mass_kg > 0.0)) bodies.bad("a list of bodies with mass");
  const JsonView joints = json.at("joints");
  for (std::size_t i = 0; i < joints.size(); ++i)
    robot.joints.push_back(read_joint(joints.at(i), robot.bodies.size()));
  const JsonView geoms = json.at("geoms");
  for (std::size_t i = 0; i < geoms.size(); ++i)
    robot.geoms.push_back(read_geom(geoms.at(i), robot.bodies.size()));
  const JsonView types = json.at("joint_types");
  for (std::size_t i = 0; i < types.size(); ++i) robot.joint_types.push_back(types.at(i).text());
  const JsonView legs = json.at("legs");
  for (std::size_t i = 0; i < legs.size(); ++i) robot.legs.push_back(read_leg(legs.at(i), robot));
  robot.gravity_m_s2 = read_vector(json.at("gravity_m_s2"));
  if (robot.legs.empty()) legs.bad("a list with at least one leg");
  return robot;
}

}  // namespace amble::analysis
