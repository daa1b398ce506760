#include "amble/robot/json.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>
#include <utility>

#include "amble/core/index.hpp"
#include "amble/robot/check.hpp"

namespace amble::robot {
namespace {

using io::Json;
using io::JsonView;

constexpr std::array<std::string_view, 5> shape_names{"sphere", "capsule", "cylinder", "box", "mesh"};
constexpr std::array<std::string_view, 3> servo_mode_names{"velocity", "torque", "none"};

Json json_of(Vec3 v) {
  return Json::array({v.x, v.y, v.z});
}
Json json_of(Quat q) {
  return Json::array({q.w, q.x, q.y, q.z});
}

Vec3 vec3(const JsonView& json) {
  if (json.size() != 3) json.bad("an array of 3 numbers");
  return {json.at(std::size_t{0}).number(), json.at(1).number(), json.at(2).number()};
}

Quat quat(const JsonView& json) {
  if (json.size() != 4) json.bad("an array of 4 numbers");
  return {json.at(std::size_t{0}).number(), json.at(1).number(), json.at(2).number(), json.at(3).number()};
}

int index(const JsonView& json) {
  const std::int64_t value = json.integer();
  if (value < -1 || value > 1'000'000) json.bad("an index");
  return static_cast<int>(value);
}

template <typename Enum, std::size_t N>
Enum choice(const JsonView& json, const std::array<std::string_view, N>& names) {
  const auto found = std::find(names.begin(), names.end(), json.text());
  if (found == names.end()) json.bad(fmt::format("one of {}", fmt::join(names, ", ")));
  return static_cast<Enum>(found - names.begin());
}

template <typename T, typename Read>
std::vector<T> list(const JsonView& json, Read read) {
  std::vector<T> items;
  for (std::size_t i = 0; i < json.size(); ++i) items.push_back(read(json.at(i)));
  return items;
}

template <typename T, typename Write>
Json array_of(const std::vector<T>& items, Write write) {
  Json array = Json::array();
  for (const T& item : items) array.push_back(write(item));
  return array;
}

Json json_of_body(const Body& body) {
  return {{"name", body.name},
          {"parent", body.parent},
          {"position_m", json_of(body.position_m)},
          {"rotation", json_of(body.rotation)},
          {"mass_kg", body.mass_kg},
          {"com_m", json_of(body.com_m)},
          {"inertia_kg_m2", json_of(body.inertia_kg_m2)},
          {"inertia_rotation", json_of(body.inertia_rotation)}};
}

Body read_body(const JsonView& json) {
  return {.name = json.at("name").text(),
          .parent = index(json.at("parent")),
          .position_m = vec3(json.at("position_m")),
          .rotation = quat(json.at("rotation")),
          .mass_kg = json.at("mass_kg").number(),
          .com_m = vec3(json.at("com_m")),
          .inertia_kg_m2 = vec3(json.at("inertia_kg_m2")),
          .inertia_rotation = quat(json.at("inertia_rotation"))};
}

/// "hold_torque" is there only where it is set.
Json json_of_servo(const Servo& servo) {
  Json json{{"mode", servo_mode_names[to_index(servo.mode)]},
            {"gain_per_s", servo.gain_per_s},
            {"max_torque_nm", servo.max_torque_nm},
            {"kp_nm_per_rad", servo.kp_nm_per_rad},
            {"kd_nm_s_per_rad", servo.kd_nm_s_per_rad}};
  if (servo.hold_torque) json["hold_torque"] = true;
  return json;
}

Servo read_servo(const JsonView& json) {
  return {.mode = choice<ServoMode>(json.at("mode"), servo_mode_names),
          .gain_per_s = json.at("gain_per_s").number(),
          .max_torque_nm = json.at("max_torque_nm").number(),
          .kp_nm_per_rad = json.at("kp_nm_per_rad").number(),
          .kd_nm_s_per_rad = json.at("kd_nm_s_per_rad").number(),
          .hold_torque = json.has("hold_torque") && json.at("hold_torque").flag()};
}

/// Members of a joint that are left out where they are 0.
constexpr std::array<std::pair<const char*, double Joint::*>, 5> passive_members{
    {{"armature_kg_m2", &Joint::armature_kg_m2},
     {"damping_nm_s_per_rad", &Joint::damping_nm_s_per_rad},
     {"friction_loss_nm", &Joint::friction_loss_nm},
     {"stiffness_nm_per_rad", &Joint::stiffness_nm_per_rad},
     {"rest_rad", &Joint::rest_rad}}};

Json json_of_joint(const Joint& joint) {
  Json json{{"name", joint.name},
            {"body", joint.body},
            {"chain_index", joint.chain_index},
            {"anchor_m", json_of(joint.anchor_m)},
            {"axis", json_of(joint.axis)},
            {"lower_rad", io::json_number(joint.lower_rad)},
            {"upper_rad", io::json_number(joint.upper_rad)},
            {"servo", json_of_servo(joint.servo)}};
  if (joint.command) json["command_rad"] = {joint.command->lower_rad, joint.command->upper_rad};
  for (const auto& [key, member] : passive_members)
    if (joint.*member != 0.0) json[key] = joint.*member;
  return json;
}

Joint read_joint(const JsonView& json) {
  Joint joint{.name = json.at("name").text(),
              .body = index(json.at("body")),
              .chain_index = index(json.at("chain_index")),
              .anchor_m = vec3(json.at("anchor_m")),
              .axis = vec3(json.at("axis")),
              .lower_rad = json.at("lower_rad").number(),
              .upper_rad = json.at("upper_rad").number(),
              .servo = read_servo(json.at("servo"))};
  if (json.has("command_rad")) {
    const JsonView range = json.at("command_rad");
    if (range.size() != 2) range.bad("an array of 2 numbers");
    joint.command = AngleRange{range.at(std::size_t{0}).number(), range.at(1).number()};
  }
  for (const auto& [key, member] : passive_members)
    if (json.has(key)) joint.*member = json.at(key).number();
  return joint;
}

Json json_of_geom(const Geom& geom) {
  Json json{{"name", geom.name},
            {"body", geom.body},
            {"collides", geom.collides},
            {"shape", shape_names[to_index(geom.shape)]},
            {"size_m", json_of(geom.size_m)},
            {"position_m", json_of(geom.position_m)},
            {"rotation", json_of(geom.rotation)},
            {"rgba", geom.rgba}};
  if (geom.shape == Shape::mesh) {
    json["vertices_m"] = array_of(geom.vertices_m, [](Vec3 vertex) { return json_of(vertex); });
    json["triangles"] = geom.triangles;
  }
  return json;
}

std::array<int, 3> read_triangle(const JsonView& json) {
  if (json.size() != 3) json.bad("an array of 3 indices");
  return {index(json.at(std::size_t{0})), index(json.at(1)), index(json.at(2))};
}

Geom read_geom(const JsonView& json) {
  Geom geom{.name = json.at("name").text(),
            .body = index(json.at("body")),
            .collides = json.at("collides").flag(),
            .shape = choice<Shape>(json.at("shape"), shape_names),
            .size_m = vec3(json.at("size_m")),
            .position_m = vec3(json.at("position_m")),
            .rotation = quat(json.at("rotation"))};
  const JsonView rgba = json.at("rgba");
  if (rgba.size() != geom.rgba.size()) rgba.bad("an array of 4 numbers");
  for (std::size_t i = 0; i < geom.rgba.size(); ++i) geom.rgba[i] = static_cast<float>(rgba.at(i).number());
  if (geom.shape == Shape::mesh) {
    geom.vertices_m = list<Vec3>(json.at("vertices_m"), vec3);
    geom.triangles = list<std::array<int, 3>>(json.at("triangles"), read_triangle);
  }
  return geom;
}

/// "sweeps" is there only where it is not the default.
Json json_of_contact(const Contact& contact) {
  Json json{{"friction", io::json_number(contact.friction)},
            {"erp", contact.erp},
            {"cfm_s_per_kg", contact.cfm_s_per_kg}};
  if (contact.sweeps != 0) json["sweeps"] = contact.sweeps;
  return json;
}

Contact read_contact(const JsonView& json) {
  return {.friction = json.at("friction").number(),
          .erp = json.at("erp").number(),
          .cfm_s_per_kg = json.at("cfm_s_per_kg").number(),
          .sweeps = json.has("sweeps") ? index(json.at("sweeps")) : 0};
}

/// A foot of one shape is "foot_geom", as it was before there were several.
Leg read_leg(const JsonView& json) {
  return {.name = json.at("name").text(),
          .foot_geoms = json.has("foot_geoms") ? list<int>(json.at("foot_geoms"), index)
                                               : std::vector<int>{index(json.at("foot_geom"))},
          .joints = list<int>(json.at("joints"), index)};
}

Json json_of_leg(const Leg& leg) {
  Json json{{"name", leg.name}};
  if (leg.foot_geoms.size() == 1)
    json["foot_geom"] = leg.foot_geoms.front();
  else
    json["foot_geoms"] = leg.foot_geoms;
  json["joints"] = leg.joints;
  return json;
}

}  // namespace

/// "fall_above_m" and "fall_tilt_rad" are there only where they are finite.
Json to_json(const RobotSpec& robot) {
  Json json{{"name", robot.name},
            {"bodies", array_of(robot.bodies, json_of_body)},
            {"joints", array_of(robot.joints, json_of_joint)},
            {"geoms", array_of(robot.geoms, json_of_geom)},
            {"joint_types", robot.joint_types},
            {"legs", array_of(robot.legs, json_of_leg)},
            {"contact", json_of_contact(robot.contact)},
            {"gravity_m_s2", json_of(robot.gravity_m_s2)},
            {"fall_height_m", robot.fall_height_m},
            {"self_collision", robot.self_collision}};
  if (std::isfinite(robot.fall_above_m)) json["fall_above_m"] = robot.fall_above_m;
  if (std::isfinite(robot.fall_tilt_rad)) json["fall_tilt_rad"] = robot.fall_tilt_rad;
  return json;
}

RobotSpec from_json(const JsonView& json) {
  RobotSpec robot{.name = json.at("name").text(),
                  .bodies = list<Body>(json.at("bodies"), read_body),
                  .joints = list<Joint>(json.at("joints"), read_joint),
                  .geoms = list<Geom>(json.at("geoms"), read_geom),
                  .joint_types = list<std::string>(json.at("joint_types"),
                                                   [](const JsonView& type) { return type.text(); }),
                  .legs = list<Leg>(json.at("legs"), read_leg),
                  .contact = read_contact(json.at("contact")),
                  .gravity_m_s2 = vec3(json.at("gravity_m_s2")),
                  .fall_height_m = json.at("fall_height_m").number(),
                  .self_collision = json.at("self_collision").flag()};
  if (json.has("fall_above_m")) robot.fall_above_m = json.at("fall_above_m").number();
  if (json.has("fall_tilt_rad")) robot.fall_tilt_rad = json.at("fall_tilt_rad").number();
  check_robot(robot, [&](const std::string& problem) { json.refuse("holds no valid robot: " + problem); });
  return robot;
}

RobotSpec parse_robot(const std::string& text, const std::string& what) {
  const io::Json document = io::parse_json(text, what);
  const JsonView json(document, what);
  if (json.at("legs").size() == 0) json.at("legs").bad("a list with at least one leg");
  return from_json(json);
}

}  // namespace amble::robot
