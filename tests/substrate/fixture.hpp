#pragma once

#include <string>
#include <vector>

#include "amble/io/toml_settings.hpp"
#include "amble/substrate/layout.hpp"
#include "tests/controllers/quadruped.hpp"

namespace amble::substrate {

/// The substrate of a file in configs/parts.
inline Settings part(const std::string& name) {
  const auto document =
      io::TomlDocument::read(std::string(AMBLE_SOURCE_DIR) + "/configs/parts/" + name + ".toml");
  Settings settings;
  const auto reader = document.reader();
  reader->begin("controller", {});
  reader->table("substrate", settings, {});
  reader->end();
  return settings;
}

/// The substrate of a TOML text.
inline Settings substrate_of(const std::string& toml) {
  const auto document = io::TomlDocument::parse(toml, "x.toml");
  Settings settings;
  const auto reader = document.reader();
  settings.describe(*reader);
  reader->finish();
  return settings;
}

/// One leg with one joint, on a line.
inline robot::RobotSpec hopper() {
  robot::RobotSpec robot;
  robot.joint_types = {"knee"};
  robot.legs.push_back({"L", {0}, {0}});
  robot.joints.emplace_back().name = "L_knee";
  return robot;
}

inline Needs supg_needs(int ticks = 100) {
  return {.kind = "supg", .network = false, .properties = {"pattern", "offset"}, .pattern_ticks = ticks};
}
inline Needs network_needs() {
  return {.kind = "network", .network = true, .properties = {}, .pattern_ticks = 0};
}
inline Needs ctrnn_needs() {
  return {.kind = "ctrnn", .network = true, .properties = {"bias", "time_constant"}, .pattern_ticks = 0};
}

}  // namespace amble::substrate
