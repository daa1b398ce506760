#include "amble/controllers/factory.hpp"

#include <gtest/gtest.h>

#include "amble/io/json_file.hpp"
#include "tests/controllers/quadruped.hpp"

namespace amble::controllers {
namespace {

TEST(MakeArchitecture, MakesTheKindThatTheSettingsName) {
  const auto architecture = make_architecture(ControllerSettings(), quadruped(), 0.01);
  EXPECT_EQ(architecture->name(), "supg");
  EXPECT_EQ(architecture->input_names().size(), 3u);
  EXPECT_EQ(architecture->make_batch(5)->lanes(), 5);
}

TEST(ControllerSettings, HoldTheKindAndATablePerKind) {
  ControllerSettings settings;
  settings.supg.idle = Idle::wrap;
  io::Json json = io::Json::object();
  settings.describe(*io::json_writer(json));
  EXPECT_EQ(json["kind"], "supg");
  EXPECT_EQ(json["supg"]["idle"], "wrap");
}

}  // namespace
}  // namespace amble::controllers
