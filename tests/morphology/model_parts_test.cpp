#include "amble/morphology/model_parts.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "amble/robot/pose.hpp"
#include "tests/morphology/files.hpp"

namespace amble::morphology {
namespace model_parts_test {

ModelParts parts_of(const Files& files, const std::string& text, const std::string& name = "m.xml") {
  return extract_parts(compile_model(files.write(name, text)));
}

/// Inertia about the centre of mass and along a direction of the body's frame.
double moment_about(const robot::Body& body, Vec3 direction) {
  const Vec3 d = rotate(conjugate(body.inertia_rotation), direction);
  return body.inertia_kg_m2.x * d.x * d.x + body.inertia_kg_m2.y * d.y * d.y +
         body.inertia_kg_m2.z * d.z * d.z;
}

TEST(ExtractParts, ReadsBodiesJointsAndGeoms) {
  const Files files;
  const ModelParts parts = parts_of(files, one_leg_xml);
  ASSERT_EQ(parts.bodies.size(), 3u);
  EXPECT_EQ(parts.bodies[0].parent, -1);
  EXPECT_EQ(parts.bodies[2].parent, 1);
  EXPECT_EQ(parts.bodies[2].name, "shin");
  EXPECT_EQ(parts.bodies[2].position_m, (Vec3{0.0, 0.0, -0.4}));
  ASSERT_EQ(parts.joints.size(), 2u);
  EXPECT_EQ(parts.joints[1].name, "A_knee");
  EXPECT_EQ(parts.joints[1].body, 2);
  EXPECT_EQ(parts.joints[1].lower_rad, -0.7);
  ASSERT_EQ(parts.geoms.size(), 4u);
  EXPECT_EQ(parts.geoms[0].shape, robot::Shape::box);
  EXPECT_EQ(parts.geoms[0].size_m, (Vec3{0.2, 0.1, 0.05}));
  EXPECT_EQ(parts.geoms[1].shape, robot::Shape::capsule);
  EXPECT_NEAR(parts.geoms[1].size_m.y, 0.2, 1e-15);
  EXPECT_EQ(parts.geoms[2].shape, robot::Shape::cylinder);
  EXPECT_EQ(parts.geoms[3].shape, robot::Shape::sphere);
  EXPECT_EQ(parts.gravity_m_s2, (Vec3{0.0, 0.0, -9.8}));
}

TEST(ExtractParts, FusesABodyThatIsFixedToItsParent) {
  const Files files;
  const ModelParts whole = parts_of(files, one_leg_xml);
  // The same foot as a body of its own, turned and without a joint.
  const ModelParts split = parts_of(
      files,
      with(
          one_leg_xml, R"(<geom name="A_foot" type="sphere" pos="0 0 -0.4" size="0.06" mass="0.25"/>)",
          R"(<body name="foot" pos="0.1 0 -0.3" euler="0 0.7 0.2"><body name="sole" pos="0 0.1 0"><geom name="A_foot"
                     type="sphere" pos="0 0 -0.1" size="0.06" mass="0.25"/></body></body>)"));
  ASSERT_EQ(split.bodies.size(), 3u);
  ASSERT_EQ(split.geoms.size(), 4u);
  const robot::Body& shin = split.bodies[2];
  const robot::Geom& foot = split.geoms[3];
  EXPECT_EQ(foot.body, 2);
  EXPECT_DOUBLE_EQ(shin.mass_kg, 0.75);

  // Against sums by hand: cylinder 0.5 kg at −0.2, sphere 0.25 kg wherever the foot is.
  const Vec3 centre = (1.0 / 0.75) * (0.5 * Vec3{0.0, 0.0, -0.2} + 0.25 * foot.position_m);
  EXPECT_NEAR(norm(shin.com_m - centre), 0.0, 1e-12);
  const double sphere = 0.4 * 0.25 * 0.06 * 0.06;
  const double across = 0.5 * (3 * 0.04 * 0.04 + 0.4 * 0.4) / 12;
  const double along = 0.5 * 0.5 * 0.04 * 0.04;
  const auto about = [&](Vec3 axis, double cylinder) {
    const auto distance2 = [&](Vec3 at) { return dot(cross(axis, at - centre), cross(axis, at - centre)); };
    return cylinder + 0.5 * distance2({0.0, 0.0, -0.2}) + sphere + 0.25 * distance2(foot.position_m);
  };
  EXPECT_NEAR(moment_about(shin, {1, 0, 0}), about({1, 0, 0}, across), 1e-12);
  EXPECT_NEAR(moment_about(shin, {0, 1, 0}), about({0, 1, 0}, across), 1e-12);
  EXPECT_NEAR(moment_about(shin, {0, 0, 1}), about({0, 0, 1}, along), 1e-12);
  const Vec3 slanted{0.6, 0.0, 0.8};
  EXPECT_NEAR(moment_about(shin, slanted), about(slanted, 0.36 * across + 0.64 * along), 1e-12);
  EXPECT_EQ(whole.bodies[2].mass_kg, 0.75);
}

TEST(ExtractParts, CountsAnglesFromTheStartPose) {
  const Files files;
  const ModelParts parts =
      parts_of(files, with(one_leg_xml, R"(range="-0.7 0")", R"(range="-0.7 0" ref="-0.2")"));
  EXPECT_DOUBLE_EQ(parts.joints[1].lower_rad, -0.5);
  EXPECT_DOUBLE_EQ(parts.joints[1].upper_rad, 0.2);
}

TEST(ExtractParts, NamesGeomsThatHaveNoName) {
  const Files files;
  std::string text = with(one_leg_xml, "name=\"thigh\" type", "type");
  text = with(with(text, "name=\"shin\" type", "type"), "name=\"A_foot\" type", "type");
  const ModelParts parts = parts_of(files, text);
  EXPECT_EQ(parts.geoms[1].name, "thigh");
  EXPECT_EQ(parts.geoms[2].name, "shin.0");
  EXPECT_EQ(parts.geoms[3].name, "shin.1");
}

TEST(ExtractParts, LeavesOutTheGroundAndKeepsDecoration) {
  const Files files;
  const std::string decorated = with(
      with(
          one_leg_xml, "<worldbody>",
          R"(<worldbody><geom type="plane" size="1 1 1"/><geom type="box" size="1 1 1" contype="0" conaffinity="0"/>)"),
      R"(<geom name="A_foot")",
      R"(<geom name="nose" type="box" size="0.1 0.1 0.1" mass="0" contype="0" conaffinity="0"/><geom name="A_foot")");
  const ModelParts parts = parts_of(files, decorated);
  ASSERT_EQ(parts.geoms.size(), 5u);
  EXPECT_EQ(parts.geoms[3].name, "nose");
  EXPECT_FALSE(parts.geoms[3].collides);
  EXPECT_TRUE(parts.geoms[4].collides);
}

TEST(ExtractParts, FreesTheRootOfAUrdf) {
  const Files files;
  const std::string inertia = R"(<inertia ixx="0.1" iyy="0.1" izz="0.1" ixy="0" ixz="0" iyz="0"/>)";
  const ModelParts parts = parts_of(files,
                                    R"(<robot name="r">
    <link name="base"><inertial><mass value="2"/>)" +
                                        inertia + R"(</inertial></link>
    <link name="leg"><inertial><mass value="1"/>)" +
                                        inertia + R"(</inertial></link>
    <link name="foot"><inertial><mass value="0.5"/>)" +
                                        inertia + R"(</inertial>
      <collision><geometry><sphere radius="0.05"/></geometry></collision></link>
    <joint name="hip" type="revolute"><parent link="base"/><child link="leg"/><origin xyz="0 0 -0.5"/><axis xyz="0 1 0"/>
      <limit lower="-1" upper="1" effort="5" velocity="3"/></joint>
    <joint name="ankle" type="fixed"><parent link="leg"/><child link="foot"/><origin xyz="0 0 -0.3"/></joint>
  </robot>)",
                                    "r.urdf");
  ASSERT_EQ(parts.bodies.size(), 2u);
  EXPECT_EQ(parts.bodies[0].name, "base");
  EXPECT_EQ(parts.bodies[0].mass_kg, 2.0);
  EXPECT_DOUBLE_EQ(parts.bodies[1].mass_kg, 1.5);
  EXPECT_NEAR(parts.bodies[1].com_m.z, -0.1, 1e-15);
  EXPECT_EQ(parts.bodies[1].position_m, (Vec3{0.0, 0.0, -0.5}));
  ASSERT_EQ(parts.joints.size(), 1u);
  EXPECT_EQ(parts.joints[0].body, 1);
  ASSERT_EQ(parts.geoms.size(), 1u);
  EXPECT_EQ(parts.geoms[0].name, "foot");
  EXPECT_EQ(parts.geoms[0].body, 1);
  EXPECT_EQ(parts.geoms[0].position_m, (Vec3{0.0, 0.0, -0.3}));
}

