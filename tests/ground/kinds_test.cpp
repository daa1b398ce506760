#include "amble/ground/kinds.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "amble/core/error.hpp"
#include "amble/ground/height_field.hpp"
#include "amble/io/json_file.hpp"

namespace amble::ground {
namespace {

/// Waves along x, `waves` of them in a period.
void register_waves() {
  static const bool once = [] {
    register_ground({.name = "test_waves",
                     .shape = [](const Settings& settings, double period_m, Stream stream) -> Shape {
                       const double waves = settings.own.numbers.at("waves"), shift = stream.uniform();
                       return [=](double x_m, double) { return std::sin(waves * x_m / period_m + shift); };
                     },
                     .numbers = {{.name = "waves", .value = 3.0, .range = {1.0, 9.0}, .what = "waves"}}});
    return true;
  }();
  ASSERT_TRUE(once);
}

Settings waves() {
  Settings settings;
  settings.kind = "test_waves";
  return settings;
}

TEST(RegisterGround, AddsAKindThatSettingsChooseAndFieldsAreMadeOf) {
  register_waves();
  const io::Json json = io::parse_json(
      R"({"kind": "test_waves", "height_m": 0.5, "length_m": 0.5, "cell_m": 0.04, "start_radius_m": 0.6,
          "start_place_m": 0.0, "slope_x": 0.0, "slope_y": 0.0, "friction": -1.0, "seed": 1, "vary": "never",
          "grow_generations": 0, "own": {"waves": 5.0}})",
      "it");
  const auto settings = io::settings_from_json<Settings>(io::JsonView(json, "it"));
  EXPECT_EQ(io::settings_to_json(settings), json) << "reads back";
  EXPECT_TRUE(settings.has_field());
  settings.validate();
  const HeightField field = make_field(settings, {}), same = make_field(settings, {});
  EXPECT_EQ(field.heights_m(), same.heights_m());
  Settings other = settings;
  other.own.numbers["waves"] = 6.0;
  EXPECT_NE(make_field(other, {}).heights_m(), field.heights_m());
  other = settings;
  other.seed = 2;
  EXPECT_NE(make_field(other, {}).heights_m(), field.heights_m()) << "its random numbers are the field's";
}

TEST(RegisterGround, StartsFlatAndTakesDefaultsForWhatIsNotGiven) {
  register_waves();
  const HeightField field = make_field(waves(), {});
  EXPECT_EQ(field.at(0.3, -0.2).height_m, 0.0);
  EXPECT_NE(field.at(2.0, 1.0).height_m, 0.0);
  Settings given = waves();
  given.own.numbers["waves"] = 3.0;
  EXPECT_EQ(make_field(given, {}).heights_m(), field.heights_m());
}

TEST(RegisterGround, RefusesNamesThatAreTakenOrCannotBeOne) {
  for (const auto& [name, words] :
       {std::pair{"hills", "ground 'hills' exists already"}, {"Big Waves", "ground 'Big Waves': a name has"}})
    try {
      register_ground({.name = name, .shape = [](const Settings&, double, Stream) -> Shape { return {}; }});
      FAIL() << name;
    } catch (const UserError& error) {
      EXPECT_NE(std::string(error.what()).find(words), std::string::npos) << error.what();
    }
}

TEST(Kinds, AreThePlaneAndThenAmblesOwnInTheOrderOfTheDocs) {
  const std::vector<std::string> own{"plane", "hills", "rough", "stones", "blocks", "stairs", "hurdles"};
  for (std::size_t i = 0; i < own.size(); ++i) EXPECT_EQ(kinds().at(i).name, own[i]);
}

}  // namespace
}  // namespace amble::ground
