#include "amble/physics/engine.hpp"

#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <utility>

#include "amble/core/check.hpp"
#include "amble/core/error.hpp"
#include "amble/core/registry.hpp"
#include "amble/io/text.hpp"
#include "amble/physics/engine_kinds.hpp"

namespace amble::physics {
namespace {

// amble's own, in the order in which they are listed to users: each is in its folder, and registered where it
// is linked (the end of its source).
struct Own {
  std::string_view name, target;
};
constexpr std::array own_engines{Own{"ode", "physics_ode"}, Own{"batch", "physics_batch"},
                                 Own{"mujoco", "physics_mujoco"}, Own{"mujoco-model", "physics_mujoco_model"},
                                 Own{"ode-variant", "physics_ode"}};

Registry<EngineKind>& kinds() {
  static Registry<EngineKind> all("engine", {});
  return all;
}

const EngineKind& kind_of(std::string_view name) {
  check_engine_name(name);
  return *find_engine(name);
}

void refuse_held_torques(std::string_view name, const robot::RobotSpec& robot) {
  for (const robot::Joint& joint : robot.joints)
    if (joint.servo.hold_torque)
      fail(ExitCode::bad_input,
           "the engine '{}': the servo of joint '{}' holds its torque for a tick (servo.hold_torque in the "
           "robot file), which only engines of the model itself do: expected engine = \"mujoco-model\"",
           name, io::printable(joint.name));
}

}  // namespace

void Engine::set_ground(std::shared_ptr<const ground::Ground> ground) {
  ground_ = std::move(ground);
  for (int lane = 0; lane < lanes(); ++lane) retire(lane);
  on_ground();
}

void register_engine(EngineKind kind) {
  AMBLE_CHECK(kind.make, "an engine needs a function that makes it");
  AMBLE_CHECK(kind.traits.lanes >= 1, "an engine has lanes");
  kinds().add(std::move(kind));
}

const EngineKind* find_engine(std::string_view name) {
  return kinds().find(name);
}

std::vector<std::string_view> engine_names() {
  std::vector<std::string_view> names;
  for (const Own& own : own_engines)
    if (is_engine(own.name)) names.push_back(own.name);
  for (const EngineKind& kind : kinds().rows())
    if (std::ranges::find(own_engines, kind.name, &Own::name) == own_engines.end())
      names.push_back(kind.name);
  return names;
}

bool is_engine(std::string_view name) {
  return find_engine(name) != nullptr;
}

void check_engine_name(std::string_view name, std::string_view what) {
  if (is_engine(name)) return;
  const auto own = std::ranges::find(own_engines, name, &Own::name);
  if (own != own_engines.end())
    fail(ExitCode::bad_input, "{}the engine '{}' is not in this program: link amble::{}", what, name,
         own->target);
  fail(ExitCode::bad_input, "{}unknown engine '{}': expected {}", what, name,
       fmt::join(engine_names(), ", "));
}

EngineTraits engine_traits(std::string_view name) {
  return kind_of(name).traits;
}

std::unique_ptr<Engine> make_engine(std::string_view name, const robot::RobotSpec& robot,
                                    const EngineSettings& settings) {
  AMBLE_CHECK(settings.timestep_s > 0.0, "timestep_s");
  const EngineKind& kind = kind_of(name);
  if (!kind.traits.of_original_model) refuse_held_torques(name, robot);
  EngineSettings all = settings;
  all.own.complete(kind.numbers);
  auto engine = kind.make(robot, all);
  AMBLE_CHECK(engine != nullptr && engine->lanes() == kind.traits.lanes, "an engine has its kind's lanes");
  return engine;
}

}  // namespace amble::physics
