#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "amble/core/index.hpp"
#include "amble/morphology/model_parts.hpp"
#include "amble/morphology/robot_guess.hpp"
#include "amble/robot/pose.hpp"
#include "tests/models/small_models.hpp"
#include "tests/morphology/files.hpp"

// Masses, moments of inertia and limits that files lack, or have wrong.
namespace amble::morphology {
namespace {

using testing::HasSubstr;
using testing::Not;
using tests::urdf_with_effort;

ModelParts parts_of(const Files& files, const std::string& name, const std::string& text) {
  return extract_parts(compile_model(files.write(name, text)));
}

const robot::Body& body(const ModelParts& parts, const std::string& name) {
  return *std::ranges::find(parts.bodies, name, &robot::Body::name);
}

const std::string thigh_geom =
    R"(<geom name="thigh" type="capsule" fromto="0 0 0 0 0 -0.4" size="0.05" mass="1"/>)";

TEST(Masses, ThatAreMissingAreThoseOfTheShapesFilledWithWater) {
  const Files files;
  const ModelParts parts =
      parts_of(files, "m.xml", with(one_leg_xml, thigh_geom, with(thigh_geom, "\"1\"", "\"0\"")));
  const double ball = 4.0 / 3.0 * M_PI * 0.000125, tube = M_PI * 0.0025 * 0.4;
  EXPECT_NEAR(body(parts, "thigh").mass_kg, 1000.0 * (ball + tube), 1e-9);
  EXPECT_NEAR(body(parts, "thigh").com_m.z, -0.2, 1e-9);
  EXPECT_THAT(parts.notes.text(), HasSubstr("replaced  masses that are missing or 0, by those of the shapes "
                                            "filled with water, 1000 kg/m3: thigh"));
}

TEST(Masses, WithoutMomentsHaveThoseOfTheShapesInBothFormats) {
  const Files files;
  const std::string inertial = R"(<inertial pos="0 0 -0.2" mass="2" diaginertia="0 0 0"/>)";
  const ModelParts mjcf = parts_of(files, "m.xml", with(one_leg_xml, thigh_geom, inertial + thigh_geom));
  EXPECT_EQ(body(mjcf, "thigh").mass_kg, 2.0);
  const Vec3 moments = body(mjcf, "thigh").inertia_kg_m2;
  EXPECT_GT(moments.x, 2.0 * 0.16 / 12.0);
  EXPECT_LT(moments.x, 2.0 * 0.25 / 12.0);
  EXPECT_THAT(mjcf.notes.text(), HasSubstr("replaced  moments of inertia that are missing or 0, by those of "
                                           "the shapes with the body's mass: thigh"));

  std::string zero = urdf_with_effort();
  for (std::size_t at = zero.find("\"0.01\""); at != std::string::npos; at = zero.find("\"0.01\""))
    zero.replace(at, 6, "\"0\"");
  const ModelParts urdf = parts_of(files, "r.urdf", zero);
  EXPECT_NEAR(body(urdf, "left_shin").inertia_kg_m2.x, 0.4 * 0.3 * 0.0009, 1e-9) << "its shape is a ball";
  EXPECT_GT(body(urdf, "left_thigh").inertia_kg_m2.x, 0.0) << "it has no shape";
  EXPECT_THAT(urdf.notes.text(), HasSubstr("the body's mass: left_shin, right_shin\n"));
  EXPECT_THAT(urdf.notes.text(), HasSubstr("without shapes, by those of a ball of water: "));
}

TEST(Masses, OfLinksBetweenTwoJointsInOnePointMayBeMissing) {
  const Files files;
  // Each thigh hangs on a hub, or on two of them, that have neither mass nor shape.
  const ModelParts plain = parts_of(files, "r.urdf", urdf_with_effort());
  std::string one = urdf_with_effort(), two = one;
  for (const std::string side : {"left", "right"}) {
    const auto joint = [&](const std::string& name, const std::string& parent, const std::string& child) {
      return "<joint name=\"" + side + name + "\" type=\"revolute\"><parent link=\"" + parent +
             "\"/><child link=\"" + side + child +
             R"("/><origin xyz="0.01 0.02 0.03" rpy="0.1 0.2 0.3"/><axis xyz="1 0 0"/>
             <limit lower="-1" upper="1"/></joint><link name=")" +
             side + child + "\"/>";
    };
    const std::string parent = "<parent link=\"base\"/><child link=\"" + side + "_thigh\"/>";
    const std::string of_hub = "<parent link=\"" + side + "_hub\"/><child link=\"" + side + "_thigh\"/>";
    one = with(with(one, parent, of_hub), "</robot>", joint("_roll", "base", "_hub") + "</robot>");
    two = with(with(two, parent, of_hub), "</robot>",
               joint("_yaw", "base", "_first") + joint("_roll", side + "_first", "_hub") + "</robot>");
  }
  for (const auto& [text, joints] : {std::pair{one, 6U}, {two, 8U}}) {
    const ModelParts parts = parts_of(files, "r.urdf", text);
    EXPECT_EQ(parts.bodies.size(), plain.bodies.size());
    EXPECT_EQ(parts.joints.size(), joints);
    EXPECT_THAT(parts.notes.text(), HasSubstr("whose joints are now those of the link behind them: "));
    robot::RobotSpec robot;
    robot.bodies = parts.bodies;
    robot.joints = parts.joints;
    for (std::size_t b = 1; b < parts.bodies.size(); ++b) {
      const auto order = robot.joints_of_body(static_cast<int>(b));
      for (std::size_t k = 0; k < order.size(); ++k)
        EXPECT_EQ(parts.joints[to_index(order[k])].chain_index, static_cast<int>(k));
    }
    EXPECT_EQ(parts.joints[to_index(robot.joints_of_body(1).back())].name, "left_hip_joint");
  }
}

double total_kg(const ModelParts& parts) {
  double mass_kg = 0.0;
  for (const robot::Body& part : parts.bodies) mass_kg += part.mass_kg;
  return mass_kg;
}

const std::string block = R"(<collision><geometry><box size="0.3 0.2 0.1"/></geometry></collision>)";

/// The link, fixed to that one.
std::string fixed_link(const std::string& name, const std::string& parent, const std::string& inside) {
  return "<link name=\"" + name + "\">" + inside + "</link><joint name=\"" + name +
         "_joint\" type=\"fixed\"><parent link=\"" + parent + "\"/><child link=\"" + name +
         "\"/></joint></robot>";
}

TEST(Masses, OfLinksWithoutInertialAreThoseOfTheLinksThatTheyAreWeldedTo) {
  const Files files;
  const std::string urdf = urdf_with_effort();
  const double mass_kg = total_kg(parts_of(files, "r.urdf", urdf));
  ASSERT_NEAR(mass_kg, 4.2, 1e-12);
  const std::string inertial =
      urdf.substr(urdf.find("<inertial>"), urdf.find("</inertial>") + 11 - urdf.find("<inertial>"));
  // Behind the trunk and behind a shin; the idiom of ROS, a base whose mass is that of a link on it.
  std::string behind = with(urdf, "</robot>", fixed_link("cover", "base", block));
  behind = with(behind, "</robot>", fixed_link("boot", "left_shin", block));
  const std::string idiom =
      with(with(urdf, inertial, block), "</robot>", fixed_link("inertia", "base", inertial));
  const std::string second = with(with(urdf, "</robot>", fixed_link("cover", "base", block)), "</robot>",
                                  fixed_link("screw", "cover", block));
  for (const auto& [text, names] :
       {std::pair{behind, "cover, boot"}, {idiom, "base"}, {second, "cover, screw"}}) {
    const ModelParts parts = parts_of(files, "r.urdf", text);
    EXPECT_NEAR(total_kg(parts), mass_kg, 1e-12) << names;
    EXPECT_EQ(body(parts, "base").mass_kg, 3.0) << names;
    EXPECT_THAT(parts.notes.text(),
                HasSubstr(std::string("weigh nothing, welded to links that have one: ") + names));
    EXPECT_THAT(parts.notes.text(), Not(HasSubstr("water")));
  }
  // It is not weighed either where MuJoCo asks for the masses of others.
  std::string zero = with(behind, R"(<mass value="0.3"/><inertia ixx="0.01" iyy="0.01" izz="0.01")",
                          R"(<mass value="0.3"/><inertia ixx="0" iyy="0" izz="0")");
  EXPECT_NEAR(total_kg(parts_of(files, "r.urdf", zero)), mass_kg, 1e-12);
}

TEST(Masses, OfLinksWithoutInertialWhereNothingWeighsAreThoseOfWaterAndDoubted) {
  const Files files;
  const std::string urdf = urdf_with_effort();
  const std::string inertial =
      urdf.substr(urdf.find("<inertial>"), urdf.find("</inertial>") + 11 - urdf.find("<inertial>"));
  const auto doubts = [&](const std::string& text) {
    return guess_robot(compile_model(files.write("r.urdf", text)), "r.urdf").doubts;
  };
  const std::string bare = with(urdf, inertial, block);
  EXPECT_NEAR(body(parts_of(files, "r.urdf", bare), "base").mass_kg, 6.0, 1e-9);
  EXPECT_THAT(
      doubts(bare),
      testing::Contains(HasSubstr("filled with water, 1000 kg/m3; give them mass and inertia: base")));
  // What only shows weighs nothing, and is no matter.
  const std::string shown =
      with(urdf, "</robot>",
           fixed_link("imu", "base", with(with(block, "collision", "visual"), "/collision", "/visual")));
  EXPECT_NEAR(total_kg(parts_of(files, "r.urdf", shown)), 4.2, 1e-12);
  EXPECT_THAT(parts_of(files, "r.urdf", shown).notes.text(), Not(HasSubstr("imu:")));
  EXPECT_THAT(parts_of(files, "r.urdf", shown).notes.text(), Not(HasSubstr("water")));
}

TEST(Masses, OfARootThatAreZeroAreThoseOfItsShapesAsThoseOfLegs) {
  const Files files;
  const std::string urdf = with(with(urdf_with_effort(), R"(<mass value="3"/>)", R"(<mass value="0"/>)"),
                                "</inertial>", "</inertial>" + block);
  const ModelParts parts = parts_of(files, "r.urdf", urdf);
  EXPECT_NEAR(body(parts, "base").mass_kg, 6.0, 1e-9);
  EXPECT_NEAR(body(parts, "base").inertia_kg_m2.x + body(parts, "base").inertia_kg_m2.y +
                  body(parts, "base").inertia_kg_m2.z,
              6.0 / 6.0 * (0.09 + 0.04 + 0.01), 1e-9);
  EXPECT_THAT(parts.notes.text(), HasSubstr("filled with water, 1000 kg/m3: base"));
  // Scenery is none of the robot.
  const ModelParts scene =
      parts_of(files, "m.xml",
               with(one_leg_xml, "<worldbody>",
                    R"(<worldbody><body name="wall"><geom type="box" size="1 1 1" mass="0"/></body>)"));
  EXPECT_THAT(scene.notes.text(), Not(HasSubstr("water")));
}

TEST(MasslessLinks, MoveTheLinkBehindThemAsBefore) {
  const Files files;
  // The same limb with a hub of next to no mass, which stays a body of its own.
  const auto limb = [](const std::string& hub) {
    return with(
        one_leg_xml, R"(<body name="thigh" pos="0 0 -0.1">)",
        R"(<body name="hub" pos="0.1 0.2 -0.1" euler="0.3 0.2 0.1"><joint name="roll" pos="0 0.01 0" axis="1 1 0"
                   limited="true" range="-1 1"/>)" +
            hub + R"(<body name="thigh" pos="0.05 0 0" euler="0.2 0 0.4">)");
  };
  const auto closed = [](const std::string& xml) {
    return with(xml, "</body>\n    </body>", "</body></body>\n    </body>");
  };
  const ModelParts kept = parts_of(
                       files, "m.xml",
                       closed(limb(R"(<inertial pos="0 0 0" mass="1e-3" diaginertia="1e-6 1e-6 1e-6"/>)"))),
                   merged = parts_of(files, "m.xml", closed(limb("")));
  ASSERT_EQ(kept.bodies.size(), merged.bodies.size() + 1);
  ASSERT_EQ(kept.joints.size(), merged.joints.size());
  const auto pose_of_shin = [](const ModelParts& parts, const std::vector<double>& angles) {
    robot::RobotSpec robot;
    robot.bodies = parts.bodies;
    robot.joints = parts.joints;
    return robot::poses_at(robot, {parts.bodies[0].position_m, parts.bodies[0].rotation}, angles).back();
  };
  for (const auto& angles :
       {std::vector{0.0, 0.0, 0.0}, {0.7, 0.0, 0.0}, {0.0, 0.4, 0.0}, {-0.6, 0.3, -0.5}}) {
    const robot::Pose a = pose_of_shin(kept, angles), b = pose_of_shin(merged, angles);
    EXPECT_NEAR(norm(a.position_m - b.position_m), 0.0, 1e-12);
    EXPECT_NEAR(norm(rotate(a.rotation, {1, 2, 3}) - rotate(b.rotation, {1, 2, 3})), 0.0, 1e-12);
  }
}

TEST(MasslessLinks, AtTheEndOfALimbAreLeftOutWithTheirJointsAndOthersRefused) {
  const Files files;
  const std::string end =
      R"(<joint name="spin" type="continuous"><parent link="left_shin"/><child link="tip"/>
    <axis xyz="0 0 1"/></joint><link name="tip"/></robot>)";
  const ModelParts parts = parts_of(files, "r.urdf", with(urdf_with_effort(), "</robot>", end));
  EXPECT_EQ(parts.bodies.size(), 5u);
  EXPECT_EQ(parts.joints.size(), 4u);
  EXPECT_EQ(parts.start_rad.size(), 4u);
  EXPECT_EQ(parts.model_joints.size(), 4u);
  EXPECT_THAT(parts.notes.text(),
              HasSubstr("left out  links without mass and shape at the end of a limb: 'tip' (joint 'spin')"));
  // A hub with two limbs behind it, and a root.
  const std::string mass = R"(<inertial><mass value="3"/>)";
  std::string bare = urdf_with_effort();
  const std::size_t from = bare.find("<inertial>"), to = bare.find("</inertial>") + 11;
  bare.erase(from, to - from);
  EXPECT_EQ(files.error_of([&] { parts_of(files, "r.urdf", bare); }),
            "r.urdf: links without mass that move: 'base': give them mass and inertia (URDF: <inertial>)");
}

