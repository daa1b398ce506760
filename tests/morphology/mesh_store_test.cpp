#include "amble/morphology/mesh_store.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <mujoco/mujoco.h>

#include <cmath>
#include <filesystem>
#include <string>

#include "amble/core/index.hpp"
#include "amble/morphology/mesh_file.hpp"
#include "amble/morphology/model_parts.hpp"
#include "amble/robot/pose.hpp"
#include "tests/morphology/files.hpp"

// Meshes of models as people's files have them.
namespace amble::morphology {
namespace {

using testing::HasSubstr;
using testing::Not;

const std::string inertial =
    R"(<inertial><mass value="1"/><inertia ixx="0.1" iyy="0.1" izz="0.1" ixy="0" ixz="0" iyz="0"/></inertial>)";

/// A box of these half lengths about a centre, as an OBJ; `first` is the number of its first corner.
std::string box_obj(Vec3 half, Vec3 at = {}, int first = 1) {
  std::string text;
  for (int i = 0; i < 8; ++i)
    text += fmt::format("v {} {} {}\n", at.x + (i & 1 ? half.x : -half.x), at.y + (i & 2 ? half.y : -half.y),
                        at.z + (i & 4 ? half.z : -half.z));
  for (const auto& f :
       {std::array{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}})
    text += fmt::format("f {} {} {} {}\n", f[0] + first, f[1] + first, f[2] + first, f[3] + first);
  return text;
}

std::string geometry(const std::string& kind, const std::string& mesh) {
  return "<" + kind + "><geometry><mesh filename=\"" + mesh + "\"/></geometry></" + kind + ">";
}

/// A trunk with these shapes, an arm upwards and two legs with a sphere each as their foot.
std::string robot_urdf(const std::string& trunk, const std::string& arm = "", const std::string& shin = "",
                       const std::string& foot =
                           "<collision><origin xyz=\"0 0 -0.2\"/><geometry><sphere "
                           "radius=\"0.02\"/></geometry></collision>") {
  std::string text = "<robot name=\"r\"><link name=\"trunk\">" + inertial + trunk +
                     "</link><link name=\"arm\">" + inertial + arm +
                     R"(</link><joint name="shoulder" type="revolute"><parent link="trunk"/>
      <child link="arm"/><origin xyz="0 0 0.3"/><axis xyz="0 1 0"/><limit lower="-1" upper="1"/></joint>)";
  for (const char* side : {"left", "right"})
    text += fmt::format(R"(<link name="{0}_shin">{1}{2}{3}</link><joint name="{0}_hip" type="revolute">
      <parent link="trunk"/><child link="{0}_shin"/><origin xyz="0 {4} -0.1"/><axis xyz="0 1 0"/>
      <limit lower="-1" upper="1" effort="5" velocity="9"/></joint>)",
                        side, inertial, shin, foot, side[0] == 'l' ? 0.1 : -0.1);
  return text + "</robot>";
}

class ModelMeshes : public testing::Test {
 protected:
  ModelParts parts(const std::string& urdf, const std::string& name = "r.urdf") const {
    return extract_parts(compile_model(files_.write(name, urdf)));
  }
  static const robot::Geom* geom(const ModelParts& parts, const std::string& name) {
    for (const robot::Geom& geom : parts.geoms)
      if (geom.name == name) return &geom;
    return nullptr;
  }
  /// Span of a mesh along x in its body's frame.
  static double width_m(const robot::Geom& geom) {
    double low = 1e9, high = -1e9;
    for (const Vec3 vertex : geom.vertices_m) {
      const double x = (geom.position_m + rotate(geom.rotation, vertex)).x;
      low = std::min(low, x);
      high = std::max(high, x);
    }
    return high - low;
  }
  Files files_;
};

TEST_F(ModelMeshes, OfSeveralObjectsHaveAHullAroundAllOfThem) {
  files_.write("parts.obj", "o rear\n" + box_obj({0.03, 0.03, 0.03}, {-0.12, 0, 0}) + "o front\n" +
                                box_obj({0.03, 0.03, 0.03}, {0.12, 0, 0}, 9));
  const ModelParts found = parts(robot_urdf(geometry("collision", "parts.obj")));
  EXPECT_NEAR(width_m(*geom(found, "trunk")), 0.3, 1e-6);
  EXPECT_THAT(found.notes.text(),
              HasSubstr("replaced  the 2 objects of the mesh parts.obj: all of them are one"));
  std::string xml = with(one_leg_xml, "<worldbody>", R"(<asset><mesh file="parts.obj"/></asset><worldbody>)");
  xml = with(xml, R"(<geom name="thigh")",
             R"(<geom name="both" type="mesh" mesh="parts" mass="0"/><geom name="thigh")");
  EXPECT_NEAR(width_m(*geom(parts(xml, "m.xml"), "both")), 0.3, 1e-6);
}

