#pragma once

#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <functional>
#include <string>
#include <string_view>

#include "amble/core/error.hpp"
#include "amble/morphology/robot_file.hpp"

namespace amble::morphology {

/// A folder for one test's robot files, removed with it.
class Files {
 public:
  Files() : folder_(std::filesystem::temp_directory_path() / ("amble_robot_" + std::to_string(getpid()))) {
    std::filesystem::create_directories(folder_);
  }
  ~Files() { std::filesystem::remove_all(folder_); }
  Files(const Files&) = delete;
  Files& operator=(const Files&) = delete;

  std::filesystem::path write(const std::string& name, std::string_view text) const {
    std::ofstream(folder_ / name) << text;
    return folder_ / name;
  }
  std::filesystem::path path(const std::string& name) const { return folder_ / name; }

  /// The line that a user reads when `action` fails, without this folder's name in it.
  std::string error_of(const std::function<void()>& action) const {
    try {
      action();
    } catch (const UserError& error) {
      std::string text = error.what();
      const std::string folder = folder_.string() + "/";
      for (std::size_t at = text.find(folder); at != std::string::npos; at = text.find(folder))
        text.erase(at, folder.size());
      return text;
    }
    return "accepted";
  }

 private:
  std::filesystem::path folder_;
};

/// `text` with the first `from` in it replaced.
inline std::string with(std::string text, std::string_view from, std::string_view to) {
  const std::size_t at = text.find(from);
  if (at == std::string::npos) throw std::logic_error("no such text to replace: " + std::string(from));
  return text.replace(at, from.size(), to);
}

/// A torso with one leg of two hinges; robots in the tests are this one with something changed.
inline const std::string one_leg_xml = R"(<mujoco>
  <compiler angle="radian"/>
  <option gravity="0 0 -9.8"/>
  <worldbody>
    <body name="torso" pos="0 0 1">
      <freejoint name="root"/>
      <geom name="torso" type="box" size="0.2 0.1 0.05" mass="3"/>
      <body name="thigh" pos="0 0 -0.1">
        <joint name="A_hip" type="hinge" axis="0 1 0" limited="true" range="-0.5 0.5"/>
        <geom name="thigh" type="capsule" fromto="0 0 0 0 0 -0.4" size="0.05" mass="1"/>
        <body name="shin" pos="0 0 -0.4">
          <joint name="A_knee" type="hinge" axis="0 1 0" limited="true" range="-0.7 0"/>
          <geom name="shin" type="cylinder" pos="0 0 -0.2" size="0.04 0.2" mass="0.5"/>
          <geom name="A_foot" type="sphere" pos="0 0 -0.4" size="0.06" mass="0.25"/>
        </body>
      </body>
    </body>
  </worldbody>
</mujoco>
)";

inline const std::string one_leg_toml = R"(name = "one leg"
model = "one_leg.xml"
legs = ["A"]
joint_types = ["hip", "knee"]
fall_height_m = 0.5
self_collision = false

[servo]
mode = "velocity"
gain_per_s = 9.0
max_torque_nm = 5.0

[contact]
friction = inf
erp = 0.1
cfm_s_per_kg = 1e-4
)";

/// Loads the one-legged robot from these two texts, as a user would.
inline robot::RobotSpec load_one_leg(const Files& files, const std::string& xml = one_leg_xml,
                                     const std::string& toml = one_leg_toml) {
  files.write("one_leg.xml", xml);
  return load_robot(files.write("one_leg.toml", toml));
}

}  // namespace amble::morphology
