#include "amble/ground/settings.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "amble/core/error.hpp"
#include "amble/core/random.hpp"
#include "amble/ground/recorded.hpp"

namespace amble::ground {
namespace {

std::string refusal(const std::function<void(Settings&)>& change) {
  Settings settings;
  settings.kind = "stones";
  change(settings);
  try {
    settings.validate();
  } catch (const UserError& error) {
    return error.what();
  }
  return "accepted";
}

TEST(GroundSettings, AreRefusedWhereTheyContradictEachOther) {
  EXPECT_EQ(refusal([](Settings&) {}), "accepted");
  EXPECT_EQ(refusal([](Settings& s) { s.length_m = 0.05; }),
            "ground.length_m = 0.05: expected at least two cells of 0.04 m (ground.cell_m)");
  EXPECT_NE(refusal([](Settings& s) { s.start_radius_m = 5.2; }).find("expected a larger ground.cell_m"),
            std::string::npos);
  EXPECT_EQ(refusal([](Settings& s) { s.friction = -0.5; }),
            "ground.friction = -0.5: expected 0 or more, or -1 for the robot's own");
  EXPECT_EQ(refusal([](Settings& s) {
              s.kind = "plane";
              s.length_m = 0.05;
            }),
            "accepted");
}

TEST(GroundSettings, KnowWhetherTheyAreTheDefault) {
  Settings settings;
  EXPECT_TRUE(settings.is_default());
  settings.slope_y = 0.1;
  EXPECT_FALSE(settings.is_default());
}

TEST(GroundSettings, ASlopeKeepsGravitysMagnitudeAndLeansItDownhill) {
  Settings settings;
  EXPECT_EQ(settings.tilted({0.0, 0.0, -9.8}), (Vec3{0.0, 0.0, -9.8}));
  settings.slope_x = std::tan(0.2);
  const Vec3 gravity = settings.tilted({0.0, 0.0, -9.8});
  EXPECT_NEAR(gravity.x, -9.8 * std::sin(0.2), 1e-12);
  EXPECT_NEAR(gravity.z, -9.8 * std::cos(0.2), 1e-12);
  settings.slope_y = 0.3;
  EXPECT_NEAR(norm(settings.tilted({0.0, 0.0, -9.8})), 9.8, 1e-12);
  EXPECT_THROW(settings.tilted({2.0, 0.0, -9.6}), SettingError) << "it leans already";
}

TEST(RecordedGround, IsTheFieldAgain) {
  Settings settings;
  settings.kind = "hills";
  settings.vary = Vary::generations;
  const Key key{.seed = 7, .generation = 40, .set = 1};
  const io::Json json = to_json(settings, key);
  EXPECT_EQ(field_from_json(io::JsonView(json, "test")).heights_m(), make_field(settings, key).heights_m());
}

TEST(GroundSettings, AreAcceptedWhereTheGroundHasAStepOrObstacle) {
  Stream stream(1, Purpose::test);
  int refused = 0;
  for (int n = 0; n < 60; ++n) {
    Settings settings;
    settings.kind = n % 2 == 0 ? "stairs" : "hurdles";
    settings.height_m = 0.1;
    settings.length_m = stream.uniform(0.1, 6.0);
    settings.start_radius_m = stream.uniform(0.0, 6.0);
    const double needed_m = settings.start_radius_m + settings.length_m;
    if (std::abs(needed_m - 128 * settings.cell_m) < 2.0 * settings.cell_m) continue;
    try {
      settings.validate();
      EXPECT_NEAR(std::min(0.1f, make_field(settings, {}).highest_m()), 0.1, 1e-6) << needed_m;
    } catch (const UserError&) {
      EXPECT_GT(needed_m, 128 * settings.cell_m);
      ++refused;
    }
  }
  EXPECT_GT(refused, 10);
}

TEST(RecordedGround, RefusesKeysThatNoGroundHas) {
  Settings settings;
  settings.kind = "hills";
  const Key key{.seed = 7, .generation = 40, .set = 1};
  const auto reads = [&](const char* name, const io::Json& value) {
    io::Json json = to_json(settings, key);
    json["key"][name] = value;
    try {
      field_from_json(io::JsonView(json, "test"));
    } catch (const UserError&) {
      return false;
    }
    return true;
  };
  for (const char* name : {"generation", "set"}) {
    for (const io::Json& value : {io::Json(-1), io::Json(0x1p32), io::Json(1ll << 32), io::Json(0.5),
                                  io::Json("1"), io::Json(nullptr)})
      EXPECT_FALSE(reads(name, value)) << name << " " << value;
    for (const io::Json& value : {io::Json(0), io::Json((1ll << 32) - 1)})
      EXPECT_TRUE(reads(name, value)) << value;
  }
}

TEST(GroundSettings, DrawTheirLimitsWhereTheMessagesSay) {
  const auto accepted = [](const std::string& kind, double length_m, double start_radius_m) {
    const double scale = kind == "hurdles" ? 0.25 : 1.0;  // whose walls are thin
    return refusal([=](Settings& s) {
             s.kind = kind;
             s.cell_m = 0.25 * scale;  // the ground repeats after 64 m
             s.length_m = length_m * scale;
             s.start_radius_m = start_radius_m * scale;
           }) == "accepted";
  };
  for (const std::string kind : {"hills", "rough", "stones", "blocks", "stairs", "hurdles"}) {
    EXPECT_TRUE(accepted(kind, 0.5, 0.0)) << "two cells";
    EXPECT_FALSE(accepted(kind, 0.49, 0.0));
  }
  for (const std::string kind : {"hills", "rough", "stones", "blocks"}) {
    EXPECT_TRUE(accepted(kind, 32.0, 32.0)) << "the larger of both fits";
    EXPECT_FALSE(accepted(kind, 32.1, 0.0));
    EXPECT_FALSE(accepted(kind, 1.0, 32.1));
  }
  for (const std::string kind : {"stairs", "hurdles"}) {
    EXPECT_TRUE(accepted(kind, 12.0, 20.0)) << "both together fit";
    EXPECT_FALSE(accepted(kind, 12.1, 20.0));
  }
  for (const std::string kind : {"plane", "stones"}) {
    const auto with_friction = [kind](double friction) {
      return refusal([=](Settings& s) {
               s.kind = kind;
               s.friction = friction;
             }) == "accepted";
    };
    EXPECT_TRUE(with_friction(0.0));
    EXPECT_TRUE(with_friction(-1.0));
    EXPECT_FALSE(with_friction(-1e-9));
    EXPECT_FALSE(with_friction(-0.999));
  }
}

TEST(GroundSettings, LeanAlongXAndYEachByItsOwnSlope) {
  Settings settings;
  settings.slope_y = 0.75;  // 3 : 4 : 5
  EXPECT_EQ(settings.tilted({0.0, 0.0, -10.0}), (Vec3{0.0, -6.0, -8.0}));
  settings.slope_y = 0.0;
  settings.slope_x = 0.75;
  EXPECT_EQ(settings.tilted({0.0, 0.0, -10.0}), (Vec3{-6.0, 0.0, -8.0}));
}

}  // namespace
}  // namespace amble::ground
