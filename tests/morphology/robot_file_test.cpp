#include "amble/morphology/robot_file.hpp"

#include <gtest/gtest.h>

#include <string>

#include "amble/morphology/model_parts.hpp"
#include "amble/robot/pose.hpp"
#include "tests/morphology/files.hpp"

namespace amble::morphology {
namespace {

TEST(LoadRobot, PutsJointsIntoControlOrderWhateverTheModelsOrder) {
  const Files files;
  const robot::RobotSpec robot =
      load_one_leg(files, one_leg_xml, with(one_leg_toml, R"(["hip", "knee"])", R"(["knee", "hip"])"));
  ASSERT_EQ(robot.joints.size(), 2u);
  EXPECT_EQ(robot.joints[0].name, "A_knee");
  EXPECT_EQ(robot.joints[1].name, "A_hip");
  ASSERT_EQ(robot.legs.size(), 1u);
  EXPECT_EQ(robot.legs[0].joints, (std::vector<int>{0, 1}));
  EXPECT_EQ(robot.geoms[static_cast<std::size_t>(robot.legs[0].foot_geoms[0])].name, "A_foot");
  EXPECT_EQ(robot.name, "one leg");
}

TEST(LoadRobot, TakesNamesByPatternOrOneByOne) {
  const Files files;
  std::string xml = with(with(one_leg_xml, "A_hip", "joint_hip_of_A"), "A_knee", "gelenk");
  xml = with(xml, "A_foot", "sole_A");
  const robot::RobotSpec robot = load_one_leg(files, xml, one_leg_toml + R"(
[names]
joint = "joint_{type}_of_{leg}"
foot = "sole_{leg}"
[names.A]
knee = "gelenk"
)");
  EXPECT_EQ(robot.joints[0].name, "joint_hip_of_A");
  EXPECT_EQ(robot.joints[1].name, "gelenk");
}

TEST(LoadRobot, AllowsARobotWithoutLegs) {
  const robot::RobotSpec robot = load_robot(AMBLE_SOURCE_DIR "/scenes/box.toml");
  EXPECT_TRUE(robot.joints.empty());
  EXPECT_TRUE(robot.legs.empty());
}

TEST(LoadRobot, RaisesTheRootToTheStartHeight) {
  const Files files;
  const robot::RobotSpec robot = load_one_leg(files, one_leg_xml, "start_height_m = 0.96\n" + one_leg_toml);
  EXPECT_EQ(robot.bodies[0].position_m.z, 0.96);
  EXPECT_NEAR(robot::start_clearance_m(robot, robot.legs[0].foot_geoms[0]), 0.0, 1e-15);
}

TEST(LoadRobot, TurnsTheRootByAnglesOrAQuaternion) {
  const Files files;
  const std::string name = "name = \"one leg\"\n";
  const auto forward = [&](const std::string& line) {
    const auto robot = load_one_leg(files, one_leg_xml, with(one_leg_toml, name, name + line + "\n"));
    return rotate(robot.bodies[0].rotation, Vec3{1.0, 0.0, 0.0});
  };
  const auto expect = [](Vec3 is, Vec3 expected) { EXPECT_LT(norm(is - expected), 1e-12); };
  expect(forward("start_rpy_deg = [0, 0, -90]"), {0.0, -1.0, 0.0});
  expect(forward("start_rpy_deg = [0, 0, 180]"), {-1.0, 0.0, 0.0});
  // About the world's axes in this order: x, which leaves it, y, then z.
  expect(forward("start_rpy_deg = [30, 0, 90]"), {0.0, 1.0, 0.0});
  const auto tilted =
      load_one_leg(files, one_leg_xml, with(one_leg_toml, name, name + "start_rpy_deg = [30, 0, 0]\n"));
  const Vec3 up = rotate(tilted.bodies[0].rotation, Vec3{0.0, 0.0, 1.0});
  expect(up, {0.0, -0.5, std::sqrt(0.75)});
  // A quaternion may have any length.
  expect(forward("start_quaternion = [2, 0, 0, 2]"), {0.0, 1.0, 0.0});
  EXPECT_EQ(load_one_leg(files).bodies[0].rotation, Quat{});
}

TEST(LoadRobot, RefusesARotationThatIsNone) {
  const Files files;
  const std::string name = "name = \"one leg\"\n";
  const auto error = [&](const std::string& lines) {
    return files.error_of(
        [&] { load_one_leg(files, one_leg_xml, with(one_leg_toml, name, name + lines + "\n")); });
  };
  EXPECT_EQ(error("start_rpy_deg = [0, 90]"),
            "one_leg.toml:2: 'start_rpy_deg': expected [roll, pitch, yaw] in degrees");
  for (const char* numbers : {"[0, 0, 0, 0]", "[1, 0, 0]"})
    EXPECT_EQ(error(fmt::format("start_quaternion = {}", numbers)),
              "one_leg.toml:2: 'start_quaternion': expected [w, x, y, z], not all 0");
  EXPECT_EQ(error("start_rpy_deg = [0, 0, 0]\nstart_quaternion = [1, 0, 0, 0]"),
            "one_leg.toml:3: 'start_quaternion': expected only one of it and 'start_rpy_deg'");
}

TEST(LoadRobot, RefusesWhereModelAndSideFileDisagree) {
  const Files files;
  const auto error_of = [&](std::string_view from, std::string_view to) {
    return files.error_of([&] { load_one_leg(files, one_leg_xml, with(one_leg_toml, from, to)); });
  };
  EXPECT_EQ(error_of(R"(["hip", "knee"])", R"(["hip", "ankle"])"),
            "one_leg.toml: leg 'A' needs a joint 'A_ankle' (ankle), but one_leg.xml has: A_hip, A_knee");
  EXPECT_EQ(error_of(R"(["hip", "knee"])", R"(["hip"])"),
            "one_leg.toml: joint 'A_knee' of one_leg.xml belongs to no leg: name every joint by legs and "
            "joint_types, or in held = [...] (its servo holds it), passive = [...] (it has no motor) or "
            "fixed = [...] (welded)");
  EXPECT_EQ(error_of(R"(["A"])", R"(["A", "B"])"),
            "one_leg.toml: leg 'B' needs a joint 'B_hip' (hip), but one_leg.xml has: A_hip, A_knee");
  EXPECT_EQ(error_of("[servo]", "[names]\njoint = \"A_hip\"\n[servo]"),
            "one_leg.toml: joint 'A_hip' is named twice");
  EXPECT_EQ(
      error_of("[servo]", "[names]\nfoot = \"{leg}_toe\"\n[servo]"),
      "one_leg.toml: leg 'A' needs a foot geom 'A_toe', but one_leg.xml has: torso, thigh, shin, A_foot");
  EXPECT_EQ(error_of("[servo]", "[names.A]\nfoot = \"torso\"\n[servo]"),
            "one_leg.toml: leg 'A': its foot 'torso' is on body 'torso', which none of its joints moves");
}

TEST(LoadRobot, RefusesAStartPoseOutsideTheRangeOrUnderground) {
  const Files files;
  const auto error_of = [&](std::string_view from, std::string_view to) {
    return files.error_of([&] { load_one_leg(files, with(one_leg_xml, from, to)); });
  };
  EXPECT_EQ(error_of("range=\"-0.7 0\"", "range=\"-0.7 -0.1\""),
            "one_leg.toml: joint 'A_knee': the start pose, angle 0, lies outside its range -0.7 … -0.1 rad");
  EXPECT_EQ(
      error_of("pos=\"0 0 1\"", "pos=\"0 0 0.9\""),
      "one_leg.toml: foot 'A_foot' starts 0.060 m below the ground: raise the root, or set start_height_m");
  EXPECT_EQ(error_of("name=\"A_foot\"", "name=\"A_foot\" contype=\"0\" conaffinity=\"0\""),
            "one_leg.toml: leg 'A' has a foot that cannot collide");
}

TEST(LoadRobot, WantsTheTomlFileNotTheModel) {
  const Files files;
  const auto path = files.write("one_leg.xml", one_leg_xml);
  EXPECT_EQ(
      files.error_of([&] { load_robot(path); }),
      "one_leg.xml: the model of a robot, and not a robot file (TOML that names a model; robots/README.md); "
      "to make a robot of it, run: amble robot --init one_leg.xml");
}

TEST(LoadRobot, SaysWhichFileIsMissing) {
  const Files files;
  const std::string line = files.error_of(
      [&] { load_robot(files.write("r.toml", with(one_leg_toml, "one_leg.xml", "gone.xml"))); });
  EXPECT_EQ(line.find("gone.xml: "), 0u) << line;
  EXPECT_EQ(files.error_of([&] { load_robot(files.path("absent.toml")); }).find("absent.toml: "), 0u);
}

TEST(LoadRobot, KeepsCommandsWithinTheStopsWhateverIsRounded) {
  // The model counts from a reference, the robot from its start pose: both ends are differences.
  const Files files;
  for (int i = 0; i < 50; ++i) {
    const double reference = -0.7 + 0.0137 * i, by = i % 2 == 0 ? 0.0 : 9e-10;
    const std::string xml =
        with(one_leg_xml, R"(range="-0.7 0")", fmt::format(R"(range="-0.7 0" ref="{}")", reference));
    const auto robot = load_one_leg(files, xml,
                                    one_leg_toml + fmt::format("[command]\nhip = [{}, {}]\nknee = [{}, {}]\n",
                                                               -0.5 - by, 0.5 + by, -0.7 - by, by));
    for (const robot::Joint& joint : robot.joints) {
      EXPECT_GE(joint.command->lower_rad, joint.lower_rad);
      EXPECT_LE(joint.command->upper_rad, joint.upper_rad);
      EXPECT_NEAR(joint.command->lower_rad, joint.lower_rad, 2e-9);
      EXPECT_NEAR(joint.command->upper_rad, joint.upper_rad, 2e-9);
    }
  }
}

TEST(LoadRobot, LeavesPassiveJointsWithoutAMotorAndWithTheirSpring) {
  const Files files;
  const std::string xml =
      with(one_leg_xml, R"(range="-0.7 0")", R"(range="-0.7 0" stiffness="3" springref="-0.2")");
  const std::string toml = with(one_leg_toml, R"(joint_types = ["hip", "knee"])",
                                "joint_types = [\"hip\"]\npassive = [\"A_knee\"]");
  const robot::RobotSpec robot = load_one_leg(files, xml, toml);
  ASSERT_EQ(robot.joints.size(), 2u);
  EXPECT_TRUE(robot.joints[0].driven());
  EXPECT_FALSE(robot.joints[1].has_motor());
  EXPECT_FALSE(robot.joints[1].driven());
  EXPECT_EQ(robot.joints[1].stiffness_nm_per_rad, 3.0);
  EXPECT_EQ(robot.joints[1].rest_rad, -0.2);
  const auto error_of = [&](const std::string& text) {
    return files.error_of([&] { load_one_leg(files, xml, text); });
  };
  EXPECT_EQ(error_of(with(toml, "[\"A_knee\"]", "[\"A_knie\"]"))
                .find("one_leg.toml: 'passive' names a joint 'A_knie'"),
            0u);
  EXPECT_EQ(error_of(with(one_leg_toml, "fall_height", "passive = [\"A_knee\"]\nfall_height")),
            "one_leg.toml: joint 'A_knee' is named twice");
}

TEST(LoadRobot, GivesAJointOfPlayAboutAnothersAxisAnInertia) {
  const Files files;
  const auto armature = [&](const std::string& attributes) {
    const std::string knee =
        R"(<joint name="A_knee" type="hinge" axis="0 1 0" limited="true" range="-0.7 0"/>)";
    const std::string xml = with(one_leg_xml, knee, knee + R"(<joint name="A_play" )" + attributes + "/>");
    return load_one_leg(files, xml, "passive = [\"A_play\"]\n" + one_leg_toml).joints[2].armature_kg_m2;
  };
  // The shin: a cylinder of 0.5 kg, 0.4 m long, and a ball of 0.25 kg at its end.
  const double inertia = 0.5 * (0.04 * 0.04 / 4 + 0.4 * 0.4 / 3) + 0.25 * (0.4 * 0.06 * 0.06 + 0.16);
  EXPECT_NEAR(armature(R"(axis="0 1 0" range="-1 1")"), 1e-3 * inertia, 1e-9);
  EXPECT_EQ(armature(R"(axis="0 1 0" range="-1 1" armature="0.002")"), 0.002);
  EXPECT_EQ(armature(R"(axis="1 0 0" range="-1 1")"), 0.0);
  EXPECT_EQ(armature(R"(axis="0 1 0" pos="0 0 -.1" range="-1 1")"), 0.0);
}

TEST(LoadRobot, TakesSeveralShapesOfAFoot) {
  const Files files;
  const robot::RobotSpec robot =
      load_one_leg(files, one_leg_xml, one_leg_toml + "[names]\nfoot = [\"{leg}_foot\", \"shin\"]\n");
  ASSERT_EQ(robot.legs[0].foot_geoms.size(), 2u);
  EXPECT_EQ(robot.geoms[static_cast<std::size_t>(robot.legs[0].foot_geoms[1])].name, "shin");
  EXPECT_EQ(
      files.error_of([&] {
        load_one_leg(files, one_leg_xml, one_leg_toml + "[names]\nfoot = [\"A_foot\", \"A_toe\"]\n");
      }),
      "one_leg.toml: leg 'A' needs a foot geom 'A_toe', but one_leg.xml has: torso, thigh, shin, A_foot");
}

TEST(LoadRobot, PassesOnTheNotesOfTheModelsParts) {
  const Files files;
  files.write("one_leg.xml", with(with(one_leg_xml, "<freejoint name=\"root\"/>", ""), R"(range="-0.7 0")",
                                  R"(range="-0.7 0" stiffness="3")"));
  ReadingNotes notes;
  notes.add(Reading::kept, "from before");
  load_robot(files.write("one_leg.toml", one_leg_toml), &notes);
  const ReadingNotes of_parts = extract_parts(compile_model(files.path("one_leg.xml"))).notes;
  ASSERT_EQ(of_parts.lines().size(), 2u);
  ASSERT_EQ(notes.lines().size(), 4u);
  for (std::size_t i = 0; i < 2; ++i) EXPECT_EQ(notes.lines()[i + 1].text, of_parts.lines()[i].text);
  EXPECT_EQ(notes.lines()[3].text, "the springs of joints with a motor: 'A_knee'");
}

}  // namespace
}  // namespace amble::morphology
