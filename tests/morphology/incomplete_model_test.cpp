#include <fmt/ranges.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <mujoco/mujoco.h>

#include <algorithm>
#include <functional>
#include <numeric>

#include "amble/core/index.hpp"
#include "amble/morphology/original_model.hpp"
#include "amble/morphology/robot_guess.hpp"
#include "tests/models/small_models.hpp"
#include "tests/morphology/files.hpp"

// Meshes, masses, contacts and roots that files lack, or have in another place than MuJoCo looks for them.
namespace amble::morphology {
namespace {

using testing::HasSubstr;
using testing::Not;

std::string with_leg(std::string text, const std::string& leg) {
  for (std::size_t at = text.find("LEG"); at != std::string::npos; at = text.find("LEG"))
    text.replace(at, 3, leg);
  return text;
}

/// A quadruped with these shapes; of the trunk, of each thigh, of each shin inside, and behind the bodies.
std::string four_legs(const std::string& trunk, const std::string& of_thigh, const std::string& of_shin,
                      const std::string& behind = "", const std::string& before = "") {
  std::string text = "<mujoco><asset><mesh name=\"gone\" file=\"gone.stl\"/></asset>" + before +
                     "<worldbody><geom name=\"floor\" type=\"plane\" size=\"5 5 .1\"/><body name=\"trunk\" "
                     "pos=\"0 0 .3\"><freejoint/>" +
                     trunk;
  for (const char* leg : {"fl", "fr", "rl", "rr"})
    text += fmt::format(
        R"(<body name="{0}_thigh" pos="{1} {2} 0"><joint name="{0}_hip" axis="0 1 0" range="-60 60"/>{3}
           <body name="{0}_shin" pos="0 0 -.12"><joint name="{0}_knee" axis="0 1 0" range="-60 60"/>{4}</body></body>)",
        leg, leg[0] == 'f' ? 0.13 : -0.13, leg[1] == 'l' ? 0.1 : -0.1, of_thigh, with_leg(of_shin, leg));
  return text + "</body></worldbody>" + behind + "</mujoco>";
}

const std::string trunk_box = R"(<geom type="box" size=".15 .07 .04" mass="2"/>)",
                  thigh_rod = R"(<geom type="capsule" size=".015" fromto="0 0 0 0 0 -.12" mass=".1"/>)",
                  shin_rod = R"(<geom type="capsule" size=".01" fromto="0 0 0 0 0 -.1" mass=".05"/>)",
                  foot_ball = R"(<geom name="LEG_ball" size=".02" pos="0 0 -.12" mass=".05"/>)",
                  lost_trunk = R"(<geom type="mesh" mesh="gone" mass="2"/>)";

ModelParts incomplete(const Files& files, const std::string& text, const std::string& name = "m.xml") {
  return extract_parts(compile_model(files.write(name, text)));
}

const robot::Body& body_of(const ModelParts& parts, const std::string& name) {
  return *std::ranges::find(parts.bodies, name, &robot::Body::name);
}

TEST(IncompleteModel, OfWhichATrunksMeshIsMissingKeepsItsMassWithMomentsOfABody) {
  const Files files;
  const ModelParts alone = incomplete(files, four_legs(lost_trunk, thigh_rod, shin_rod + foot_ball));
  EXPECT_EQ(body_of(alone, "trunk").mass_kg, 2.0);
  EXPECT_GT(body_of(alone, "trunk").inertia_kg_m2.x, 1e-3) << "a ball of water of 2 kg";
  EXPECT_THAT(alone.notes.text(),
              HasSubstr("bodies with a mesh that cannot be read, by those of their other shapes"));
  EXPECT_THAT(alone.notes.text(), HasSubstr("gone.stl (not found) of 'trunk'"));
  // Beside a shape that is there: its shape, all of the mass.
  const ModelParts beside =
      incomplete(files, four_legs(lost_trunk + trunk_box, thigh_rod, shin_rod + foot_ball));
  EXPECT_EQ(body_of(beside, "trunk").mass_kg, 4.0);
  const Vec3 moments = body_of(beside, "trunk").inertia_kg_m2;
  EXPECT_NEAR(moments.x + moments.y + moments.z, 8.0 / 3.0 * (0.15 * 0.15 + 0.07 * 0.07 + 0.04 * 0.04), 1e-4);
}

TEST(IncompleteModel, OfWhichAMeshWeighsByItsShapeAloneSaysWhichFileIsMissing) {
  const Files files;
  const std::string error = files.error_of([&] {
    incomplete(files, four_legs(R"(<geom type="mesh" mesh="gone"/>)", thigh_rod, shin_rod + foot_ball));
  });
  EXPECT_THAT(error, HasSubstr("links without mass that move: 'trunk'"));
  EXPECT_THAT(error, HasSubstr("gone.stl (not found)"));
}

TEST(IncompleteModel, OfWhichAFootsMeshIsMissingIsRefusedAlsoBesideAShank) {
  const Files files;
  const std::string foot = R"(<geom type="mesh" mesh="gone" pos="0 0 -.12" mass=".05"/>)",
                    shank = R"(<geom type="mesh" mesh="gone" mass=".05"/>)";
  EXPECT_THAT(files.error_of([&] { incomplete(files, four_legs(trunk_box, thigh_rod, shin_rod + foot)); }),
              HasSubstr("collision meshes of feet that cannot be read: gone.stl"));
  EXPECT_THAT(incomplete(files, four_legs(trunk_box, thigh_rod, shank + foot_ball)).notes.text(),
              HasSubstr("collision shapes whose mesh cannot be read"))
      << "the ball is lower";
}

TEST(IncompleteModel, IsKeptForItsOwnPhysicsWithTheMassesThatWereMendedAndWithoutPlaceholders) {
  const Files files;
  const auto path = files.write("own.xml", four_legs(lost_trunk, thigh_rod, shin_rod + foot_ball));
  const std::string toml = guess_robot(compile_model(path), "own.xml", true).toml;
  const robot::RobotSpec robot = load_robot(files.write("own.toml", toml));
  ASSERT_NE(robot.original, nullptr);
  EXPECT_TRUE(robot.original->meshes.empty());
  EXPECT_THAT(robot.original->mjcf, HasSubstr("contype=\"0\""));
  const ModelPointer own = compile_mjcf(robot.original->mjcf, "the test", robot.original->meshes);
  EXPECT_NEAR(robot.bodies[0].mass_kg, 2.0, 1e-12);
  EXPECT_THAT(robot.original->mjcf, HasSubstr("<inertial"));
  const double mass_kg = std::transform_reduce(robot.bodies.begin(), robot.bodies.end(), 0.0, std::plus<>(),
                                               [](const robot::Body& body) { return body.mass_kg; });
  EXPECT_NEAR(mj_getTotalmass(own.get()), mass_kg, 1e-9);
  for (const robot::Body& body : robot.bodies) {
    const int id = mj_name2id(own.get(), mjOBJ_BODY, body.name.c_str());
    ASSERT_GE(id, 0) << body.name;
    EXPECT_NEAR(own->body_mass[id], body.mass_kg, 1e-9) << body.name;
  }
}

TEST(IncompleteModel, WhoseFeetTouchByPairsOfContactsStandsOnThem) {
  const Files files;
  std::string pairs = "<contact>";
  for (const char* leg : {"fl", "fr", "rl", "rr"})
    pairs += fmt::format(R"(<pair geom1="floor" geom2="{}_ball"/>)", leg);
  const std::string silent = with(foot_ball, "mass", R"(contype="0" conaffinity="0" mass)");
  const ModelParts parts =
      incomplete(files, four_legs(trunk_box, thigh_rod, shin_rod + silent, pairs + "</contact>"));
  for (const robot::Geom& geom : parts.geoms)
    EXPECT_TRUE(geom.collides || !geom.name.ends_with("_ball")) << geom.name;
  // A pair of two parts of the robot is no contact with the ground.
  const ModelParts among =
      incomplete(files, four_legs(trunk_box, thigh_rod, shin_rod + silent,
                                  R"(<contact><pair geom1="fl_ball" geom2="fr_ball"/></contact>)"));
  for (const robot::Geom& geom : among.geoms)
    EXPECT_FALSE(geom.collides && geom.name.ends_with("_ball")) << geom.name;
}

TEST(IncompleteModel, WhoseFeetTouchAFloorOfAnotherFileByPairsStandsOnThem) {
  const Files files;
  std::string pairs = "<contact>";
  for (const char* leg : {"fl", "fr", "rl", "rr"})
    pairs += fmt::format(R"(<pair geom1="{}_ball" geom2="ground"/>)", leg);
  const std::string silent = with(foot_ball, "mass", R"(contype="0" conaffinity="0" mass)");
  const ModelParts parts =
      incomplete(files, four_legs(trunk_box, thigh_rod, shin_rod + silent, pairs + "</contact>"));
  EXPECT_EQ(
      std::ranges::count_if(
          parts.geoms, [](const robot::Geom& geom) { return geom.collides && geom.name.ends_with("_ball"); }),
      4);
  // One that collides anyway keeps what it collides with.
  const ModelFile plain = compile_model(
      files.write("p.xml", four_legs(trunk_box, thigh_rod, shin_rod + foot_ball, pairs + "</contact>")));
  XmlElement text = plain.text;
  EXPECT_THAT(write_xml(text).text, Not(HasSubstr("conaffinity")));
}

TEST(IncompleteModel, WhoseLinksEndInWhatOnlyShowsSaysSo) {
  const Files files;
  const std::string shown = with(foot_ball, "mass", R"(contype="0" conaffinity="0" mass)");
  const std::string foot =
      R"(<body name="LEG_foot" pos="0 0 -.1"><joint name="LEG_ankle" axis="0 1 0" range="-60 60"/>)" + shown +
      "</body>";
  EXPECT_THAT(
      incomplete(files, four_legs(trunk_box, thigh_rod, shin_rod + foot)).notes.text(),
      HasSubstr(
          "which have shapes to look at and none that collides: 'fl_foot', 'fr_foot', 'rl_foot', 'rr_foot'"));
}

TEST(IncompleteModel, WhoseShinsOnlyShowAboveFeetThatCollideIsNotSaidToEndInThem) {
  const Files files;
  const std::string shin = with(shin_rod, "mass", R"(contype="0" conaffinity="0" mass)");
  const std::string foot =
      R"(<body name="LEG_foot" pos="0 0 -.1"><joint name="LEG_ankle" axis="0 1 0" range="-60 60"/>)" +
      foot_ball + "</body>";
  EXPECT_THAT(incomplete(files, four_legs(trunk_box, thigh_rod, shin + foot)).notes.text(),
              Not(HasSubstr("none that collides")));
}

TEST(IncompleteModel, WithoutInertialsHasTheMassesOfItsGeomsWhateverTheCompilerIsTold) {
  const Files files;
  const ModelParts parts = incomplete(files, four_legs(trunk_box, thigh_rod, shin_rod + foot_ball, "",
                                                       "<compiler inertiafromgeom=\"false\"/>"));
  EXPECT_EQ(body_of(parts, "trunk").mass_kg, 2.0);
  EXPECT_NEAR(body_of(parts, "fl_shin").mass_kg, 0.1, 1e-12);
  EXPECT_THAT(parts.notes.text(), HasSubstr("inertiafromgeom=\"false\""));
}

TEST(IncompleteModel, WhoseActuatorsPullATendonOverOneJointIsDrivenThere) {
  const Files files;
  std::string tendons = "<tendon>", actuators = "<actuator>";
  for (const char* leg : {"fl", "fr", "rl", "rr"}) {
    tendons += fmt::format(R"(<fixed name="{0}_t"><joint joint="{0}_knee" coef="2"/></fixed>)", leg);
    actuators += fmt::format(
        R"(<position joint="{0}_hip" kp="20" forcerange="-5 5"/><position tendon="{0}_t" kp="20" gear="1.5" forcerange="-5 5"/>)",
        leg);
  }
  const ModelFile file =
      compile_model(files.write("m.xml", four_legs(trunk_box, thigh_rod, shin_rod + foot_ball,
                                                   tendons + "</tendon>" + actuators + "</actuator>")));
  const ModelParts parts = extract_parts(file);
  EXPECT_EQ(std::ranges::count(parts.drives, Drive::motor), 8);
  EXPECT_THAT(parts.notes.text(),
              HasSubstr("actuators of tendons that measure one joint, by the joint's: 'fl_knee'"));
  XmlElement text = file.text;
  EXPECT_THAT(write_xml(text).text, HasSubstr("gear=\"3\""));
}

TEST(IncompleteModel, WhosePositionActuatorsHaveNoGreatestSpeedIsSaidToBeSo) {
  const Files files;
  const auto said = [&](const char* actuator) {
    std::string actuators = "<actuator>";
    for (const char* leg : {"fl", "fr", "rl", "rr"})
      for (const char* joint : {"hip", "knee"})
        actuators += fmt::format(R"(<{} joint="{}_{}" forcerange="-5 5"/>)", actuator, leg, joint);
    const ModelFile file = compile_model(files.write(
        "m.xml", four_legs(trunk_box, thigh_rod, shin_rod + foot_ball, actuators + "</actuator>")));
    return fmt::format("{}", fmt::join(guess_robot(file, "m.xml").settled, "\n"));
  };
  EXPECT_THAT(said(R"(position kp="20")"), HasSubstr("as fast as their torque allows"));
  EXPECT_THAT(said(R"(velocity kv="2")"), Not(HasSubstr("as fast as")));
}

TEST(IncompleteModel, BelowAnEmptyLinkIsFreeByItself) {
  const Files files;
  for (const char* type : {"floating", "planar"}) {
    const std::string text = with(
        tests::urdf_with_effort(), "</robot>",
        fmt::format(
            R"(<link name="odom"/><joint name="base" type="{}"><parent link="odom"/><child link="base"/></joint></robot>)",
            type));
    const ModelParts parts = incomplete(files, text, "r.urdf");
    EXPECT_EQ(parts.bodies[0].name, "base");
    EXPECT_THAT(parts.notes.text(),
                HasSubstr(fmt::format("the {} joint 'base' below the empty link 'odom'", type)));
  }
}

TEST(IncompleteModel, WhoseInertialLacksMassOrMomentsHasThemFromItsShapes) {
  const Files files;
  const std::string whole = tests::urdf_with_effort();
  const auto without = [&](const std::string& element) {
    std::string text = whole;
    const std::size_t link = text.find("\"left_shin\""), from = text.find("<" + element, link);
    text.erase(from, text.find("/>", from) + 2 - from);
    return incomplete(files, text, "r.urdf");
  };
  EXPECT_THAT(without("inertia ").notes.text(),
              HasSubstr("by those of the shapes with the body's mass: left_shin"));
  EXPECT_THAT(without("mass ").notes.text(), HasSubstr("filled with water, 1000 kg/m3: left_shin"));
}

TEST(IncompleteModel, WithTheLimitsOfATemplateHasNeitherItsTorqueNorItsSpeed) {
  const Files files;
  std::string text = tests::urdf_with_effort();
  for (const char* limit : {R"(effort="12" velocity="5")", R"(effort="9" velocity="5")"})
    for (std::size_t at = text.find(limit); at != std::string::npos; at = text.find(limit))
      text.replace(at, std::string_view(limit).size(), R"(effort="1000" velocity="0.5")");
  const RobotGuess guess = guess_robot(compile_model(files.write("r.urdf", text)), "r.urdf");
  std::string unwrapped = guess.toml;
  for (std::size_t at = unwrapped.find("\n# "); at != std::string::npos; at = unwrapped.find("\n# "))
    unwrapped.replace(at, 3, " ");
  EXPECT_THAT(unwrapped, HasSubstr("the velocity limit beside that, 0.5 rad/s, is a template's too"));
  EXPECT_THAT(guess.toml, HasSubstr("gain_per_s = 9\n"));
  EXPECT_THAT(fmt::format("{}", fmt::join(guess.doubts, ";")), Not(HasSubstr("at a crawl")));
}

TEST(IncompleteModel, OfWhichNothingCollidesTouchesTheGroundByWhatThereIsToLookAt) {
  const Files files;
  std::string text = tests::urdf_with_effort();
  for (const char* tag : {"<collision", "</collision"})
    for (std::size_t at = text.find(tag); at != std::string::npos; at = text.find(tag))
      text.replace(at, std::string_view(tag).size(), tag[1] == '/' ? "</visual" : "<visual");
  const RobotGuess guess = guess_robot(compile_model(files.write("r.urdf", text)), "r.urdf");
  EXPECT_THAT(guess.toml, HasSubstr("legs = [\"left\", \"right\"]"));
  EXPECT_THAT(extract_parts(compile_model(files.path("r.urdf"))).notes.text(),
              HasSubstr("that nothing of the robot collides: its"));
  // With one that does, the others are there to be looked at.
  const std::string silent = with(foot_ball, "mass", R"(contype="0" conaffinity="0" mass)");
  const ModelParts parts = incomplete(files, four_legs(trunk_box, thigh_rod, shin_rod + silent));
  EXPECT_TRUE(std::ranges::none_of(
      parts.geoms, [](const robot::Geom& geom) { return geom.collides && geom.name.ends_with("_ball"); }));
}

}  // namespace
}  // namespace amble::morphology