TEST(ExtractParts, NamesWhatAUrdfShowsApartFromWhatCollides) {
  const Files files;
  const auto names = [&](const std::string& shapes) {
    std::vector<std::string> all;
    for (const robot::Geom& geom : parts_of(files,
                                            R"(<robot name="r"><link name="base"><inertial><mass value="2"/>
      <inertia ixx="1" iyy="1" izz="1" ixy="0" ixz="0" iyz="0"/></inertial>)" +
                                                shapes + "</link></robot>",
                                            "r.urdf")
                                       .geoms)
      all.push_back(geom.name + (geom.collides ? "" : " shown"));
    return all;
  };
  const auto shape = [](const std::string& kind, const std::string& radius) {
    return "<" + kind + R"(><geometry><sphere radius=")" + radius + R"("/></geometry></)" + kind + ">";
  };
  const std::string seen = shape("visual", "1") + shape("visual", "2"), one = shape("collision", "3"),
                    two = one + shape("collision", "4");
  using Names = std::vector<std::string>;
  EXPECT_EQ(names(one), (Names{"base"}));
  EXPECT_EQ(names(two), (Names{"base.0", "base.1"}));
  EXPECT_EQ(names(shape("visual", "1") + one), (Names{"base.visual shown", "base"}));
  EXPECT_EQ(names(one + seen), (Names{"base", "base.visual.0 shown", "base.visual.1 shown"}));
  EXPECT_EQ(names(seen + two), (Names{"base.visual.0 shown", "base.visual.1 shown", "base.0", "base.1"}));
}