TEST(Masses, OfLinksThatHaveOnlyAMeshThatIsGoneAreMissing) {
  const Files files;
  const std::string link =
      R"(<link name="tip"><collision><geometry><mesh filename="gone.stl"/></geometry></collision></link>
    <joint name="spin" type="continuous"><parent link="base"/><child link="tip"/><origin xyz="0 0 0.3"/>
    <axis xyz="0 0 1"/></joint></robot>)";
  const ModelParts parts = parts_of(files, "r.urdf", with(urdf_with_effort(), "</robot>", link));
  EXPECT_EQ(parts.joints.size(), 4u);
  EXPECT_THAT(parts.notes.text(), HasSubstr("gone.stl (not found) of 'tip'"));
  EXPECT_THAT(parts.notes.text(), HasSubstr("'tip' (joint 'spin')"));
}

TEST(Masses, WithMomentsThatNoBodyHasAreTreatedAlikeInBothFormats) {
  const Files files;
  const auto mjcf = [&](const std::string& moments) {
    return parts_of(files, "m.xml",
                    with(one_leg_xml, thigh_geom,
                         "<inertial pos=\"0 0 -0.2\" mass=\"2\" " + moments + "/>" + thigh_geom));
  };
  for (const char* moments : {R"(diaginertia="0.01 0.01 0.07")", R"(fullinertia="0.01 0.01 0.07 0 0 0")",
                              R"(diaginertia="0.07 0.01 0.01")"}) {
    const ModelParts parts = mjcf(moments);
    const Vec3 found = body(parts, "thigh").inertia_kg_m2;
    EXPECT_NEAR(found.x, 0.03, 1e-9);
    EXPECT_NEAR(found.z, 0.03, 1e-9);
    EXPECT_THAT(parts.notes.text(), HasSubstr("that no body can have, by their mean: thigh"));
  }
  EXPECT_THAT(mjcf(R"(diaginertia="0.01 0.02 0.03")").notes.text(), Not(HasSubstr("by their mean")));
  EXPECT_THAT(mjcf(R"(diaginertia="-0.01 -0.01 -0.01")").notes.text(),
              HasSubstr("negative masses or moments of inertia, which are taken as not given: thigh"));
}

