#pragma once

#include <fmt/format.h>
#include <mujoco/mujoco.h>

#include <algorithm>
#include <array>
#include <memory>
#include <string>
#include <string_view>

#include "amble/core/math.hpp"
#include "amble/morphology/robot_guess.hpp"
#include "tests/models/small_models.hpp"
#include "tests/morphology/files.hpp"

namespace amble::physics {

/// A quadruped of eight hinges as people write them, with its own ground, softness, friction and inertias.
/// `actuators`: the section; `before`: options and defaults.
inline std::string own_model(const std::string& actuators, const std::string& before = {},
                             const std::string& root = "<freejoint/>") {
  tests::LegText like;
  like.hip = R"(range="-40 40" damping="0.3" armature="0.005" frictionloss="0.05")";
  like.knee = R"(range="-60 60" damping="0.2" stiffness="1.5" springref="10")";
  like.foot = R"(type="sphere" size="0.02" condim="6" solimp="0.1 0.95 0.01" solref="0.01 0.9")";
  std::string text = tests::model_text(
      tests::four_legs(like), root, "", actuators,
      before +
          R"(<visual><rgba haze="0 0 0 0"/></visual><statistic meaninertia="0.4"/><size nstack="300000"/>)");
  return morphology::with(text, "size=\"9 9 1\"", R"(size="9 9 1" friction="0.6" solref="0.015 1")");
}

inline const std::string position_actuators =
    tests::motors(R"(position kp="30" forcerange="-9 9" ctrlrange="-0.6 0.6")");

/// What --init makes of a model, in a folder of the test.
inline robot::RobotSpec own_robot(const morphology::Files& files, const std::string& mjcf,
                                  const std::string& more_toml = {}) {
  const auto file = files.write("own.xml", mjcf);
  const auto guess = morphology::guess_robot(morphology::compile_model(file), "own.xml", true);
  return morphology::load_robot(files.write("own.toml", guess.toml + more_toml));
}

/// A model file as MuJoCo's simulate runs it: loaded, placed, stepped.
class Simulate {
 public:
  Simulate(const std::filesystem::path& file, const robot::RobotSpec& robot) {
    std::array<char, 1000> problem{};
    model_.reset(mj_loadXML(file.c_str(), nullptr, problem.data(), problem.size()));
    if (!model_) throw std::runtime_error(problem.data());
    data_.reset(mj_makeData(model_.get()));
    const robot::Body& root = robot.bodies[0];
    const mjtNum pose[] = {root.position_m.x, root.position_m.y, root.position_m.z, root.rotation.w,
                           root.rotation.x,   root.rotation.y,   root.rotation.z};
    std::ranges::copy(pose, data_->qpos);
  }

  mjModel& model() { return *model_; }
  mjData& data() { return *data_; }
  /// A joint's address and angle, by name.
  int joint(const std::string& name) const { return mj_name2id(model_.get(), mjOBJ_JOINT, name.c_str()); }
  double& position(const std::string& name) { return data_->qpos[model_->jnt_qposadr[joint(name)]]; }
  double& speed(const std::string& name) { return data_->qvel[model_->jnt_dofadr[joint(name)]]; }
  /// The control of the first actuator of a joint.
  double& control(const std::string& name) {
    for (int a = 0; a < model_->nu; ++a)
      if (model_->actuator_trnid[2 * a] == joint(name)) return data_->ctrl[a];
    throw std::runtime_error("no actuator");
  }
  void step() { mj_step(model_.get(), data_.get()); }

 private:
  struct Delete {
    void operator()(mjModel* model) const { mj_deleteModel(model); }
    void operator()(mjData* data) const { mj_deleteData(data); }
  };
  std::unique_ptr<mjModel, Delete> model_;
  std::unique_ptr<mjData, Delete> data_;
};

}  // namespace amble::physics
