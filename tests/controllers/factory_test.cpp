#include "amble/controllers/factory.hpp"

#include <gtest/gtest.h>

#include "amble/core/error.hpp"
#include "amble/io/json_file.hpp"
#include "tests/controllers/quadruped.hpp"
#include "tests/substrate/fixture.hpp"

namespace amble::controllers {
namespace {

TEST(MakeArchitecture, MakesTheKindThatTheSettingsName) {
  const std::pair<const char*, const char*> kinds[] = {
      {"supg", "supg"}, {"network", "sine"}, {"ctrnn", "ctrnn"}};
  for (const auto& [kind, part] : kinds) {
    ControllerSettings settings;
    settings.kind = kind;
    settings.substrate = substrate::part(part);
    const auto architecture = make_architecture(settings, quadruped(), 0.01);
    EXPECT_EQ(architecture->name(), kind);
    EXPECT_EQ(architecture->make_batch(5)->lanes(), 5);
  }
}

TEST(MakeArchitecture, RefusesSettingsWithoutASubstrate) {
  EXPECT_THROW(make_architecture(ControllerSettings(), quadruped(), 0.01), UserError);
}

TEST(ControllerSettings, ReadBackFromJsonWithTheSubstrate) {
  ControllerSettings settings;
  settings.kind = "ctrnn";
  settings.supg.idle = Idle::wrap;
  settings.substrate = substrate::part("ctrnn");
  const io::Json json = io::settings_to_json(settings);
  EXPECT_EQ(json["kind"], "ctrnn");
  EXPECT_EQ(json["supg"]["idle"], "wrap");
  EXPECT_EQ(json["substrate"]["nodes"].size(), 24u);
  const auto again = io::settings_from_json<ControllerSettings>(io::JsonView(json, "x"));
  EXPECT_EQ(io::settings_to_json(again), json);
}

}  // namespace
}  // namespace amble::controllers