TEST(ExtractParts, RefusesWhatItCannotSimulateInOneLine) {
  const Files files;
  const auto error_of = [&](std::string_view from, std::string_view to) {
    return files.error_of([&] { parts_of(files, with(one_leg_xml, from, to)); });
  };
  EXPECT_EQ(error_of("type=\"hinge\" axis", "type=\"slide\" axis"),
            "m.xml: joint 'A_hip': only hinges are supported, no ball, slide or free joints");
  EXPECT_EQ(error_of(R"(type="hinge" axis="0 1 0" limited="true" range="-0.5 0.5")", "type=\"ball\""),
            "m.xml: joint 'A_hip': only hinges are supported, no ball, slide or free joints");
  EXPECT_EQ(
      error_of(
          "<worldbody>",
          R"(<worldbody><body><freejoint/><geom size="1"/><body><joint name="j"/><geom size="1"/></body></body>)"),
      "m.xml: expected one body in the world, the robot's root, but found 2; if they are limbs of one robot, "
      "put <body name=\"root\"><freejoint/> … "
      "</body> around them");
  EXPECT_EQ(
      error_of(
          "</worldbody>",
          R"(</worldbody><equality><connect name="loop" body1="shin" body2="torso" anchor="0 0 0"/></equality>)"),
      "m.xml: equality constraint 'loop': robots with closed loops are not supported");
}

