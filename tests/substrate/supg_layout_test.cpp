#include "amble/substrate/supg_layout.hpp"

#include <gtest/gtest.h>

#include <array>
#include <set>
#include <string>

#include "amble/core/error.hpp"
#include "amble/io/json_file.hpp"

namespace amble::substrate {
namespace {

std::array<float, 3> query(const SupgLayout& layout, int point) {
  return {layout.points().get(point, 0), layout.points().get(point, 1), layout.points().get(point, 2)};
}

TEST(SupgLayout, PlacesSupgsAsTheAuthorsDid) {
  // Legs FL, FR, BL, BR at −1, −0.33, 0.33, 1, divided by 50; types knee, hip_fb, hip_io at −1, 0, 1; time
  // tick / 100.
  const std::array<float, 4> legs{-0.02f, -0.0066f, 0.0066f, 0.02f};
  const std::array<float, 3> types{-1.0f, 0.0f, 1.0f};
  const SupgLayout layout(SupgLayoutSettings(), 4, 3, 100);
  EXPECT_EQ(layout.points().count(), 4 * 3 * 101 + 4);
  for (int leg = 0; leg < 4; ++leg)
    for (int type = 0; type < 3; ++type)
      for (const int tick : {0, 1, 25, 99, 100}) {
        const std::array<float, 3> expected{legs[static_cast<std::size_t>(leg)],
                                            types[static_cast<std::size_t>(type)],
                                            static_cast<float>(tick) / 100.0f};
        EXPECT_EQ(query(layout, layout.pattern_point(leg, type, tick)), expected);
      }
}

TEST(SupgLayout, AsksForOffsetsWithTypeAndTimeZero) {
  const SupgLayout layout(SupgLayoutSettings(), 4, 3, 100);
  EXPECT_EQ(query(layout, layout.offset_point(0)), (std::array{-0.02f, 0.0f, 0.0f}));
  EXPECT_EQ(query(layout, layout.offset_point(3)), (std::array{0.02f, 0.0f, 0.0f}));
}

TEST(SupgLayout, SwapsTheAxesOfLegsAndTypes) {
  SupgLayoutSettings settings;
  settings.leg_axis = LegAxis::y;
  const SupgLayout layout(settings, 4, 3, 50);
  EXPECT_EQ(query(layout, layout.pattern_point(3, 0, 25)), (std::array{-1.0f, 0.02f, 0.5f}));
  EXPECT_EQ(query(layout, layout.offset_point(3)), (std::array{0.0f, 0.02f, 0.0f}));
}

TEST(SupgLayout, GivesEveryQueryAPointOfItsOwn) {
  SupgLayoutSettings settings;
  settings.leg_coordinates = {1, 2, 3, 4, 5, 6};
  settings.type_coordinates = {-1, 1};
  const SupgLayout layout(settings, 6, 2, 7);
  std::set<int> points;
  for (int leg = 0; leg < 6; ++leg) {
    points.insert(layout.offset_point(leg));
    for (int type = 0; type < 2; ++type)
      for (int tick = 0; tick <= 7; ++tick) points.insert(layout.pattern_point(leg, type, tick));
  }
  EXPECT_EQ(points.size(), static_cast<std::size_t>(layout.points().count()));
  EXPECT_EQ(*points.begin(), 0);
  EXPECT_EQ(*points.rbegin(), layout.points().count() - 1);
}

std::string complaint(int legs, int types) {
  try {
    const SupgLayout layout(SupgLayoutSettings(), legs, types, 100);
  } catch (const UserError& error) {
    return error.what();
  }
  return "none";
}

TEST(SupgLayout, RefusesARobotWithOtherNumbersOfLegsOrTypes) {
  EXPECT_EQ(complaint(4, 3), "none");
  EXPECT_EQ(complaint(6, 3), "controller.supg.layout.leg_coordinates has 4 values, but the robot has 6 legs");
  EXPECT_EQ(complaint(4, 2),
            "controller.supg.layout.type_coordinates has 3 values, but the robot has 2 joint types");
}

TEST(SupgLayoutSettings, AreReadUnderTheirNames) {
  const auto json = io::Json::parse(
      R"({"leg_axis": "y", "leg_coordinates": [0.5], "leg_divisor": 2.0, "type_coordinates": [3.0, 4.0]})");
  SupgLayoutSettings settings;
  settings.describe(*io::json_reader(io::JsonView(json, "test")));
  EXPECT_EQ(settings.leg_axis, LegAxis::y);
  EXPECT_EQ(settings.leg_coordinates, std::vector{0.5});
  EXPECT_EQ(settings.leg_divisor, 2.0);
  EXPECT_EQ(settings.type_coordinates, (std::vector{3.0, 4.0}));
}

}  // namespace
}  // namespace amble::substrate
