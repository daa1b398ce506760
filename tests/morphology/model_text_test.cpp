#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <mujoco/mujoco.h>

#include <filesystem>
#include <string>

#include "amble/morphology/model_parts.hpp"
#include "tests/morphology/files.hpp"

namespace amble::morphology {
namespace {

using testing::HasSubstr;
using testing::Not;

std::string limit(int torque_nm) {
  return torque_nm == 0 ? "" : fmt::format(R"(<joint actuatorfrcrange="-{0} {0}"/>)", torque_nm);
}

TEST(ModelText, TakesAnAttributeFromTheNearestOfTheDefaultClassesThatHasIt) {
  const Files files;
  // Which of them give the attribute: the joint, its class, the class above that, and the top one.
  for (const std::string top : {"", R"( class="main")", R"( class="robot")"})
    for (int given = 0; given < 16; ++given)
      for (const bool by_childclass : {false, true}) {
        const auto value = [&](int place) { return (given & (1 << place)) != 0 ? place + 1 : 0; };
        const std::string defaults =
            fmt::format(R"(<default{}>{}<default class="outer">{}<default class="inner">{}</default></default>
                           <default class="other">{}</default></default><option)",
                        top, limit(value(3)), limit(value(2)), limit(value(1)), limit(9));
        std::string xml = with(one_leg_xml, "<option", defaults);
        xml = by_childclass ? with(xml, R"(<body name="thigh")", R"(<body name="thigh" childclass="inner")")
                            : with(xml, R"(name="A_hip")", R"(name="A_hip" class="inner")");
        if (value(0) != 0) xml = with(xml, R"(name="A_hip")", R"(name="A_hip" actuatorfrcrange="-1 1")");
        const ModelFile file = compile_model(files.write("m.xml", xml));
        int nearest = 0;
        for (int place = 3; place >= 0; --place)
          if (value(place) != 0) nearest = value(place);
        const auto found = file.motors.find("A_hip");
        EXPECT_EQ(found == file.motors.end() ? 0.0 : found->second.max_torque_nm, nearest)
            << top << " " << given << " " << by_childclass;
        EXPECT_FALSE(nearest == 0 && found != file.motors.end());
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
  std::filesystem::resize_file(files_.path("shell.obj"), 50'000'001);
  const ModelParts found = parts("");
  EXPECT_EQ(found.geoms.size(), 4u);
  EXPECT_THAT(found.notes.text(), HasSubstr("whose mesh is missing: shell.obj"));
}

}  // namespace
}  // namespace amble::morphology