TEST(ExtractParts, LeavesAFreeJointInMidChainToMujoco) {
  const Files files;
  const std::string line = files.error_of([&] {
    parts_of(files, with(one_leg_xml,
                         R"(<joint name="A_knee" type="hinge" axis="0 1 0" limited="true" range="-0.7 0"/>)",
                         "<freejoint/>"));
  });
  EXPECT_EQ(line.find("m.xml: MuJoCo refuses the model: "), 0u) << line;
  EXPECT_NE(line.find("free joint"), std::string::npos) << line;
}

TEST(ExtractParts, TakesABodyWithoutMassForAPlaceOnlyAndChangesNoBit) {
  const Files files;
  const std::string thigh = R"(<body name="thigh" pos="0 0 -0.1">)",
                    mount = R"(<body pos="0.1 0.2 0.3"><site/></body>)",
                    mass = R"(<inertial pos="0.01 0.02 -0.13" mass="0.37"
                               fullinertia="0.011 0.013 0.009 0.001 0.002 0.0005"/>)";
  const ModelParts plain = parts_of(files, with(one_leg_xml, thigh, thigh + mass));
  const std::string xml = with(one_leg_xml, thigh, thigh + mass + mount);
  const ModelParts mounted = parts_of(files, xml);
  ASSERT_EQ(mounted.bodies.size(), plain.bodies.size());
  for (std::size_t b = 0; b < plain.bodies.size(); ++b) {
    EXPECT_EQ(mounted.bodies[b].mass_kg, plain.bodies[b].mass_kg) << b;
    EXPECT_EQ(mounted.bodies[b].com_m, plain.bodies[b].com_m) << b;
    EXPECT_EQ(mounted.bodies[b].inertia_kg_m2, plain.bodies[b].inertia_kg_m2) << b;
    EXPECT_EQ(mounted.bodies[b].inertia_rotation, plain.bodies[b].inertia_rotation) << b;
  }
}

TEST(ExtractParts, KeepsMoreCornersOfWhatIsToLookAtThanOfWhatCollides) {
  const Files files;
  // Corners on a sphere, so that each is one of the hull.
  std::string vertices;
  for (int i = 0; i < 80; ++i) {
    const double z = (2 * i + 1) / 80.0 - 1.0, r = std::sqrt(1.0 - z * z);
    vertices += fmt::format("{} {} {} ", r * std::cos(2.4 * i), r * std::sin(2.4 * i), z);
  }
  std::string xml = with(one_leg_xml, "<worldbody>",
                         "<asset><mesh name=\"ball\" vertex=\"" + vertices + "\"/></asset><worldbody>");
  xml = with(xml, R"(<geom name="thigh")", R"(<geom name="shown" type="mesh" mesh="ball" mass="0" contype="0"
             conaffinity="0"/><geom name="felt" type="mesh" mesh="ball" mass="0"/><geom name="thigh")");
  const ModelParts parts = parts_of(files, xml);
  EXPECT_EQ(parts.geoms[1].vertices_m.size(), 80u);
  EXPECT_EQ(parts.geoms[2].vertices_m.size(), 32u);
}

TEST(ExtractParts, KeepsTheHalfAxesOfAnEllipsoid) {
  const Files files;
  const ModelParts parts = parts_of(
      files, with(one_leg_xml, R"(<geom name="thigh")",
                  R"(<geom name="egg" type="ellipsoid" size="0.1 0.2 0.3" mass="0"/><geom name="thigh")"));
  const auto egg = std::ranges::find(parts.geoms, "egg", &robot::Geom::name);
  ASSERT_NE(egg, parts.geoms.end());
  Vec3 most;
  for (const Vec3 corner : egg->vertices_m)
    most = {std::max(most.x, corner.x), std::max(most.y, corner.y), std::max(most.z, corner.z)};
  EXPECT_NEAR(most.x, 0.1, 0.01);
  EXPECT_NEAR(most.y, 0.2, 0.02);
  EXPECT_NEAR(most.z, 0.3, 0.03);
}

}  // namespace model_parts_test
}  // namespace amble::morphology