TEST_F(ModelMeshes, OfPolygonsAreReadThoughMujocoDoesNot) {
  std::string hexagon;
  for (const double z : {-0.02, 0.02})
    for (int k = 0; k < 6; ++k)
      hexagon +=
          fmt::format("v {} {} {}\n", 0.1 * std::cos(k * 1.0471975512), 0.1 * std::sin(k * 1.0471975512), z);
  hexagon += "f 6 5 4 3 2 1\nf 7 8 9 10 11 12\n";
  for (int k = 0; k < 6; ++k)
    hexagon += fmt::format("f {} {} {} {}\n", k + 1, (k + 1) % 6 + 1, (k + 1) % 6 + 7, k + 7);
  files_.write("nut.obj", hexagon);
  EXPECT_EQ(geom(parts(robot_urdf(geometry("collision", "nut.obj"))), "trunk")->vertices_m.size(), 12u);
}

TEST_F(ModelMeshes, OfOneFileWithTwoScalesAreTwoAlsoIfOneIsMirrored) {
  files_.write("bar.obj", box_obj({0.05, 0.02, 0.01}, {0.1, 0, 0}));
  const auto scaled = [](const char* scale) {
    return R"(<collision><geometry><mesh filename="bar.obj" scale=")" + std::string(scale) +
           R"("/></geometry></collision>)";
  };
  const ModelParts found = parts(robot_urdf(scaled("1 1 1") + scaled("-2 1 1") + scaled("0.5")));
  const auto middle = [&](const char* name) {
    const robot::Geom& mesh = *geom(found, name);
    Vec3 sum;
    for (const Vec3 vertex : mesh.vertices_m) sum = sum + (mesh.position_m + rotate(mesh.rotation, vertex));
    return sum.x / static_cast<double>(mesh.vertices_m.size());
  };
  EXPECT_NEAR(middle("trunk.0"), 0.1, 1e-6);
  EXPECT_NEAR(middle("trunk.1"), -0.2, 1e-6);
  EXPECT_NEAR(middle("trunk.2"), 0.05, 1e-6);
  EXPECT_NEAR(width_m(*geom(found, "trunk.1")), 0.2, 1e-6);
}

TEST_F(ModelMeshes, OfTheSameNameInTwoFoldersAreTwo) {
  for (const auto& [folder, half] : {std::pair{"left", 0.05}, {"right", 0.1}}) {
    std::filesystem::create_directories(files_.path(folder));
    files_.write(std::string(folder) + "/part.obj", box_obj({half, 0.02, 0.01}));
  }
  const ModelParts found =
      parts(robot_urdf(geometry("collision", "left/part.obj") + geometry("collision", "right/part.obj")));
  EXPECT_NEAR(width_m(*geom(found, "trunk.0")), 0.1, 1e-6);
  EXPECT_NEAR(width_m(*geom(found, "trunk.1")), 0.2, 1e-6);
}

TEST_F(ModelMeshes, AreFoundHoweverTheirPathIsSpelled) {
  std::filesystem::create_directories(files_.path("Meshes/visual parts"));
  files_.write("Meshes/visual parts/Bar.obj", box_obj({0.05, 0.02, 0.01}));
  for (const char* name :
       {"Meshes/visual parts/Bar.obj", "meshes/Visual Parts/bar.OBJ", R"(Meshes\visual parts\Bar.obj)",
        R"(..\meshes\..\Meshes\visual parts\Bar.obj)", "package://r/Meshes/visual parts/Bar.obj",
        "package://r/Meshes/visual%20parts/Bar.obj", "model://r/Meshes/visual parts/Bar.obj",
        "$(find r)/Meshes/visual parts/Bar.obj", " Meshes/visual parts/Bar.obj ",
        "./Meshes//visual parts/Bar.obj", "Meshes/visual&#32;parts/Bar.obj",
        R"(C:\work\r\Meshes\visual parts\Bar.obj)"}) {
    const ModelParts found = parts(robot_urdf(geometry("collision", name)));
    EXPECT_NE(geom(found, "trunk"), nullptr) << name << "\n" << found.notes.text();
  }
  std::string xml = with(one_leg_xml, "<worldbody>",
                         R"(<asset><mesh name="b" file="VISUAL parts\bar.obj"/></asset><worldbody>)");
  xml = with(xml, R"(<compiler angle="radian"/>)", R"(<compiler angle="radian" meshdir="meshes\"/>)");
  xml = with(xml, R"(<geom name="thigh")",
             R"(<geom name="bar" type="mesh" mesh="b" mass="0"/><geom name="thigh")");
  EXPECT_NE(geom(parts(xml, "m.xml"), "bar"), nullptr);
}