TEST(Masses, WithMomentsThatADigitMakesImpossibleKeepTheirShape) {
  const Files files;
  for (const char* moments :
       {R"(diaginertia="1e-4 7e-4 8.001e-4")", R"(fullinertia="1e-4 7e-4 8.001e-4 0 0 0")"}) {
    const ModelParts parts =
        parts_of(files, "m.xml",
                 with(one_leg_xml, thigh_geom,
                      std::string("<inertial pos=\"0 0 -0.2\" mass=\"2\" ") + moments + "/>" + thigh_geom));
    const Vec3 found = body(parts, "thigh").inertia_kg_m2;
    std::array principal{found.x, found.y, found.z};
    std::ranges::sort(principal);
    EXPECT_NEAR(principal[0], 1e-4, 2e-7) << moments;
    EXPECT_NEAR(principal[1], 7e-4, 2e-7);
    EXPECT_NEAR(principal[2], 8e-4, 4e-7);
    EXPECT_THAT(parts.notes.text(), HasSubstr("too unequal by less than a hundredth, by ones that a body can "
                                              "have: thigh"));
  }
}

TEST(Masses, WithMomentsOfABodyLargerThanTheRobotHaveThoseOfTheirShapesInBothFormats) {
  const Files files;
  const auto thigh = [&](const std::string& moment) {
    const std::string inertial =
        fmt::format(R"(<inertial pos="0 0 -0.2" mass="2" diaginertia="{0} {0} {0}"/>)", moment);
    return parts_of(files, "m.xml", with(one_leg_xml, thigh_geom, inertial + thigh_geom));
  };
  // The robot reaches about a metre: 2 kg of it can have some 16 kg m² in sum.
  EXPECT_EQ(body(thigh("2"), "thigh").inertia_kg_m2.x, 2.0);
  const ModelParts mjcf = thigh("100");
  EXPECT_EQ(body(mjcf, "thigh").mass_kg, 2.0);
  EXPECT_LT(body(mjcf, "thigh").inertia_kg_m2.x, 2.0 * 0.25 / 12.0);
  EXPECT_THAT(mjcf.notes.text(), HasSubstr("larger than the robot, by those of the shapes with the body's "
                                           "mass; check inertia, mass and units: thigh"));

  std::string urdf = urdf_with_effort();
  for (std::size_t at = urdf.find("\"0.01\""); at != std::string::npos; at = urdf.find("\"0.01\""))
    urdf.replace(at, 6, "\"100\"");
  const ModelParts template_urdf = parts_of(files, "r.urdf", urdf);
  EXPECT_NEAR(body(template_urdf, "left_shin").inertia_kg_m2.x, 0.4 * 0.3 * 0.0009, 1e-9);
  EXPECT_EQ(body(template_urdf, "left_thigh").inertia_kg_m2.x, 100.0) << "it has no shape";
  EXPECT_THAT(template_urdf.notes.text(), HasSubstr("larger than the robot"));
}

