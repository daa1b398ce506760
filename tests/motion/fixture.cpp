#include "tests/motion/fixture.hpp"

#include "amble/robot/json.hpp"

#include <nlohmann/json.hpp>

namespace amble::tests {
namespace {

using Json = nlohmann::json;

const std::vector<std::string> leg_names{"FL", "FR", "BL", "BR", "L5", "L6", "L7", "L8", "L9"};

Json body_json(const std::string& name, int parent, Json position_m, double mass_kg, Json com_m = {0, 0, 0}) {
  return {{"name", name},
          {"parent", parent},
          {"position_m", std::move(position_m)},
          {"rotation", {1, 0, 0, 0}},
          {"mass_kg", mass_kg},
          {"com_m", std::move(com_m)},
          {"inertia_kg_m2", {0.01, 0.01, 0.01}},
          {"inertia_rotation", {1, 0, 0, 0}}};
}

Json joint_json(const std::string& name, int body, int chain_index, Json axis, double lower_rad,
                double upper_rad) {
  return {{"name", name},
          {"body", body},
          {"chain_index", chain_index},
          {"anchor_m", {0, 0, 0}},
          {"axis", std::move(axis)},
          {"lower_rad", lower_rad},
          {"upper_rad", upper_rad},
          {"servo",
           {{"mode", "velocity"},
            {"gain_per_s", 9},
            {"max_torque_nm", 5},
            {"kp_nm_per_rad", 0},
            {"kd_nm_s_per_rad", 0}}}};
}

Json geom_json(int body, const std::string& shape, Json size_m, Json position_m) {
  return {{"name", shape},
          {"body", body},
          {"collides", true},
          {"shape", shape},
          {"size_m", std::move(size_m)},
          {"position_m", std::move(position_m)},
          {"rotation", {1, 0, 0, 0}},
          {"rgba", {0.5, 0.5, 0.5, 1}}};
}

void add_leg(Json& robot, int leg) {
  const std::string name = leg_names[static_cast<std::size_t>(leg)];
  const double x = 0.5 - 1.0 * (leg / 2), y = leg % 2 == 0 ? 0.2 : -0.2, outward = leg % 2 == 0 ? 1 : -1;
  const int upper = 1 + 2 * leg, lower = upper + 1;
  robot["bodies"].push_back(body_json(name + "_upper", 0, {x, y, 0}, 0.05, {0, 0, -0.5}));
  robot["bodies"].push_back(body_json(name + "_lower", upper, {0, 0, -0.5}, 0.05));
  robot["geoms"].push_back(geom_json(upper, "capsule", {0.05, 0.2, 0}, {0, 0, -0.25}));
  robot["geoms"].push_back(geom_json(lower, "box", {0.04, 0.04, 0.2}, {0, 0, -0.2}));
  robot["geoms"].push_back(geom_json(lower, "sphere", {0.1, 0, 0}, {0, 0, -0.4}));
  robot["joints"].push_back(
      joint_json(name + "_knee", lower, 0, {0, 1, 0}, leg < 2 ? -0.8 : 0, leg < 2 ? 0 : 0.8));
  robot["joints"].push_back(joint_json(name + "_hip_fb", upper, 1, {0, 1, 0}, -0.8, 0.8));
  robot["joints"].push_back(joint_json(name + "_hip_io", upper, 0, {outward, 0, 0}, 0, 0.4));
  robot["legs"].push_back(
      {{"name", name}, {"foot_geom", 3 * leg + 3}, {"joints", {3 * leg, 3 * leg + 1, 3 * leg + 2}}});
}

}  // namespace

std::string robot_json(int legs) {
  Json json{{"name", "test robot"},
            {"joint_types", {"knee", "hip_fb", "hip_io"}},
            {"contact", {{"friction", 1}, {"erp", 0.2}, {"cfm_s_per_kg", 1e-5}}},
            {"gravity_m_s2", {0, 0, -9.8}},
            {"fall_height_m", 0.2},
            {"self_collision", false}};
  json["bodies"].push_back(body_json("torso", -1, {0, 0, 1}, 1.0));
  json["geoms"].push_back(geom_json(0, "box", {0.5, 0.2, 0.1}, {0, 0, 0}));
  for (int leg = 0; leg < legs; ++leg) add_leg(json, leg);
  return json.dump();
}

robot::RobotSpec robot(int legs) {
  return robot::parse_robot(robot_json(legs), "test");
}

std::string supg_json(int legs) {
  Json json{{"kind", "supg"}, {"period_ticks", 10}, {"timestep_s", 0.1}, {"offset", "phase"}};
  for (int leg = 0; leg < legs; ++leg) json["offset_ticks"].push_back(leg + 1);
  for (int joint = 0; joint < 3 * legs; ++joint) {
    Json row;
    for (int tick = 0; tick <= 10; ++tick) row.push_back(joint * 0.01 + tick * 0.001);
    json["patterns_rad"].push_back(row);
  }
  return json.dump();
}

std::string network_json() {
  return R"({"kind": "ctrnn", "coordinates": ["x", "y"], "nodes": [
    {"name": "foot", "group": "in", "at": [-1, 0], "role": "sensor"},
    {"name": "inner", "group": "hidden", "at": [0, 0.5], "role": "hidden", "bias": 0.5, "time_constant": 3},
    {"name": "knee", "group": "out", "at": [1, 0], "role": "joint", "bias": 3, "time_constant": 3}],
    "possible_links": 4,
    "links": [{"source": 0, "target": 1, "weight": 2.0}, {"source": 1, "target": 2, "weight": -0.5}]})";
}

motion::RecordedTrial walk(int frames, int legs) {
  motion::RecordedTrial recorded;
  recorded.robot = robot(legs);
  recorded.controller_kind = "supg";
  recorded.supg = motion::parse_supg(supg_json(legs), recorded.robot, "test");
  motion::Motion& motion = recorded.motion;
  motion.frame_s = 0.1;
  motion.com_start_m = robot::start_com_m(recorded.robot);
  const auto n = static_cast<std::size_t>(legs);
  motion.angle_rad.resize(3 * n);
  motion.touch.resize(n);
  motion.timer_ticks.resize(n);
  motion.trigger.resize(n);
  for (int k = 0; k < frames; ++k) {
    const Vec3 moved{0.05 * (k + 1), 0, 0};
    motion.root_m.push_back(Vec3{0, 0, 1} + moved);
    motion.root_rotation.push_back({});
    motion.com_m.push_back(motion.com_start_m + moved);
    for (auto& angle : motion.angle_rad) angle.push_back(0.0f);
    for (int leg = 0; leg < legs; ++leg) {
      const auto l = static_cast<std::size_t>(leg);
      const auto touches = [&](int frame) { return (frame + leg) % 4 < 2; };
      const bool trigger = k >= 2 && touches(k - 1) && !touches(k - 2);
      const float before = k == 0 ? static_cast<float>(leg) : motion.timer_ticks[l].back();
      motion.touch[l].push_back(touches(k));
      motion.trigger[l].push_back(trigger);
      motion.timer_ticks[l].push_back(trigger ? 1.0f : before + 1.0f);
    }
  }
  return recorded;
}

}  // namespace amble::tests
