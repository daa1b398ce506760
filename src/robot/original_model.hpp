#pragma once

#include <map>
#include <memory>
#include <string>
#include <vector>

#include "amble/io/json_file.hpp"
#include "amble/robot/spec.hpp"

namespace amble::robot {

/// The MJCF that a robot was read from, with all that its author wrote of its physics, whole: it refers to no
/// file but `meshes`. Written by morphology::keep_model(), simulated by the engine mujoco-model.
struct OriginalModel {
  std::string mjcf;
  std::map<std::string, std::string> meshes;  ///< file name → bytes
  std::vector<double> start;                  ///< MuJoCo's qpos in the robot's start pose
  std::vector<int> joints;                    ///< by joint of the robot: MuJoCo's number
  std::vector<int> geoms;                     ///< by geom of the robot: MuJoCo's number
};

/// As JSON (docs/FORMATS.md), meshes deflated. Numbers read back to the same bits.
io::Json to_json(const OriginalModel& model);

/// Throws UserError(ExitCode::bad_file) for a missing or wrong key, and where it is not that of `robot`.
std::shared_ptr<const OriginalModel> original_model_from_json(const io::JsonView& json,
                                                              const RobotSpec& robot);

/// Whether both robots have one that is written the same, or none.
bool same_original_model(const RobotSpec& a, const RobotSpec& b);

}  // namespace amble::robot
