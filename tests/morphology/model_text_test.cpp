#include "amble/morphology/model_text.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <mujoco/mujoco.h>
#include <array>
#include <cmath>
#include <filesystem>
#include <initializer_list>
#include <string>

#include "amble/core/random.hpp"
#include "amble/morphology/mesh_file.hpp"
#include "amble/morphology/model_file.hpp"
#include "amble/morphology/model_parts.hpp"
#include "amble/morphology/number_text.hpp"
#include "tests/models/small_models.hpp"
#include "tests/morphology/files.hpp"

namespace amble::morphology {
namespace {

using testing::HasSubstr;
using testing::Not;

/// The attributes of a joint that give this number, to amble and to MuJoCo; none for 0.
std::string attributes(int number) {
  return number == 0 ? "" : fmt::format(R"( actuatorfrcrange="-{0} {0}" armature="{0}")", number);
}
std::string joint_default(int number) {
  return number == 0 ? "" : fmt::format("<joint{}/>", attributes(number));
}

TEST(ModelText, FindsDefaultsOfAttributesThatMujocoDoesNotKnowAsItFindsThoseOfOthers) {
  const Files files;
  for (std::uint32_t i = 0; i < 100; ++i) {
    Stream stream(1, Purpose::test, i);
    const auto draw = [&](std::initializer_list<const char*> all) {
      return std::string(all.begin()[stream.below(static_cast<std::uint32_t>(all.size()))]);
    };
    // The joint, classes inner and outer, the top one and the same again: which of them give a number.
    std::array<int, 5> number{};
    for (std::size_t place = 0; place < number.size(); ++place)
      number[place] = stream.chance(0.3) ? static_cast<int>(place) + 1 : 0;
    const std::string top = draw({"", R"( class="main")", R"( class="robot")"});
    std::string xml = with(
        one_leg_xml, "<option",
        fmt::format(R"(<default{0}>{1}<default class="outer">{2}<default class="inner">{3}</default></default>
                            <default class="other">{4}</default></default><default{0}>{5}</default><option)",
                    top, joint_default(number[3]), joint_default(number[2]), joint_default(number[1]),
                    joint_default(9), joint_default(number[4])));
    xml = with(xml, R"(<body name="thigh")",
               R"(<body name="thigh")" + draw({"", R"( childclass="inner")", R"( childclass="TOP")"}));
    xml = with(xml, R"(name="A_hip")",
               R"(name="A_hip")" + attributes(number[0]) +
                   draw({"", "", R"( class="inner")", R"( class="outer")", R"( class="TOP")"}));
    for (std::size_t at = xml.find("TOP"); at != std::string::npos; at = xml.find("TOP"))
      xml.replace(at, 3, top.find("robot") != std::string::npos ? "robot" : "main");
    const ModelFile file = compile_model(files.write("m.xml", xml));
    const auto found = file.motors.find("A_hip");
    ASSERT_EQ(found == file.motors.end() ? 0.0 : found->second.max_torque_nm, file.model->dof_armature[6])
        << xml;
  }
}

TEST(ModelText, LosesAnAttributeOnlyWhereMujocoDoesNotKnowIt) {
  // MuJoCo 2.2 knows kv of <velocity>, and not of <position>.
  const Files files;
  const ModelFile file = compile_model(
      files.write("m.xml", with(one_leg_xml, "</worldbody>",
                                R"(</worldbody><actuator><position joint="A_hip" kp="20" kv="2"/>
                                   <velocity joint="A_knee" kv="5"/></actuator>)")));
  EXPECT_THAT(file.notes.text(), HasSubstr("attribute 'kv' of <position>"));
  EXPECT_THAT(file.notes.text(), Not(HasSubstr("of <velocity>")));
  ASSERT_EQ(file.model->nu, 2);
  EXPECT_EQ(file.model->actuator_gainprm[0], 20.0);
  EXPECT_EQ(file.model->actuator_gainprm[mjNGAIN], 5.0);
  EXPECT_EQ(file.motors.at("A_hip").kv_nm_s_per_rad, 2.0);
  EXPECT_FALSE(file.motors.contains("A_knee"));
}

class Meshes : public testing::Test {
 protected:
  Meshes() {
    for (const char* folder : {"assets", "meshes"}) std::filesystem::create_directories(files_.path(folder));
  }

  /// The robot with a tetrahedron to look at, of this file.
  ModelParts parts(const std::string& compiler) const {
    std::string xml = with(one_leg_xml, R"(<compiler angle="radian"/>)",
                           fmt::format(R"(<compiler angle="radian" {}/>)", compiler));
    xml = with(xml, "<worldbody>", R"(<asset><mesh name="shell" file="shell.obj"/></asset><worldbody>)");
    xml = with(xml, R"(<geom name="thigh")",
               R"(<geom type="mesh" mesh="shell" mass="0" contype="0" conaffinity="0"/><geom name="thigh")");
    return extract_parts(compile_model(files_.write("m.xml", xml)));
  }
  /// Writes it with an edge of this length.
  void write(const std::string& name, double edge_m) const {
    files_.write(name,
                 fmt::format("v 0 0 0\nv {0} 0 0\nv 0 {0} 0\nv 0 0 {0}\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n",
                             edge_m));
  }
  /// Length of its longest edge, or 0 if it is left out.
  static double edge_m(const ModelParts& parts) {
    double longest_m = 0.0;
    for (const robot::Geom& geom : parts.geoms)
      for (const Vec3 a : geom.vertices_m)
        for (const Vec3 b : geom.vertices_m) longest_m = std::max(longest_m, norm(a - b));
    return longest_m / std::sqrt(2.0);
  }
  Files files_;
};

TEST_F(Meshes, AreInTheFolderForMeshesOrElseInThatForAllAssets) {
  write("shell.obj", 0.1);
  write("assets/shell.obj", 0.2);
  write("meshes/shell.obj", 0.3);
  EXPECT_NEAR(edge_m(parts("")), 0.1, 1e-6);
  EXPECT_NEAR(edge_m(parts(R"(assetdir="assets")")), 0.2, 1e-6);
  EXPECT_NEAR(edge_m(parts(R"(meshdir="meshes")")), 0.3, 1e-6);
  EXPECT_NEAR(edge_m(parts(R"(meshdir="meshes" assetdir="assets")")), 0.3, 1e-6);
  EXPECT_NEAR(edge_m(parts(R"(assetdir="assets" meshdir="meshes")")), 0.3, 1e-6);
}

TEST_F(Meshes, ThatAreTooLargeAreNotRead) {
  write("shell.obj", 0.1);
  EXPECT_EQ(parts("").geoms.size(), 5u);
  std::filesystem::resize_file(files_.path("shell.obj"), largest_mesh_bytes + 1);
  const ModelParts found = parts("");
  EXPECT_EQ(found.geoms.size(), 4u);
  EXPECT_THAT(found.notes.text(), HasSubstr("whose mesh cannot be read: shell.obj ("));
}

TEST(ModelText, TakesOnlyPositiveNumbersBelowABillion) {
  EXPECT_EQ(positive_or_zero("0.25"), 0.25);
  EXPECT_EQ(positive_or_zero("999999999"), 999999999.0);
  for (const char* text : {"1e9", "inf", "nan", "0", "-1", "fast", ""})
    EXPECT_EQ(positive_or_zero(text), 0.0) << text;
  EXPECT_EQ(positive_or_zero(std::nullopt), 0.0);
}

class TreeFaults : public testing::Test {
 protected:
  std::string refusal(const std::string& text, const std::string& name) {
    return files_.error_of([&] { compile_model(files_.write(name, text)); });
  }
  Files files_;
};

/// A joint from one link to another.
std::string joint(const std::string& name, const std::string& parent, const std::string& child) {
  return R"(<joint name=")" + name + R"(" type="fixed"><parent link=")" + parent + R"("/><child link=")" +
         child + "\"/></joint>\n";
}

std::string urdf(const std::vector<std::string>& links, const std::string& joints) {
  std::string text = "<robot name=\"r\">\n";
  for (const std::string& link : links) text += "<link name=\"" + link + "\"/>\n";
  return text + joints + "</robot>";
}

TEST_F(TreeFaults, ANameThatIsThereTwiceIsToldWithBothPlaces) {
  EXPECT_EQ(refusal(urdf({"a", "b", "a"}, joint("j", "a", "b")), "r.urdf"),
            "r.urdf:4: a second link is called 'a', as that of r.urdf:2 is: each needs a name of its own");
  EXPECT_EQ(refusal(urdf({"a", "b", "c"}, joint("j", "a", "b") + joint("j", "a", "c")), "r.urdf"),
            "r.urdf:6: a second joint is called 'j', as that of r.urdf:5 is: each needs a name of its own");
  EXPECT_EQ(refusal(with(one_leg_xml, "A_knee", "A_hip"), "m.xml").substr(0, 33),
            "m.xml:12: a second joint is calle");
  EXPECT_EQ(refusal(with(one_leg_xml, R"(body name="shin")", R"(body name="thigh")"), "m.xml"),
            "m.xml:11: a second body is called 'thigh', as that of m.xml:8 is: each needs a name of its own");
  EXPECT_EQ(
      refusal(with(one_leg_xml, R"(geom name="shin")", R"(geom name="thigh")"), "m.xml"),
      "m.xml:13: a second geom is called 'thigh', as that of m.xml:10 is: each needs a name of its own");
  EXPECT_EQ(refusal(with(one_leg_xml, R"(body name="shin")", R"(body name="A_hip")"), "m.xml"), "accepted")
      << "parts of different kinds";
}

TEST_F(TreeFaults, LinksThatAreNoTreeAreNamed) {
  const std::string chain = joint("j1", "a", "b") + joint("j2", "b", "c");
  EXPECT_EQ(
      refusal(urdf({"a", "b", "c"}, chain + joint("j3", "c", "a")), "r.urdf"),
      "r.urdf:7: links hang on each other in a loop: 'a' on 'c' on 'b' on 'a', by the joints 'j3', 'j2', "
      "'j1': a robot's links are a tree, with one link that no joint has as its child");
  EXPECT_THAT(
      refusal(urdf({"a", "b", "c"}, joint("j1", "a", "b") + joint("j2", "b", "b")), "r.urdf"),
      testing::HasSubstr("link 'b' is the child of two joints, 'j2' and 'j1' of r.urdf:5: closed loops"));
  EXPECT_THAT(refusal(urdf({"a", "b"}, joint("j1", "a", "b") + joint("j2", "b", "b2")), "r.urdf"),
              testing::HasSubstr("r.urdf:5: joint 'j2' names the link 'b2', which is not there"));
  EXPECT_THAT(
      refusal(urdf({"a", "b"}, R"(<joint name="j" type="fixed"><parent link="a"/></joint>)"), "r.urdf"),
      testing::HasSubstr("r.urdf:4: joint 'j' has no <child link=\"…\"/>"));
  EXPECT_THAT(refusal(urdf({"top", "a", "b"}, joint("j0", "b", "a") + joint("j1", "a", "b")), "r.urdf"),
              testing::HasSubstr("'a' on 'b' on 'a'"));
}

}  // namespace

}  // namespace amble::morphology