TEST_F(ModelMeshes, ThatCannotBeReadAreLeftOutAloneAndNamed) {
  files_.write("bar.obj", box_obj({0.05, 0.02, 0.01}));
  files_.write("empty.dae", "<COLLADA version=\"1.4.1\"/>");
  files_.write("flat.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 1 1 0\nf 1 2 3\nf 2 4 3\n");
  files_.write("bad.stl", "solid\nfacet normal 0 0 1 outer loop vertex a b c endloop endfacet endsolid");
  const std::string good = geometry("collision", "bar.obj");
  for (const char* name : {"gone.stl", "empty.dae", "flat.obj", "bad.stl", "bar.ply"}) {
    for (const char* kind : {"collision", "visual"}) {
      const ModelParts found = parts(robot_urdf(good + geometry(kind, name), good + geometry(kind, name)));
      EXPECT_EQ(found.bodies.size(), 4u);
      EXPECT_EQ(found.geoms.size(), 4u) << found.notes.text();
      EXPECT_THAT(found.notes.text(), HasSubstr(name));
      EXPECT_THAT(found.notes.text(), HasSubstr("of 'trunk'")) << name << kind;
    }
  }
}

TEST_F(ModelMeshes, OfFeetThatCannotBeReadRefuseTheRobot) {
  const auto refusal = [&](const std::string& urdf) { return files_.error_of([&] { parts(urdf); }); };
  const std::string gone = geometry("collision", "gone.stl");
  EXPECT_THAT(refusal(robot_urdf("", "", "", gone)),
              HasSubstr("r.urdf: collision meshes of feet that cannot be read: gone.stl (not found)"));
  EXPECT_EQ(refusal(robot_urdf("", gone)), "accepted") << "an arm that reaches up";
  EXPECT_EQ(refusal(robot_urdf("", "", gone)), "accepted") << "a shin whose foot is a sphere";
  EXPECT_EQ(refusal(robot_urdf("", "", "", geometry("visual", "gone.stl"))), "accepted");
}

TEST_F(ModelMeshes, OfMoreFacesThanMujocoTakesAreTheirHull) {
  MeshShape lattice;
  constexpr int side = 330;
  for (int i = 0; i <= side; ++i)
    for (int k = 0; k <= side; ++k)
      lattice.corners.push_back({0.1F * static_cast<float>(i) / side, 0.2F * static_cast<float>(k) / side,
                                 (i == 0 || k == 0 || i == side || k == side) ? 0.0F : 0.05F});
  for (int i = 0; i < side; ++i)
    for (int k = 0; k < side; ++k) {
      const int at = i * (side + 1) + k;
      lattice.triangles.push_back({at, at + side + 1, at + 1});
      lattice.triangles.push_back({at + 1, at + side + 1, at + side + 2});
    }
  ASSERT_GT(lattice.triangles.size(), most_mesh_faces);
  files_.write("big.stl", stl_bytes(lattice));
  for (const char* kind : {"collision", "visual"}) {
    const ModelParts found = parts(robot_urdf(geometry(kind, "big.stl")));
    EXPECT_NEAR(width_m(*geom(found, kind == std::string("visual") ? "trunk.visual" : "trunk")), 0.1, 1e-6);
    EXPECT_THAT(found.notes.text(),
                HasSubstr("the mesh big.stl of 217800 faces, more than MuJoCo takes: its convex hull"));
  }
}

TEST_F(ModelMeshes, WhoseFacesPointAnyWayAreTheirHull) {
  // One triangle of a box is turned: MuJoCo finds no orientation.
  std::string box = box_obj({0.05, 0.02, 0.01});
  files_.write("torn.obj", with(box, "f 1 3 4 2", "f 1 3 4\nf 1 2 4"));
  const ModelParts found = parts(robot_urdf(geometry("collision", "torn.obj")));
  ASSERT_NE(geom(found, "trunk"), nullptr) << found.notes.text();
  EXPECT_NEAR(width_m(*geom(found, "trunk")), 0.1, 1e-6);
}

