#include "amble/morphology/side_file.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "amble/io/file.hpp"
#include "amble/io/toml_settings.hpp"
#include "tests/morphology/files.hpp"

namespace amble::morphology {
namespace {

SideFile read(const Files& files, const std::string& text) {
  return read_side_file(files.write("s.toml", text));
}

TEST(SideFile, GivesEveryJointTheCommonServo) {
  const Files files;
  const SideFile side = read(files, one_leg_toml);
  ASSERT_EQ(side.servos.size(), 2u);
  for (const robot::Servo& servo : side.servos) {
    EXPECT_EQ(servo.mode, robot::ServoMode::velocity);
    EXPECT_EQ(servo.gain_per_s, 9.0);
    EXPECT_EQ(servo.max_torque_nm, 5.0);
    EXPECT_EQ(servo.kp_nm_per_rad, 0.0);
  }
  EXPECT_TRUE(std::isinf(side.contact.friction));
  EXPECT_EQ(side.contact.cfm_s_per_kg, 1e-4);
  EXPECT_EQ(side.contact.sweeps, 0);
  EXPECT_EQ(side.model, files.path("one_leg.xml"));
}

TEST(SideFile, MaySayHowOftenTheSolverSweeps) {
  const Files files;
  const std::string line = "cfm_s_per_kg = 1e-4\n";
  EXPECT_EQ(read(files, with(one_leg_toml, line, line + "sweeps = 80\n")).contact.sweeps, 80);
  const std::string text =
      files.error_of([&] { read(files, with(one_leg_toml, line, line + "sweeps = 1001\n")); });
  EXPECT_NE(text.find("'contact.sweeps'"), std::string::npos) << text;
}

TEST(SideFile, TakesAFootOfOneShapeOrOfSeveral) {
  using Names = std::vector<std::string>;
  const Files files;
  const std::string two = with(one_leg_toml, R"(["A"])", R"(["A", "B"])");
  const auto feet = [&](const std::string& text) {
    std::vector<Names> all;
    for (const LegNames& leg : read(files, text).names) all.push_back(leg.foot);
    return all;
  };
  EXPECT_EQ(feet(two), (std::vector<Names>{{"A_foot"}, {"B_foot"}}));
  EXPECT_EQ(feet(two + "[names]\nfoot = [\"{leg}_heel\", \"{leg}_toe\"]\n[names.B]\nfoot = \"ball\"\n"),
            (std::vector<Names>{{"A_heel", "A_toe"}, {"ball"}}));
  EXPECT_EQ(feet(two + "[names.A]\nfoot = [\"x\", \"y\", \"z\"]\n"),
            (std::vector<Names>{{"x", "y", "z"}, {"B_foot"}}));
  const auto error_of = [&](const std::string& value) {
    return files.error_of([&] { read(files, two + "[names.A]\nfoot = " + value + "\n"); });
  };
  EXPECT_EQ(error_of("[]"), "s.toml:18: 'names.A.foot' = []: expected a geom, or a list of geoms");
  EXPECT_NE(error_of("3").find("'names.A.foot'"), std::string::npos) << error_of("3");
  EXPECT_NE(error_of("[1, 2]").find("'names.A.foot'"), std::string::npos) << error_of("[1, 2]");
}

TEST(SideFile, RefusesAJointThatIsBothHeldAndPassive) {
  const Files files;
  EXPECT_EQ(read(files, "passive = [\"tail\"]\n" + one_leg_toml).passive, std::vector<std::string>{"tail"});
  EXPECT_EQ(files.error_of([&] { read(files, "held = [\"t\"]\npassive = [\"t\"]\n" + one_leg_toml); }),
            "s.toml:2: 'passive' and 'held' both name 't'");
}

TEST(SideFile, LetsTypesAndSingleJointsHaveTheirOwnServo) {
  const Files files;
  const SideFile side = read(files, with(one_leg_toml, R"(["A"])", R"(["A", "B"])") + R"(
[servo_of.knee]
max_torque_nm = 7.0
[servo_of.B.knee]
mode = "torque"
kp_nm_per_rad = 30.0
kd_nm_s_per_rad = 0.5
)");
  ASSERT_EQ(side.servos.size(), 4u);
  EXPECT_EQ(side.servos[0].max_torque_nm, 5.0);
  EXPECT_EQ(side.servos[1].max_torque_nm, 7.0);
  EXPECT_EQ(side.servos[1].mode, robot::ServoMode::velocity);
  EXPECT_EQ(side.servos[2].max_torque_nm, 5.0);
  EXPECT_EQ(side.servos[3].max_torque_nm, 7.0);
  EXPECT_EQ(side.servos[3].mode, robot::ServoMode::torque);
  EXPECT_EQ(side.servos[3].kp_nm_per_rad, 30.0);
  EXPECT_EQ(side.servos[3].kd_nm_s_per_rad, 0.5);
  EXPECT_EQ(side.servos[3].gain_per_s, 0.0);
}

TEST(SideFile, HasNoDefaultForAnyPhysicalNumber) {
  const Files files;
  for (const char* line :
       {"fall_height_m = 0.5\n", "gain_per_s = 9.0\n", "max_torque_nm = 5.0\n", "friction = inf\n",
        "erp = 0.1\n", "cfm_s_per_kg = 1e-4\n", "model = \"one_leg.xml\"\n"}) {
    const std::string text = files.error_of([&] { read(files, with(one_leg_toml, line, "")); });
    EXPECT_EQ(text.find("s.toml: '"), 0u) << text;
    EXPECT_NE(text.find("' is missing"), std::string::npos) << text;
    const std::string key = std::string(line).substr(0, std::string_view(line).find(' '));
    EXPECT_NE(text.find(key), std::string::npos) << text;
  }
  EXPECT_EQ(files.error_of([&] { read(files, with(one_leg_toml, "\"velocity\"", "\"torque\"")); }),
            "s.toml: 'servo.kp_nm_per_rad' is missing: expected a number");
}

TEST(SideFile, RefusesNamesThatClash) {
  const Files files;
  const auto error_of = [&](std::string_view from, std::string_view to) {
    return files.error_of([&] { read(files, with(one_leg_toml, from, to)); });
  };
  EXPECT_EQ(error_of(R"(["A"])", R"(["A", "A"])"), "s.toml:3: 'legs' names 'A' twice");
  EXPECT_EQ(error_of(R"("knee"])", R"("foot"])"), "s.toml:4: 'joint_types' must not use the name 'foot'");
  EXPECT_EQ(error_of(R"(["A"])", R"([""])"), "s.toml:3: 'legs' must not use the name ''");
  EXPECT_EQ(error_of(R"(["A"])", R"(["hip"])"), "s.toml:3: 'legs' and 'joint_types' both name 'hip'");
  // Tables servo_of.NAME are those of types, legs and held joints.
  for (const auto& [name, key] : {std::pair{"A", "legs"}, {"hip", "joint_types"}, {"knee", "joint_types"}})
    EXPECT_EQ(error_of("fall_height_m", fmt::format("held = [\"{}\"]\nfall_height_m", name)),
              fmt::format("s.toml:5: 'held' and '{}' both name '{}'", key, name));
}

TEST(SideFile, NamesTheLineOfABadValue) {
  const Files files;
  const auto error_of = [&](std::string_view from, std::string_view to) {
    return files.error_of([&] { read(files, with(one_leg_toml, from, to)); });
  };
  EXPECT_EQ(error_of("erp = 0.1", "erp = 1.5").find("s.toml:15: 'contact.erp'"), 0u)
      << error_of("erp = 0.1", "erp = 1.5");
  EXPECT_EQ(error_of("gain_per_s = 9.0", "gain_per_s = \"fast\"").find("s.toml:10: 'servo.gain_per_s'"), 0u);
  EXPECT_EQ(error_of("mode = \"velocity\"", "mode = \"position\"").find("s.toml:9: 'servo.mode'"), 0u);
  EXPECT_EQ(error_of("erp = 0.1", "epr = 0.1").find("s.toml:15: unknown key 'contact.epr'"), 0u)
      << error_of("erp = 0.1", "epr = 0.1");
  EXPECT_EQ(error_of("friction = inf", "friction = nan").find("s.toml:14: 'contact.friction'"), 0u);
  EXPECT_EQ(error_of("max_torque_nm = 5.0", "max_torque_nm = inf").find("s.toml:11: 'servo.max_torque_nm'"),
            0u);
}

TEST(SideFile, FillsInPatternsWhereverAndHoweverOftenTheirMarksStand) {
  const Files files;
  const std::string toml =
      with(one_leg_toml, R"(["A"])", R"(["A", "BB"])") +
      "[names]\njoint = \"{leg}{type}_{leg}_{type}{leg}\"\nfoot = \"{leg}{leg}.{leg}\"\n";
  const SideFile side = read(files, toml);
  EXPECT_EQ(side.names[0].joints, (std::vector<std::string>{"Ahip_A_hipA", "Aknee_A_kneeA"}));
  EXPECT_EQ(side.names[1].joints, (std::vector<std::string>{"BBhip_BB_hipBB", "BBknee_BB_kneeBB"}));
  EXPECT_EQ(side.names[0].foot, std::vector<std::string>{"AA.A"});
  EXPECT_EQ(side.names[1].foot, std::vector<std::string>{"BBBB.BB"});
}

TEST(SideFile, TakesNumbersToTheEndsOfTheirRanges) {
  const Files files;
  const auto accepted = [&](std::string_view key, std::string_view old, std::string_view value) {
    const std::string was = std::string(key) + " = " + std::string(old) + "\n";
    const std::string line = std::string(key) + " = " + std::string(value) + "\n";
    const std::string text = files.error_of([&] { read(files, with(one_leg_toml, was, line)); });
    EXPECT_TRUE(text == "accepted" || text.find(key) != std::string::npos) << text;
    return text == "accepted";
  };
  struct Case {
    const char *key, *old, *least, *most, *below, *beyond;
  };
  for (const auto& [key, old, least, most, below, beyond] :
       {Case{"erp", "0.1", "0.0", "1.0", "-0.001", "1.001"},
        {"friction", "inf", "0.0", "inf", "-0.001", "nan"},
        {"cfm_s_per_kg", "1e-4", "0.0", "1e308", "-1e-9", "inf"},
        {"gain_per_s", "9.0", "0.0", "1e308", "-1e-9", "inf"},
        {"max_torque_nm", "5.0", "0.0", "1e308", "-1e-9", "inf"},
        {"fall_height_m", "0.5", "-1e308", "1e308", "-inf", "inf"}}) {
    EXPECT_TRUE(accepted(key, old, least)) << key;
    EXPECT_TRUE(accepted(key, old, most)) << key;
    EXPECT_FALSE(accepted(key, old, below)) << key;
    EXPECT_FALSE(accepted(key, old, beyond)) << key;
  }
  for (const int sweeps : {0, 1000})
    EXPECT_TRUE(accepted("cfm_s_per_kg", "1e-4", fmt::format("1e-4\nsweeps = {}", sweeps))) << sweeps;
  EXPECT_NE(files
                .error_of([&] {
                  read(files, with(one_leg_toml, "cfm_s_per_kg = 1e-4", "cfm_s_per_kg = 1e-4\nsweeps = -1"));
                })
                .find("'contact.sweeps' = -1: expected a whole number from 0 to 1000"),
            std::string::npos);
}

TEST(SideFile, TakesFurtherFallsAndTorquesThatAreHeld) {
  const Files files;
  const auto read_with = [&](const std::string& was, const std::string& is) {
    return files.error_of([&] { read(files, with(one_leg_toml, was, is)); });
  };
  EXPECT_EQ(read_with("fall_height_m = 0.5", "fall_height_m = 0.5\nfall_above_m = inf\nfall_tilt_rad = 0.2"),
            "accepted");
  EXPECT_NE(read_with("fall_height_m = 0.5", "fall_height_m = 0.5\nfall_tilt_rad = -1").find("fall_tilt_rad"),
            std::string::npos);
  EXPECT_NE(read_with("gain_per_s = 9.0", "gain_per_s = 9.0\nhold_torque = true")
                .find("'servo.hold_torque' = true: expected mode = \"torque\" beside it"),
            std::string::npos);
}

TEST(SideFile, HasRangesOfCommandOfTwoRisingNumbers) {
  const Files files;
  const auto refusal = [&](const std::string& range) {
    return files.error_of([&] { read(files, one_leg_toml + "[command]\nhip = " + range + "\n"); });
  };
  EXPECT_EQ(refusal("[-0.1, 0.1]"), "accepted");
  for (const char* range : {"[0.1, 0.1]", "[0.2, 0.1]", "[0.1]", "[0.1, 0.2, 0.3]"})
    EXPECT_NE(refusal(range).find("'command.hip': expected [lower, upper] with lower below upper"),
              std::string::npos)
        << range;
}

TEST(SideFile, TakesLegsOfAnyNameAndFillsInPatternsOnce) {
  const std::string toml =
      with(with(one_leg_toml, R"(legs = ["A"])", R"(legs = ["{type}", "a.b"])"), "[contact]",
           "[names.\"a.b\"]\nfoot = ['x', 'y']\n[command.\"a.b\"]\nhip = [-1.0, 1.0]\n[contact]");
  const SideFile side = parse_side_file(toml, "x.toml");
  EXPECT_EQ(side.names[0].joints, (std::vector<std::string>{"{type}_hip", "{type}_knee"}));
  EXPECT_EQ(side.names[1].joints, (std::vector<std::string>{"a.b_hip", "a.b_knee"}));
  EXPECT_EQ(side.names[1].foot, (std::vector<std::string>{"x", "y"}));
  EXPECT_TRUE(side.commands[2].has_value());
  EXPECT_THAT(Files().error_of([&] { parse_side_file(with(toml, "[-1.0, 1.0]", "[1.0, -1.0]"), "x.toml"); }),
              testing::HasSubstr("'command.\"a.b\".hip': expected [lower, upper]"));
}

/// The first block of TOML in a page.
std::string toml_block(const std::string& page) {
  constexpr std::string_view begin = "```toml\n", end = "```\n";
  const std::size_t from = page.find(begin) + begin.size();
  return page.substr(from, page.find(end, from) - from);
}

TEST(SideFile, IsWhatTheDocsHaveAsAnExample) {
  const SideFile side =
      parse_side_file(toml_block(io::read_file(AMBLE_SOURCE_DIR "/robots/README.md")), "e.toml");
  EXPECT_EQ(side.names.at(1).joints, (std::vector<std::string>{"", "right_knee_joint"}));
  EXPECT_EQ(side.start_rad.at("right_knee_joint"), -0.4);
}

TEST(SideFile, HasATableOfAllItsKeys) {
  const std::string table = io::keys_to_markdown(describe_side_file);
  for (const char* key : {"keep_model", "names.LEG.TYPE", "servo_of.TYPE.kd_nm_s_per_rad", "command.LEG.TYPE",
                          "start_angle.JOINT", "contact.sweeps"})
    EXPECT_NE(table.find(fmt::format("| `{}` | ", key)), std::string::npos) << key;
}

}  // namespace
}  // namespace amble::morphology
