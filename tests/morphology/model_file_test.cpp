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
       {with(one_leg_xml, "type=\"box\"", "type=\"bux\""), with(one_leg_xml, "mass=\"3\"", "mass=\"-3\""),
        with(with(one_leg_xml, "<worldbody>", "<wordbody>"), "</worldbody>", "</wordbody>")}) {
    const std::string line = error_of(text);
    EXPECT_EQ(line.find("bad.xml: MuJoCo refuses the model: "), 0u) << line;
    EXPECT_EQ(line.find('\n'), std::string::npos) << line;
    EXPECT_GT(line.size(), 45u) << line;
  }
  EXPECT_NE(error_of(with(one_leg_xml, "type=\"box\"", "type=\"bux\"")).find("bux"), std::string::npos);
  EXPECT_EQ(error_of(""), "bad.xml:1: no XML that can be read: expected an element, but the file ends");
  EXPECT_EQ(error_of("no xml at all"), "bad.xml:1: no XML that can be read: expected '<'");
  EXPECT_EQ(error_of("<mujoco>\n" + std::string(1, '\0') + "</mujoco>"),
            "bad.xml:2: no XML that can be read: there is a zero byte, which no text has");
  EXPECT_EQ(error_of(with(one_leg_xml, "</mujoco>", "")),
            "bad.xml:20: no XML that can be read: </mujoco> is missing");
}

TEST(CompileModel, RefusesOtherFormatsByTheirFirstElement) {
  const Files files;
  for (const char* name : {"bad.xml", "bad.urdf"})
    EXPECT_EQ(
        files.error_of([&] { compile_model(files.write(name, "<nothing/>")); }),
        std::string(name) + ": its first element is <nothing>: expected MJCF, <mujoco>, or URDF, <robot>");
}

TEST(CompileModel, KeepsTheRootLinkOfAUrdf) {
  const Files files;
  const std::string urdf = R"(<robot name="r"><link name="base"><inertial><mass value="2"/>
    <inertia ixx="1" iyy="1" izz="1" ixy="0" ixz="0" iyz="0"/></inertial></link></robot>)";
  const ModelFile compiled = compile_model(files.write("r.urdf", urdf));
  EXPECT_TRUE(compiled.root_is_welded);
  ASSERT_EQ(compiled.model->nbody, 2);
  EXPECT_EQ(compiled.model->body_mass[1], 2.0);

  for (const char* extension :
       {"<mujoco/>", "<mujoco><compiler/></mujoco>", R"(<mujoco><compiler fusestatic="true"/></mujoco>)",
        R"(<mujoco><compiler meshdir="meshes" discardvisual="false"/></mujoco>)"}) {
    const auto same =
        compile_model(files.write("r.urdf", with(urdf, "<link", extension + std::string("<link"))));
    EXPECT_EQ(same.model->body_mass[1], 2.0) << extension;
  }
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

const std::string obj_text = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n";

TEST(CompileModel, FindsMeshesByThePackageInTheFoldersAbove) {
  const Files files;
  const std::string urdf = R"(<robot name="r"><link name="base"><inertial><mass value="2"/>
    <inertia ixx="1" iyy="1" izz="1" ixy="0" ixz="0" iyz="0"/></inertial><collision><geometry>
    <mesh filename="package://pkg/shapes/foot.obj"/></geometry></collision></link></robot>)";
  // In pkg/robots/r/r.urdf, and in a clone of the package under another name.
  for (const std::string package : {"pkg", "clone"}) {
    std::filesystem::create_directories(files.path(package + "/robots/r"));
    std::filesystem::create_directories(files.path(package + "/shapes"));
    const auto path = files.write(package + "/robots/r/r.urdf", urdf);
    EXPECT_EQ(compile_model(path).missing_meshes.begin()->second,
              "package://pkg/shapes/foot.obj (not found)");
    files.write(package + "/shapes/foot.obj", obj_text);
    EXPECT_THAT(compile_model(path).missing_meshes, testing::IsEmpty());
    std::filesystem::remove_all(files.path(package));
  }
}

/// A link with these shapes.
std::string urdf_with(const std::string& shapes) {
  return R"(<robot name="r"><link name="base"><inertial><mass value="2"/>
    <inertia ixx="1" iyy="1" izz="1" ixy="0" ixz="0" iyz="0"/></inertial>)" +
         shapes + "</link></robot>";
}

TEST(CompileModel, ShowsTheVisualShapesOfAUrdfWithoutWeight) {
  const Files files;
  const std::string box = R"(<geometry><box size="1 1 1"/></geometry>)",
                    collision = "<collision>" + box + "</collision>";
  const auto shapes_of = [&](const std::string& visuals) {
    return compile_model(files.write("r.urdf", urdf_with(visuals + collision)));
  };
  // The shape that collides, once more in the same place, adds nothing to see.
  EXPECT_EQ(shapes_of("<visual>" + box + "</visual>").model->ngeom, 1);
  const ModelFile moved = shapes_of(R"(<visual><origin xyz="0 0 1"/>)" + box + "</visual>");
  ASSERT_EQ(moved.model->ngeom, 2);
  EXPECT_EQ(moved.model->geom_contype[0] + moved.model->geom_conaffinity[0], 0);
  EXPECT_EQ(moved.model->body_mass[1], 2.0);
  EXPECT_EQ(moved.notes.text(), "");

  files.write("shape.obj", obj_text);
  EXPECT_EQ(shapes_of(R"(<visual><geometry><mesh filename="shape.obj"/></geometry></visual>)").model->nmesh,
            1);
  files.write("shape.dae", "<COLLADA/>");
  for (const char* name : {"shape.dae", "gone.stl"}) {
    const ModelFile without =
        shapes_of(R"(<visual><geometry><mesh filename=")" + std::string(name) + R"("/></geometry></visual>)");
    EXPECT_EQ(without.model->ngeom, 1);
    EXPECT_THAT(without.notes.text(),
                testing::HasSubstr("left out  what is only to look at and whose mesh cannot be read: " +
                                   std::string(name) + " of 'base' ("));
  }
  EXPECT_EQ(shapes_of("<visual/>").model->ngeom, 1);
}

TEST(CompileModel, RefusesNoUrdfForWhatIsOnlyToLookAt) {
  const Files files;
  files.write("torn.stl", std::string(84, '\1') + "torn off");  // its number of faces is another
  const auto with_mesh = [](const std::string& kind) {
    return "<" + kind + R"(><geometry><mesh filename="torn.stl"/></geometry></)" + kind + ">";
  };
  const ModelFile compiled = compile_model(files.write(
      "r.urdf", urdf_with(with_mesh("visual") +
                          R"(<collision><geometry><sphere radius="1"/></geometry></collision>)")));
  EXPECT_EQ(compiled.model->ngeom, 1);
  EXPECT_THAT(compiled.notes.text(),
              testing::HasSubstr("left out  what is only to look at and whose mesh cannot "
                                 "be read: torn.stl of 'base' (16843009 faces are announced"));
  EXPECT_EQ(compile_model(files.write("r.urdf", urdf_with(with_mesh("collision")))).missing_meshes.size(),
            1u);
}

}  // namespace
}  // namespace amble::morphology
