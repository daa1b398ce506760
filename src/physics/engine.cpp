#include "amble/physics/engine.hpp"

#include <fmt/ranges.h>

#include <algorithm>

#include "amble/core/check.hpp"
#include "amble/core/error.hpp"
#include "amble/physics/batch/batch_engine.hpp"
#include "amble/physics/mujoco/mujoco_engine.hpp"
#include "amble/physics/ode/ode_engine.hpp"

namespace amble::physics {

bool is_engine(std::string_view name) {
  return std::ranges::find(engine_names, name) != engine_names.end();
}

void check_engine_name(std::string_view name, std::string_view what) {
  if (!is_engine(name))
    fail(ExitCode::bad_input, "{}unknown engine '{}': expected {}", what, name,
         fmt::join(engine_names, ", "));
}

std::unique_ptr<Engine> make_engine(std::string_view name, const robot::RobotSpec& robot,
                                    const EngineSettings& settings) {
  AMBLE_CHECK(settings.timestep_s > 0.0, "timestep_s");
  check_engine_name(name);
  if (name == "batch") return make_batch_engine(robot, settings);
  if (name == "mujoco") return make_mujoco_engine(robot, settings);
  return make_ode_engine(robot, settings);
}

}  // namespace amble::physics
