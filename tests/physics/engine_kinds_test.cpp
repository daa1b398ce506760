#include "amble/physics/engine_kinds.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <span>

#include "amble/physics/batch/batch_engine.hpp"
#include "tests/core/error_of.hpp"
#include "tests/physics/scene.hpp"

namespace amble::physics {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::StartsWith;

/// The batch engine under another name, with a setting; `seen` gets its value.
EngineKind named(const std::string& name, double& seen) {
  return {.name = name,
          .traits = engine_traits("batch"),
          .make =
              [&seen](const robot::RobotSpec& robot, const EngineSettings& settings) {
                seen = settings.own.numbers.at("stiffness");
                return make_batch_engine(robot, settings);
              },
          .numbers = {{.name = "stiffness", .value = 2.5, .range = {0.0, 9.0}, .what = "how stiff"}}};
}

TEST(EngineKinds, AProgramHasThoseThatItLinksThenThoseThatItRegisters) {
  const auto linked = engine_names();
  ASSERT_GE(linked.size(), 4u);
  EXPECT_THAT(std::span(linked).first(4), ElementsAre("ode", "batch", "mujoco", "mujoco-model"));
  double seen = 0.0;
  register_engine(named("later", seen));
  EXPECT_EQ(engine_names().size(), linked.size() + 1);
  EXPECT_EQ(engine_names().back(), "later");
}

TEST(EngineKinds, OneThatIsRegisteredGetsItsSettingsOrTheirDefaults) {
  double seen = 0.0;
  register_engine(named("stiff", seen));
  const auto robot = quadruped();
  make_engine("stiff", robot, {});
  EXPECT_EQ(seen, 2.5);
  EngineSettings settings;
  settings.own.numbers["stiffness"] = 4.0;
  make_engine("stiff", robot, settings);
  EXPECT_EQ(seen, 4.0);
}

TEST(EngineKinds, ATakenNameIsRefused) {
  double seen = 0.0;
  EXPECT_THAT(tests::error_of([&] { register_engine(named("ode", seen)); }),
              HasSubstr("engine 'ode' exists already"));
}

TEST(EngineKinds, AnUnknownNameIsToldWithThoseThatThereAre) {
  EXPECT_THAT(tests::error_of([] { check_engine_name("odd", "--engine: "); }),
              StartsWith("--engine: unknown engine 'odd': expected ode, batch, mujoco, mujoco-model"));
}

}  // namespace
}  // namespace amble::physics