TEST(Limits, ThatAreCrossedOrEmptyAreMendedInBothFormatsAndNamed) {
  const Files files;
  const std::string joint = R"(name="A_knee" type="hinge" axis="0 1 0" limited="true" range="-0.7 0")";
  const auto mjcf = [&](const std::string& limits) {
    return parts_of(files, "m.xml",
                    with(one_leg_xml, joint, R"(name="A_knee" type="hinge" axis="0 1 0" )" + limits));
  };
  for (const char* crossed : {R"(limited="true" range="0 -0.7")", R"(range="0 -0.7")"}) {
    const ModelParts parts = mjcf(crossed);
    EXPECT_EQ(parts.joints[1].lower_rad, -0.7) << crossed;
    EXPECT_EQ(parts.joints[1].upper_rad, 0.0);
    EXPECT_THAT(parts.notes.text(), HasSubstr("put the right way round: A_knee (0 to -0.7)"));
  }
  for (const char* empty : {R"(limited="true" range="0 0")", R"(range="0 0")", R"(range="0.3 0.3")"}) {
    const ModelParts parts = mjcf(empty);
    EXPECT_TRUE(std::isinf(parts.joints[1].upper_rad)) << empty;
    EXPECT_THAT(parts.notes.text(),
                HasSubstr("leave no range, as exporters write them where none are known: these "
                          "joints have no stops: A_knee"));
  }
  EXPECT_THAT(mjcf(R"(limited="false" range="0 0")").notes.text(), Not(HasSubstr("no stops")));
  const std::string actuator =
      R"(</worldbody><actuator><motor name="m" joint="A_hip" ctrllimited="true" ctrlrange="1 -1"
    forcelimited="true" forcerange="0 0"/></actuator>)";
  EXPECT_THAT(parts_of(files, "m.xml", with(one_leg_xml, "</worldbody>", actuator)).notes.text(),
              HasSubstr("m (1 to -1)"));
  const ModelParts urdf = parts_of(
      files, "r.urdf", with(urdf_with_effort(), R"(lower="-1" upper="1")", R"(lower="1" upper="-0.5")"));
  EXPECT_EQ(urdf.joints[0].lower_rad, -0.5);
  EXPECT_EQ(urdf.joints[0].upper_rad, 1.0);
}