TEST_F(ModelMeshes, AreReadFromTextStlAndColladaAsFromAnyOther) {
  const MeshReading box = read_obj(box_obj({0.05, 0.02, 0.01}));
  std::string text = "solid box\n";
  for (const auto& triangle : box.shape.triangles) {
    text += "facet normal 0 0 0\nouter loop\n";
    for (const int corner : triangle)
      text += fmt::format("vertex {} {} {}\n", box.shape.corners[to_index(corner)][0],
                          box.shape.corners[to_index(corner)][1], box.shape.corners[to_index(corner)][2]);
    text += "endloop\nendfacet\n";
  }
  files_.write("box.stl", text + "endsolid box\n");
  std::string places, numbers;
  for (const auto& corner : box.shape.corners)
    places += fmt::format("{} {} {} ", 1000 * corner[0], 1000 * corner[1], 1000 * corner[2]);
  for (const auto& triangle : box.shape.triangles)
    numbers += fmt::format("{} {} {} ", triangle[0], triangle[1], triangle[2]);
  files_.write("box.dae",
               R"(<COLLADA><asset><unit meter="0.001"/></asset><library_geometries><geometry id="g"><mesh>
    <source id="p"><float_array>)" +
                   places + R"(</float_array></source><vertices id="v"><input semantic="POSITION"
    source="#p"/></vertices><triangles><input semantic="VERTEX" source="#v" offset="0"/><p>)" +
                   numbers + "</p></triangles></mesh></geometry></library_geometries></COLLADA>");
  for (const char* name : {"box.stl", "box.dae"}) {
    const ModelParts found = parts(robot_urdf(geometry("collision", name)));
    ASSERT_NE(geom(found, "trunk"), nullptr) << found.notes.text();
    EXPECT_EQ(geom(found, "trunk")->vertices_m.size(), 8u);
    EXPECT_NEAR(width_m(*geom(found, "trunk")), 0.1, 1e-6);
    EXPECT_THAT(found.notes.text(), Not(HasSubstr("left out  collision")));
  }
}

TEST_F(ModelMeshes, ShapesWithoutSizeAreLeftOutAloneAndNamed) {
  const std::string box = R"(<collision><geometry><box size="0.1 0.1 0.1"/></geometry></collision>)";
  for (const char* shape : {R"(<box size="0 0 0"/>)", R"(<box size="0.1 -0.1 0.1"/>)",
                            R"(<sphere radius="0"/>)", R"(<cylinder radius="0.1" length="0"/>)"})
    for (const char* kind : {"collision", "visual"}) {
      const std::string odd =
          "<" + std::string(kind) + "><geometry>" + shape + "</geometry></" + std::string(kind) + ">";
      const ModelParts found = parts(robot_urdf(box + odd));
      EXPECT_EQ(found.geoms.size(), 3u);
      EXPECT_THAT(found.notes.text(),
                  HasSubstr("left out  shapes without size: the " + std::string(kind) + " shape of 'trunk'"));
    }
  const std::string xml =
      with(one_leg_xml, R"(<geom name="thigh")",
           R"(<geom name="dot" type="box" size="0 0 0" contype="0" conaffinity="0"/><geom name="thigh")");
  const ModelParts found = parts(xml, "m.xml");
  EXPECT_EQ(found.geoms.size(), 4u);
  EXPECT_THAT(found.notes.text(), HasSubstr("geom 'dot' of 'thigh': a shape without size"));
}

TEST_F(ModelMeshes, OfAUrdfNamedWithoutAFolderAreFound) {
  files_.write("bar.obj", box_obj({0.05, 0.02, 0.01}));
  files_.write("r.urdf", robot_urdf(geometry("collision", "bar.obj")));
  const auto before = std::filesystem::current_path();
  std::filesystem::current_path(files_.path("."));
  const ModelParts found = extract_parts(compile_model("r.urdf"));
  std::filesystem::current_path(before);
  EXPECT_NE(geom(found, "trunk"), nullptr);
}

TEST(PlainPath, IsAPathOfThisSystem) {
  for (const auto& [name, plain] :
       std::initializer_list<std::pair<const char*, const char*>>{{"a/b.stl", "a/b.stl"},
                                                                  {R"(a\b.stl)", "a/b.stl"},
                                                                  {R"(C:\a\b.stl)", "/a/b.stl"},
                                                                  {"file:///C:/a/b.stl", "/a/b.stl"},
                                                                  {"file:///a/b.stl", "/a/b.stl"},
                                                                  {"package://a/b.stl", "a/b.stl"},
                                                                  {R"(package:\\a\b.stl)", "a/b.stl"},
                                                                  {"$(find a)/b.stl", "a/b.stl"},
                                                                  {"a & b.stl", "a & b.stl"},
                                                                  {"", ""}})
    EXPECT_EQ(plain_path(name), plain);
}

}  // namespace
}  // namespace amble::morphology
