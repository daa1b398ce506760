#include "amble/physics/engine.hpp"

#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <utility>

#include "amble/core/check.hpp"
#include "amble/core/error.hpp"
#include "amble/physics/batch/batch_engine.hpp"
#include "amble/physics/batch/state_rows.hpp"
#include "amble/physics/mujoco/mujoco_engine.hpp"
#include "amble/physics/mujoco_model/mujoco_model_engine.hpp"
#include "amble/physics/ode/ode_engine.hpp"

namespace amble::physics {
namespace {

// The table of engines. A new one is a row here and a folder beside `ode`.
struct Row {
  std::string_view name;
  EngineTraits traits;
  std::unique_ptr<Engine> (*make)(const robot::RobotSpec& robot, const EngineSettings& settings);
};
constexpr std::array engines{
    // ODE has data of its own for each thread.
    Row{"ode", {.lanes = 1, .keeps_to_a_thread = true}, make_ode_engine},
    Row{"batch",
        {.lanes = batch::lanes},
        [](const robot::RobotSpec& robot, const EngineSettings& settings) -> std::unique_ptr<Engine> {
          return make_batch_engine(robot, settings);
        }},
    Row{"mujoco", {.lanes = 1}, make_mujoco_engine},
    Row{"mujoco-model", {.lanes = 1, .of_original_model = true}, make_mujoco_model_engine},
};

constexpr std::array names = [] {
  std::array<std::string_view, engines.size()> all;
  std::ranges::transform(engines, all.begin(), &Row::name);
  return all;
}();

}  // namespace

void Engine::set_ground(std::shared_ptr<const ground::Ground> ground) {
  ground_ = std::move(ground);
  for (int lane = 0; lane < lanes(); ++lane) retire(lane);
  on_ground();
}

std::span<const std::string_view> engine_names() {
  return names;
}

bool is_engine(std::string_view name) {
  return std::ranges::find(names, name) != names.end();
}

void check_engine_name(std::string_view name, std::string_view what) {
  if (!is_engine(name))
    fail(ExitCode::bad_input, "{}unknown engine '{}': expected {}", what, name, fmt::join(names, ", "));
}

EngineTraits engine_traits(std::string_view name) {
  check_engine_name(name);
  return std::ranges::find(engines, name, &Row::name)->traits;
}

std::unique_ptr<Engine> make_engine(std::string_view name, const robot::RobotSpec& robot,
                                    const EngineSettings& settings) {
  AMBLE_CHECK(settings.timestep_s > 0.0, "timestep_s");
  check_engine_name(name);
  return std::ranges::find(engines, name, &Row::name)->make(robot, settings);
}

}  // namespace amble::physics