TEST(RobotGuess, WeldsLinksThatWeighNextToNothing) {
  const Files files;
  const auto guess = [&](const char* mass) {
    const std::string finger = fmt::format(
        R"(<link name="finger"><inertial><mass value="{0}"/><inertia ixx="1e-9" iyy="1e-9" izz="1e-9" ixy="0" ixz="0"
        iyz="0"/></inertial></link><joint name="grip" type="revolute"><parent link="base"/><child link="finger"/>
        <origin xyz="0 0 0.1"/><axis xyz="0 1 0"/><limit lower="0" upper="1" effort="3" velocity="5"/></joint></robot>)",
        mass);
    return guess_robot(compile_model(files.write("r.urdf", with(urdf_with_effort(), "</robot>", finger))),
                       "r.urdf")
        .toml;
  };
  EXPECT_THAT(guess("2e-6"), HasSubstr("fixed = [\"grip\"]"));
  EXPECT_THAT(guess("0.01"), HasSubstr("held = [\"grip\"]"));
}

TEST(RobotGuess, DoubtsLimitsOfSpeedAtWhichLegsCrawl) {
  const Files files;
  const auto doubts = [&](const char* velocity) {
    std::string text = urdf_with_effort();
    for (std::size_t at = text.find("velocity=\"5\""); at != std::string::npos;
         at = text.find("velocity=\"5\""))
      text.replace(at, 12, std::string("velocity=\"") + velocity + "\"");
    return fmt::format(
        "{}", fmt::join(guess_robot(compile_model(files.write("r.urdf", text)), "r.urdf").doubts, "\n"));
  };
  EXPECT_THAT(doubts("0.5"), HasSubstr("walk at a crawl, as templates have them: left_"));
  for (const char* usual : {"3", "0", "50"}) EXPECT_THAT(doubts(usual), Not(HasSubstr("crawl"))) << usual;
}

}  // namespace
}  // namespace amble::morphology
