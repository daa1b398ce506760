#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "amble/core/index.hpp"
#include "amble/morphology/model_parts.hpp"
#include "amble/robot/pose.hpp"
#include "tests/morphology/files.hpp"

namespace amble::morphology {
namespace {

using testing::HasSubstr;

ModelParts read_parts(const Files& files, const std::string& text, const ReadingOptions& options = {}) {
  return extract_parts(compile_model(files.write("m.xml", text)), options);
}

/// The one-legged robot with a keyframe in which it crouches, and a second hinge on the thigh.
const std::string crouching_xml = with(
    with(one_leg_xml, "</worldbody>",
         R"(</worldbody><keyframe><key name="home" qpos="0.1 0.2 0.9 1 0 0 0 0.3 0.2 -0.6"/></keyframe>)"),
    R"(<joint name="A_hip")",
    R"(<joint name="A_roll" type="hinge" pos="0 0.02 0.01" axis="1 0 0" limited="true" range="-1 1"/><joint name="A_hip")");

/// Where the parts of a robot are in the world with its joints at these angles, counted as the spec does.
std::vector<robot::Pose> poses_of(const ModelParts& parts, const std::vector<double>& angles) {
  robot::RobotSpec robot;
  robot.bodies = parts.bodies;
  robot.joints = parts.joints;
  return robot::poses_at(robot, {parts.bodies[0].position_m, parts.bodies[0].rotation}, angles);
}

TEST(StartKeyframe, IsZeroOfAllAnglesWithoutAnotherMotion) {
  const Files files;
  const ModelParts reference = read_parts(files, crouching_xml);
  const ModelParts crouching = read_parts(files, crouching_xml, {.start_keyframe = "home"});
  EXPECT_EQ(crouching.start_rad, (std::vector<double>{0.3, 0.2, -0.6}));
  EXPECT_EQ(crouching.bodies[0].position_m, (Vec3{0.1, 0.2, 0.9}));
  EXPECT_DOUBLE_EQ(crouching.joints[2].lower_rad, -0.1);
  // Any pose of the one is the same pose of the other, its angles counted from elsewhere.
  for (const auto& by : {std::vector{0.0, 0.0, 0.0}, {0.4, 0.0, 0.0}, {0.3, -0.5, 0.2}}) {
    std::vector<double> from_reference;
    for (std::size_t j = 0; j < by.size(); ++j) from_reference.push_back(by[j] + crouching.start_rad[j]);
    auto expected = poses_of(reference, from_reference), found = poses_of(crouching, by);
    const Vec3 shift = crouching.bodies[0].position_m - reference.bodies[0].position_m;
    for (std::size_t b = 0; b < expected.size(); ++b) {
      EXPECT_NEAR(norm(expected[b].position_m + shift - found[b].position_m), 0.0, 1e-12);
      for (const Vec3 axis : {Vec3{1, 0, 0}, Vec3{0, 1, 0}})
        EXPECT_NEAR(norm(rotate(expected[b].rotation, axis) - rotate(found[b].rotation, axis)), 0.0, 1e-12);
    }
  }
}

TEST(StartKeyframe, ThatIsTheDefaultPoseChangesNoBit) {
  const Files files;
  const std::string xml = with(crouching_xml, "0.1 0.2 0.9 1 0 0 0 0.3 0.2 -0.6", "0 0 1 1 0 0 0 0 0 0");
  const ModelParts reference = read_parts(files, xml),
                   same = read_parts(files, xml, {.start_keyframe = "home"});
  for (std::size_t b = 0; b < reference.bodies.size(); ++b) {
    EXPECT_EQ(reference.bodies[b].position_m, same.bodies[b].position_m);
    EXPECT_EQ(reference.bodies[b].rotation, same.bodies[b].rotation);
  }
  for (std::size_t j = 0; j < reference.joints.size(); ++j) {
    EXPECT_EQ(reference.joints[j].axis, same.joints[j].axis);
    EXPECT_EQ(reference.joints[j].anchor_m, same.joints[j].anchor_m);
  }
}

TEST(StartPose, TakesSingleAnglesAndRefusesUnknownNames) {
  const Files files;
  const ModelParts parts = read_parts(files, crouching_xml, {"home", {{"A_knee", -0.2}}, {}});
  EXPECT_EQ(parts.start_rad, (std::vector<double>{0.3, 0.2, -0.2}));
  EXPECT_EQ(files.error_of([&] { read_parts(files, crouching_xml, {.start_keyframe = "stand"}); }),
            "m.xml: no keyframe 'stand' to start from; the model has: home");
  EXPECT_EQ(files.error_of([&] {
    read_parts(files, crouching_xml, {"", {{"knee", -0.2}}, {}});
  }),
            "m.xml: no hinge 'knee', of which a start angle is given");
}

TEST(FixedJoint, DisappearsAndItsBodyBecomesPartOfItsParent) {
  const Files files;
  const ModelParts parts =
      read_parts(files, crouching_xml, {.start_keyframe = "home", .fixed_joints = {"A_knee"}});
  ASSERT_EQ(parts.bodies.size(), 2u);
  ASSERT_EQ(parts.joints.size(), 2u);
  EXPECT_DOUBLE_EQ(parts.bodies[1].mass_kg, 1.75);
  // The foot is where the bent knee puts it: 0.4 m down the thigh, 0.4 m along the shin.
  const ModelParts moving = read_parts(files, crouching_xml, {.start_keyframe = "home"});
  const Vec3 expected = poses_of(moving, {0, 0, 0})[2] * moving.geoms[3].position_m;
  const Vec3 found = poses_of(parts, {0, 0})[1] * parts.geoms[3].position_m;
  EXPECT_NEAR(norm(expected - found), 0.0, 1e-12);
  EXPECT_NEAR(parts.geoms[3].position_m.x, 0.4 * std::sin(0.6), 1e-12);
  EXPECT_EQ(files.error_of([&] { read_parts(files, crouching_xml, {.fixed_joints = {"arm"}}); }),
            "m.xml: no joint 'arm', which is named as fixed");
}

TEST(HeldJoint, ComesAfterThoseOfLegsAndIsHeldByItsServo) {
  const Files files;
  const std::string xml = with(
      one_leg_xml, R"(<body name="thigh")",
      R"(<body name="head" pos="0.2 0 0"><joint name="neck" axis="0 1 0"/><geom size="0.1" mass="1"/></body>
              <body name="thigh")");
  const std::string toml = with(one_leg_toml, "fall_height_m", "held = [\"neck\"]\nfall_height_m") +
                           "[servo_of.neck]\nmax_torque_nm = 2.0\n";
  const robot::RobotSpec robot = load_one_leg(files, xml, toml);
  ASSERT_EQ(robot.joints.size(), 3u);
  EXPECT_EQ(robot.leg_joint_count(), 2u);
  EXPECT_EQ(robot.joints[2].name, "neck");
  EXPECT_FALSE(robot.joints[2].driven());
  EXPECT_EQ(robot.joints[2].servo.max_torque_nm, 2.0);
  EXPECT_EQ(files.error_of([&] { load_one_leg(files, xml, one_leg_toml); }),
            "one_leg.toml: joint 'neck' of one_leg.xml belongs to no leg: name every joint by legs and "
            "joint_types, or in held = [...] (its servo holds it), passive = [...] (it has no motor) or "
            "fixed = [...] (welded)");
}

TEST(Leg, MayLackAJointOfAType) {
  const Files files;
  const std::string toml = with(one_leg_toml, R"(["hip", "knee"])", R"(["hip", "knee", "toe"])");
  const robot::RobotSpec robot = load_one_leg(files, one_leg_xml, toml + "[names.A]\ntoe = \"\"\n");
  EXPECT_EQ(robot.legs[0].joints, (std::vector<int>{0, 1, -1}));
}

TEST(Command, IsCountedAsTheModelDoesAndStaysWithinTheStops) {
  const Files files;
  const std::string xml = with(one_leg_xml, R"(range="-0.7 0")", R"(range="-0.7 0" ref="-0.2")");
  const auto load = [&](const std::string& lines) { return load_one_leg(files, xml, one_leg_toml + lines); };
  const robot::RobotSpec robot = load("[command]\nhip = [-0.4, 0.3]\n[command.A]\nknee = [-0.6, -0.1]\n");
  EXPECT_EQ(robot.joints[0].command->upper_rad, 0.3);
  EXPECT_DOUBLE_EQ(robot.joints[1].command->lower_rad, -0.4);
  EXPECT_DOUBLE_EQ(robot.joints[1].command->upper_rad, 0.1);
  EXPECT_EQ(
      files.error_of([&] { load("[command]\nknee = [-0.8, 0]\n"); }),
      "one_leg.toml: joint 'A_knee': its range of command -0.8 … 0 rad goes beyond its stops -0.7 … 0 rad: "
      "correct it under [command], or make the file anew with `amble robot --init`");
  EXPECT_EQ(files.error_of([&] { load("[command]\nknee = [0]\n"); }),
            "one_leg.toml:18: 'command.knee': expected [lower, upper] with lower below upper");
}

TEST(Command, IsAskedForOfAllJointsWithoutLimitsAtOnce) {
  const Files files;
  std::string xml = with(one_leg_xml, R"(limited="true" range="-0.7 0")", "");
  xml = with(xml, R"(limited="true" range="-0.5 0.5")", "");
  EXPECT_EQ(
      files.error_of([&] { load_one_leg(files, xml); }),
      "one_leg.toml: joints without limits in one_leg.xml need a range of command, [lower, upper] in rad: "
      "command.A.hip (A_hip), command.A.knee (A_knee)");
  const auto robot =
      load_one_leg(files, xml, one_leg_toml + "[command]\nhip = [-0.5, 0.5]\nknee = [-1, 0.2]\n");
  EXPECT_TRUE(std::isinf(robot.joints[1].lower_rad));
  EXPECT_EQ(robot.joints[1].command->lower_rad, -1.0);
}

TEST(Reading, TakesArmatureDampingAndFrictionOfJoints) {
  const Files files;
  const ModelParts parts = read_parts(
      files, with(one_leg_xml, R"(range="-0.7 0")",
                  R"(range="-0.7 0" armature="0.01" damping="0.2" frictionloss="0.3" stiffness="4")"));
  EXPECT_EQ(parts.joints[1].armature_kg_m2, 0.01);
  EXPECT_EQ(parts.joints[1].damping_nm_s_per_rad, 0.2);
  EXPECT_EQ(parts.joints[1].friction_loss_nm, 0.3);
  EXPECT_EQ(parts.joints[1].stiffness_nm_per_rad, 4.0);
}

TEST(Reading, FreesAFixedOrPlanarRoot) {
  const Files files;
  const ModelParts fixed = read_parts(files, with(one_leg_xml, "<freejoint name=\"root\"/>", ""));
  EXPECT_EQ(fixed.joints.size(), 2u);
  EXPECT_THAT(fixed.notes.text(),
              HasSubstr("replaced  root 'torso' was fixed to the world: it is free to move"));
  const ModelParts planar = read_parts(
      files,
      with(one_leg_xml, "<freejoint name=\"root\"/>",
           R"(<joint name="x" type="slide" axis="1 0 0"/><joint name="z" type="slide" axis="0 0 1" ref="1"/>
                     <joint name="pitch" axis="0 1 0"/>)"),
      {"", {{"z", 1.2}, {"pitch", 0.5}}, {}});
  EXPECT_EQ(planar.joints.size(), 2u);
  EXPECT_NEAR(planar.bodies[0].position_m.z, 1.2, 1e-15);
  EXPECT_NEAR(planar.bodies[0].rotation.y, std::sin(0.25), 1e-15);
  EXPECT_THAT(planar.notes.text(), HasSubstr("root 'torso' moved by x, z, pitch: it is free to move"));
}

TEST(Reading, CountsWhatIsKept) {
  const Files files;
  std::string xml = with(crouching_xml, R"(<geom name="shin")",
                         R"(<geom type="ellipsoid" size="0.1 0.2 0.3" mass="0"/><geom name="shin")");
  xml = with(xml, "<worldbody>",
             R"(<asset><mesh name="tip" vertex="0 0 0 1 0 0 0 1 0 0 0 1"/></asset><worldbody>)");
  xml = with(xml, R"(type="sphere" pos="0 0 -0.4" size="0.06")", R"(type="mesh" mesh="tip")");
  const std::string notes = read_parts(files, xml, {.fixed_joints = {"A_knee"}}).notes.text();
  EXPECT_THAT(notes, HasSubstr("kept      2 bodies, 2 joints, 3 geoms, 1 keyframe\n"));
  EXPECT_THAT(notes, HasSubstr("replaced  joint 'A_knee'"));
  EXPECT_THAT(notes, HasSubstr("replaced  1 meshes that collide"));
  EXPECT_THAT(notes, HasSubstr("replaced  1 ellipsoids: convex hulls of 32 points"));
}

TEST(Reading, ReportsWhatStandsInTheWorldAndWhatOnlyMeasures) {
  const Files files;
  const std::string xml = with(
      with(
          one_leg_xml, "<worldbody>",
          R"(<worldbody><geom name="step" type="box" size="1 1 1"/><body name="table"><geom size="1"/></body>)"),
      "</worldbody>",
      R"(</worldbody><tendon><fixed><joint joint="A_hip" coef="1"/></fixed></tendon>
         <actuator><motor joint="A_hip"/></actuator><sensor><touch site="gone"/></sensor>)");
  const ModelParts parts = read_parts(files, xml);
  EXPECT_EQ(parts.bodies.size(), 3u);
  EXPECT_EQ(parts.geoms.size(), 4u);
  for (const char* line : {"1 geoms of the world: 'step'", "body 'table': it stands in the world",
                           "tendon number 1 over 'A_hip', which only measures",
                           "1 actuators by the robot file's servos: 'A_hip'", "sensors"})
    EXPECT_THAT(parts.notes.text(), HasSubstr(line));
}

TEST(Reading, ReportsEachKindOfPartThatIsLeftOut) {
  const Files files;
  const auto left_out = [](const ReadingNotes& notes) {
    std::vector<std::string> lines;
    for (const ReadingNotes::Line& line : notes.lines())
      if (line.reading == Reading::left_out) lines.push_back(line.text);
    return lines;
  };
  std::string xml = with(one_leg_xml, "<worldbody>", R"(<visual/><statistic/><size njmax="500"/><custom/>
      <asset><texture name="sky" type="skybox" builtin="flat" width="8" height="8"/><skin/></asset>
      <extension/><deformable/><worldbody><light/><camera/><camera/>)");
  xml = with(xml, R"(<geom name="torso")", R"(<site/><site/><site/><geom name="torso")");
  EXPECT_THAT(
      left_out(read_parts(files, xml).notes),
      testing::ElementsAre("settings of MuJoCo's viewer", "sizes of MuJoCo's memory",
                           "custom numbers and texts", "plugins", "deformable parts",
                           "textures: geoms have one colour each", "skins", "2 cameras, 1 light, 3 sites"));
  EXPECT_THAT(left_out(read_parts(files, one_leg_xml).notes), testing::IsEmpty());
  const std::string inertial =
      R"(<inertial><mass value="1"/><inertia ixx="1" iyy="1" izz="1" ixy="0" ixz="0" iyz="0"/></inertial>)";
  const auto urdf = files.write("r.urdf", R"(<robot name="r"><link name="base">)" + inertial +
                                              R"(</link><link name="leg">)" + inertial +
                                              R"(</link><transmission name="a"/><transmission name="b"/>
      <gazebo/><gazebo reference="leg"/><joint name="hip" type="revolute"><parent link="base"/>
      <child link="leg"/><limit lower="-1" upper="1" effort="5" velocity="3"/><mimic joint="hip"/></joint></robot>)");
  EXPECT_THAT(left_out(compile_model(urdf).notes),
              testing::ElementsAre("transmissions: the robot file has the servos", "settings of Gazebo",
                                   "mimic of joint 'hip': it moves on its own"));
}

TEST(Reading, TakesTheBodyWithJointsBehindItForTheRobot) {
  const Files files;
  const ModelParts parts = read_parts(
      files, with(one_leg_xml, "<worldbody>",
                  R"(<worldbody><body name="ball"><freejoint/><geom size="1"/></body><body name="post"/>)"));
  EXPECT_EQ(parts.bodies[0].name, "torso");
  EXPECT_THAT(parts.notes.text(), HasSubstr("body 'ball': it stands in the world"));
}

TEST(Reading, LeavesOutWhatANewerMujocoKnows) {
  const Files files;
  std::string xml = with(one_leg_xml, "<option", R"(<option integrator="implicitfast" ls_iterations="6")");
  xml = with(xml, R"(name="A_hip")", R"(name="A_hip" actuatorfrcrange="-7 7" actuatorgravcomp="true")");
  xml = with(xml, R"(name="torso" pos)", R"(name="torso" gravcomp="1" pos)");
  xml = with(xml, "</worldbody>",
             R"(</worldbody><actuator><position joint="A_hip" kp="20" kv="2" inheritrange="1"/></actuator>)");
  const ModelFile file = compile_model(files.write("m.xml", xml));
  const std::string notes = file.notes.text();
  for (const char* name :
       {"actuatorfrcrange", "gravcomp", "kv", "inheritrange", "integrator", "ls_iterations"})
    EXPECT_THAT(notes, HasSubstr(std::string("attribute '") + name)) << name;
  EXPECT_EQ(file.motors.at("A_hip").max_torque_nm, 7.0);
  EXPECT_EQ(file.motors.at("A_hip").kv_nm_s_per_rad, 2.0);
  EXPECT_EQ(extract_parts(file).joints.size(), 2u);
}

TEST(Reading, LeavesOutShapesOfMissingMeshesAloneAndNamesThem) {
  const Files files;
  const std::string asset = R"(<asset><mesh name="shell" file="gone.stl"/></asset><worldbody>)";
  std::string xml = with(one_leg_xml, "<worldbody>", asset);
  const std::string geom = R"(<geom name="thigh" type="capsule")";
  const auto parts = read_parts(
      files,
      with(xml, geom, R"(<geom type="mesh" mesh="shell" mass="0" contype="0" conaffinity="0"/>)" + geom));
  EXPECT_EQ(parts.geoms.size(), 4u);
  EXPECT_THAT(parts.notes.text(),
              HasSubstr("only to look at and whose mesh cannot be read: gone.stl (not found) of 'thigh'"));
  const auto bare = read_parts(files, with(xml, geom, R"(<geom type="mesh" mesh="shell"/>)" + geom));
  EXPECT_EQ(bare.geoms.size(), 4u);
  EXPECT_THAT(
      bare.notes.text(),
      HasSubstr("left out  collision shapes whose mesh cannot be read: gone.stl (not found) of 'thigh'"));
}

TEST(Reading, NeedsNoFilesOfTexturesAndHeightFields) {
  const Files files;
  std::string xml =
      with(one_leg_xml, "<worldbody>",
           R"(<asset><texture name="wood" type="2d" file="gone.png"/><material name="wooden" texture="wood"/>
         <hfield name="hills" file="gone.png" size="1 1 1 1"/></asset><worldbody><geom type="hfield" hfield="hills"/>)");
  xml = with(xml, R"(<geom name="thigh")", R"(<geom name="thigh" material="wooden")");
  const ModelParts parts = read_parts(files, xml);
  EXPECT_EQ(parts.geoms.size(), 4u);
  for (const char* kind : {"height fields", "textures"}) EXPECT_THAT(parts.notes.text(), HasSubstr(kind));
}

TEST(Reading, MakesTheConvexHullOfAMesh) {
  const Files files;
  // A cube with points inside and on its faces.
  const std::string asset = R"(<asset><mesh name="cube" vertex="
    -1 -1 -1  1 -1 -1  -1 1 -1  1 1 -1  -1 -1 1  1 -1 1  -1 1 1  1 1 1  0 0 0  0.5 0.2 0.1"/></asset><worldbody>)";
  const ModelParts parts = read_parts(
      files, with(with(one_leg_xml, "<worldbody>", asset), R"(type="sphere" pos="0 0 -0.4" size="0.06")",
                  R"(type="mesh" mesh="cube" pos="0 0 -0.4")"));
  const robot::Geom& foot = parts.geoms[3];
  EXPECT_EQ(foot.shape, robot::Shape::mesh);
  EXPECT_EQ(foot.vertices_m.size(), 8u);
  EXPECT_EQ(foot.triangles.size(), 12u);
  EXPECT_NEAR(foot.size_m.x, std::sqrt(3.0), 1e-6);
}

}  // namespace
}  // namespace amble::morphology
