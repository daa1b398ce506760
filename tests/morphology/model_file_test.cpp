#include "amble/morphology/model_file.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <mujoco/mujoco.h>

#include <string>

#include "tests/morphology/files.hpp"

namespace amble::morphology {
namespace {

TEST(CompileModel, SaysThatAFileIsMissing) {
  const Files files;
  try {
    compile_model(files.path("absent.xml"));
    FAIL();
  } catch (const UserError& error) {
    EXPECT_EQ(error.code(), ExitCode::io);
    EXPECT_NE(std::string(error.what()).find("absent.xml"), std::string::npos);
  }
}

TEST(CompileModel, PassesOnWhatMujocoSaysInOneLine) {
  const Files files;
  const auto error_of = [&](const std::string& text) {
    const auto path = files.write("bad.xml", text);
    return files.error_of([&] { compile_model(path); });
  };
  for (const std::string& text :
       {std::string("<nothing/>"), with(one_leg_xml, "type=\"box\"", "type=\"bux\""),
        with(one_leg_xml, "mass=\"3\"", "mass=\"-3\""),
        with(with(one_leg_xml, "<worldbody>", "<wordbody>"), "</worldbody>", "</wordbody>")}) {
    const std::string line = error_of(text);
    EXPECT_EQ(line.find("bad.xml: MuJoCo refuses the model: "), 0u) << line;
    EXPECT_EQ(line.find('\n'), std::string::npos) << line;
    EXPECT_GT(line.size(), 45u) << line;
  }
  EXPECT_NE(error_of(with(one_leg_xml, "type=\"box\"", "type=\"bux\"")).find("bux"), std::string::npos);
  EXPECT_EQ(error_of(""), "bad.xml:1: no XML that can be read: expected an element, but the file ends");
  EXPECT_EQ(error_of("no xml at all"), "bad.xml:1: no XML that can be read: expected '<'");
  EXPECT_EQ(error_of(with(one_leg_xml, "</mujoco>", "")),
            "bad.xml:20: no XML that can be read: </mujoco> is missing");
}

TEST(CompileModel, RefusesAMovingBodyWithoutMass) {
  const Files files;
  const auto path = files.write("bad.xml", with(one_leg_xml, "mass=\"1\"", "mass=\"0\""));
  const std::string line = files.error_of([&] { compile_model(path); });
  EXPECT_NE(line.find("mass and inertia of moving bodies must be larger than mjMINVAL"), std::string::npos)
      << line;
}

TEST(CompileModel, KeepsTheRootLinkOfAUrdf) {
  const Files files;
  const std::string urdf = R"(<robot name="r"><link name="base"><inertial><mass value="2"/>
    <inertia ixx="1" iyy="1" izz="1" ixy="0" ixz="0" iyz="0"/></inertial></link></robot>)";
  const ModelFile compiled = compile_model(files.write("r.urdf", urdf));
  EXPECT_TRUE(compiled.root_is_welded);
  ASSERT_EQ(compiled.model->nbody, 2);
  EXPECT_EQ(compiled.model->body_mass[1], 2.0);

  const auto error_of = [&](const std::string& text) {
    const auto path = files.write("r.urdf", text);
    return files.error_of([&] { compile_model(path); });
  };
  EXPECT_EQ(
      error_of(with(urdf, "<link", "<mujoco><compiler/></mujoco><link")),
      "r.urdf: the element <mujoco> must hold <compiler fusestatic=\"false\"/>, or the root link is lost");
  EXPECT_EQ(error_of("<nothing/>"), "r.urdf: a URDF needs an element <robot>");
}

TEST(CompileModel, TakesTheMeanOfMomentsThatNoBodyCanHave) {
  const Files files;
  const auto urdf = [](const std::string& moments) {
    return R"(<robot name="r"><link name="base"><inertial><mass value="2"/><inertia )" + moments +
           R"(/></inertial></link></robot>)";
  };
  const ModelFile impossible = compile_model(files.write(
      "r.urdf", urdf(R"(ixx="0.5" iyy="0.5" izz="0.2" ixy="0.4" ixz="0" iyz="0")")));  // 0.9, 0.2, 0.1
  for (int i = 0; i < 3; ++i) EXPECT_NEAR(impossible.model->body_inertia[3 + i], 0.4, 1e-6);
  EXPECT_THAT(impossible.notes.text(), testing::HasSubstr("by their mean: base"));
  const ModelFile possible = compile_model(
      files.write("r.urdf", urdf(R"(ixx="0.5" iyy="0.5" izz="0.8" ixy="0.1" ixz="0" iyz="0")")));
  EXPECT_NEAR(possible.model->body_inertia[3], 0.8, 1e-6);
  EXPECT_NEAR(possible.model->body_inertia[5], 0.4, 1e-6);
  EXPECT_EQ(possible.notes.text(), "");
}

TEST(CompileModel, FindsMeshesByThePackageInTheFoldersAbove) {
  const Files files;
  const std::string urdf = R"(<robot name="r"><link name="base"><inertial><mass value="2"/>
    <inertia ixx="1" iyy="1" izz="1" ixy="0" ixz="0" iyz="0"/></inertial><collision><geometry>
    <mesh filename="package://pkg/shapes/foot.obj"/></geometry></collision></link></robot>)";
  const std::string obj = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n";
  // In pkg/robots/r/r.urdf, and in a clone of the package under another name.
  for (const std::string package : {"pkg", "clone"}) {
    std::filesystem::create_directories(files.path(package + "/robots/r"));
    std::filesystem::create_directories(files.path(package + "/shapes"));
    const auto path = files.write(package + "/robots/r/r.urdf", urdf);
    EXPECT_THAT(files.error_of([&] { compile_model(path); }), testing::HasSubstr("meshes that are missing"));
    files.write(package + "/shapes/foot.obj", obj);
    EXPECT_EQ(compile_model(path).model->nmesh, 1);
    std::filesystem::remove_all(files.path(package));
  }
}

}  // namespace
}  // namespace amble::morphology
