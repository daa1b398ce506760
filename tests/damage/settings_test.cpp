#include "amble/damage/settings.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <string>
#include <string_view>

#include "amble/core/error.hpp"
#include "amble/io/json_file.hpp"
#include "tests/damage/scene.hpp"
#include "tests/robot/legged.hpp"

namespace amble::damage {
namespace {

std::string refusal(std::vector<Part> parts) {
  const auto robot = quadruped();
  try {
    Settings{std::move(parts)}.validate(robot);
  } catch (const SettingError& error) {
    EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos) << "one line";
    return error.what();
  }
  return "accepted";
}

TEST(DamageSettings, AreRefusedWhereTheRobotHasNoSuchPart) {
  const auto robot = quadruped();
  const std::string knee = robot.joints[0].name;
  EXPECT_EQ(refusal({missing("FL"), numb("BR"), locked(knee, -0.3), slack(knee), weak(knee, 0.2),
                     payload(1.0, 0.1, 0.0, 0.0)}),
            "accepted");
  EXPECT_EQ(refusal({slack(knee), missing("FX")}),
            "damage.parts[1].leg = \"FX\": the robot has no such leg; expected one of FL, FR, BL, BR");
  EXPECT_EQ(refusal({slack("elbow")})
                .find("damage.parts[0].joint = \"elbow\": the robot has no such joint; "
                      "expected one of "),
            0u);
  EXPECT_EQ(refusal({{.kind = Kind::payload, .body = "tail"}})
                .find("damage.parts[0].body = \"tail\": the robot has no such body; expected one of "),
            0u);
  EXPECT_EQ(refusal({missing("")}).find("damage.parts[0].leg = \"\": the robot has no such leg"), 0u);
}

TEST(DamageSettings, AreRefusedWithNamesThatTheirKindDoesNotHave) {
  EXPECT_EQ(refusal({{.kind = Kind::missing, .leg = "FL", .joint = "k"}}),
            "damage.parts[0].joint = \"k\": the kind missing has no joint");
  EXPECT_EQ(refusal({{.kind = Kind::payload, .leg = "FL"}}),
            "damage.parts[0].leg = \"FL\": the kind payload has no leg");
}

TEST(DamageSettings, OfAMotorAreRefusedWhereAJointHasNone) {
  const auto robot = tests::with_passive_joint(tests::legged_robot(1));
  const std::string name = robot.joints.back().name;
  const auto refusal_of = [&](const Part& part) -> std::string {
    try {
      Settings{{part}}.validate(robot);
    } catch (const SettingError& error) {
      return error.what();
    }
    return "accepted";
  };
  EXPECT_EQ(refusal_of(slack(name)),
            "damage.parts[0].joint = \"" + name + "\": it has no motor that could be slack");
  EXPECT_EQ(refusal_of(weak(name, 0.5)),
            "damage.parts[0].joint = \"" + name + "\": it has no motor that could be weak");
  EXPECT_EQ(refusal_of(locked(name, 0.0)), "accepted");
}

TEST(DamageSettings, AreRefusedBeyondAJointsStopsAndWithoutAnyLeg) {
  const auto robot = quadruped();
  const auto& knee = robot.joints[0];
  EXPECT_NE(refusal({locked(knee.name, knee.upper_rad + 0.1)}).find("damage.parts[0].angle_rad = "),
            std::string::npos);
  EXPECT_EQ(refusal({missing("FL"), missing("FR"), missing("BL"), missing("BR", 5.0)}),
            "damage.parts: no leg is left; expected at least one that is not missing");
}

TEST(DamageSettings, PutAPayloadOnEitherSideOfTheBody) {
  for (const char* key : {"x_m", "y_m", "z_m"})
    for (const double place_m : {-100.0, -0.25, 0.25, 100.0}) {
      io::Json json = io::settings_to_json(Part{.kind = Kind::payload});
      json[key] = place_m;
      const auto part = io::settings_from_json<Part>(io::JsonView(json, "text"));
      EXPECT_EQ(key[0] == 'x' ? part.x_m : key[0] == 'y' ? part.y_m : part.z_m, place_m);
    }
}

TEST(DamageSettings, KnowWhatTheyChange) {
  EXPECT_TRUE(Settings{}.is_default());
  EXPECT_FALSE(Settings{{numb("FL")}}.is_default());
  EXPECT_FALSE(Settings{{numb("FL")}}.changes_body());
  EXPECT_TRUE((Settings{{numb("FL"), slack("k")}}.changes_body()));
}

TEST(DamageSettings, SurviveJson) {
  Settings settings{{missing("FL", 2.5), locked("k", -0.25), payload(2.0, 0.1, -0.2, 0.3, 1.0)}};
  const io::Json json = io::settings_to_json(settings);
  auto back = io::settings_from_json<Settings>(io::JsonView(json, "test"));
  EXPECT_EQ(io::settings_to_json(back), json);
  ASSERT_EQ(back.parts.size(), 3u);
  EXPECT_EQ(back.parts[0].from_s, 2.5);
  EXPECT_EQ(back.parts[1].kind, Kind::locked);
  EXPECT_EQ(back.parts[2].y_m, -0.2);
}

TEST(DamageSettings, HaveTheNamesOfTheirKindAndNoOther) {
  const auto robot = quadruped();
  // By kind: which of leg, joint and body it names.
  const std::map<Kind, std::string> named{{Kind::missing, "leg"}, {Kind::locked, "joint"},
                                          {Kind::slack, "joint"}, {Kind::weak, "joint"},
                                          {Kind::numb, "leg"},    {Kind::payload, "body"}};
  for (const auto& [kind, own] : named)
    for (const std::string key : {"leg", "joint", "body"}) {
      Part part{.kind = kind};
      const auto name = [&](const std::string& what) {
        if (what == "leg") part.leg = "FL";
        if (what == "joint") part.joint = robot.joints[0].name;
        if (what == "body") part.body = robot.bodies[1].name;
      };
      name(own);
      name(key);
      const std::string_view word = kind_names[static_cast<std::size_t>(kind)];
      if (key == own)
        EXPECT_EQ(refusal({part}), "accepted") << word;
      else
        EXPECT_NE(refusal({part}).find(fmt::format(": the kind {} has no {}", word, key)), std::string::npos)
            << word << " " << key;
    }
  EXPECT_EQ(refusal({{.kind = Kind::payload}}), "accepted") << "of the root";
  for (const Kind kind : {Kind::locked, Kind::slack, Kind::weak})
    EXPECT_EQ(refusal({{.kind = kind}}).find("damage.parts[0].joint = \"\": the robot has no such joint"),
              0u);
}

TEST(DamageSettings, LockJointsAtTheirStopsButNotBeyond) {
  const auto robot = quadruped();
  for (const auto& joint : robot.joints) {
    EXPECT_EQ(refusal({locked(joint.name, joint.lower_rad), locked(joint.name, joint.upper_rad)}),
              "accepted");
    EXPECT_NE(refusal({locked(joint.name, joint.lower_rad - 1e-9)}), "accepted");
    EXPECT_NE(refusal({locked(joint.name, joint.upper_rad + 1e-9)}), "accepted");
    EXPECT_EQ(refusal({slack(joint.name), {.kind = Kind::weak, .joint = joint.name, .angle_rad = 900.0}}),
              "accepted")
        << "the angle is of locked joints alone";
  }
}

TEST(DamageSettings, HaveAPartsDefaultsAndLimitsInTheirDescription) {
  const Part part;
  EXPECT_EQ(part.share, 0.5);
  EXPECT_EQ(part.mass_kg, 1.0);
  for (const double number : {part.angle_rad, part.x_m, part.y_m, part.z_m, part.from_s})
    EXPECT_EQ(number, 0.0);
  const auto accepted = [](const char* key, double value) {
    io::Json json = io::settings_to_json(Part{.kind = Kind::payload});
    json[key] = value;
    try {
      io::settings_from_json<Part>(io::JsonView(json, "text"));
    } catch (const UserError&) {
      return false;
    }
    return true;
  };
  struct Bounds {
    const char* key;
    double least, most;
  };
  for (const auto& [key, least, most] : {Bounds{"angle_rad", -1000.0, 1000.0},
                                         {"share", 0.0, 1.0},
                                         {"mass_kg", 1e-9, 1e6},
                                         {"x_m", -100.0, 100.0},
                                         {"y_m", -100.0, 100.0},
                                         {"z_m", -100.0, 100.0},
                                         {"from_s", 0.0, 1e9}}) {
    EXPECT_TRUE(accepted(key, least) && accepted(key, most)) << key;
    EXPECT_FALSE(accepted(key, std::nextafter(least, -HUGE_VAL))) << key;
    EXPECT_FALSE(accepted(key, std::nextafter(most, HUGE_VAL))) << key;
  }
}

}  // namespace
}  // namespace amble::damage
