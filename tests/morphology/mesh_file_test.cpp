#include "amble/morphology/mesh_file.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>
#include <limits>
#include <string>

#include "tests/morphology/files.hpp"

namespace amble::morphology {
namespace {

using testing::HasSubstr;

/// The corners' span along x.
float width(const MeshShape& shape) {
  if (shape.corners.empty()) return 0.0F;
  const auto [low, high] =
      std::ranges::minmax(shape.corners, {}, [](const auto& corner) { return corner[0]; });
  return high[0] - low[0];
}

/// A tetrahedron with an edge of 1.
MeshShape tetrahedron() {
  return {.corners = {{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}},
          .triangles = {{{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}}}};
}

const std::string text_stl =
    "solid a part of facets\n facet normal 0 0 1\n  outer loop\n   vertex 0 0 0\n   vertex +2.5e0 0 0\n"
    "   vertex 0 1 0\n  endloop\n endfacet\nendsolid\n";

TEST(Stl, InBinaryFormComesBackAsItWas) {
  const MeshReading read = read_stl(stl_bytes(tetrahedron()));
  EXPECT_EQ(read.problem, "");
  EXPECT_EQ(read.shape.triangles.size(), 4u);
  EXPECT_EQ(stl_bytes(read.shape), stl_bytes(tetrahedron()));
}

TEST(Stl, InBinaryFormMayBeginAsTextDoesAndHaveBytesBehindIt) {
  std::string bytes = stl_bytes(tetrahedron());
  std::memcpy(bytes.data(), "solid by a program", 18);
  EXPECT_EQ(read_stl(bytes).shape.triangles.size(), 4u);
  EXPECT_EQ(read_stl(bytes + std::string(7, '\0')).shape.triangles.size(), 4u);
  EXPECT_THAT(read_stl(bytes.substr(0, bytes.size() - 1)).problem, HasSubstr("4 faces are announced"));
}

TEST(Stl, InTextFormIsReadWithWhateverBlanksAndCapitals) {
  std::string capitals = text_stl, tabs = text_stl, one_line = text_stl;
  std::ranges::transform(capitals, capitals.begin(), [](unsigned char c) { return std::toupper(c); });
  std::ranges::replace(tabs, ' ', '\t');
  std::ranges::replace(one_line, '\n', ' ');
  std::string carriage;
  for (const char c : text_stl) carriage += c == '\n' ? std::string("\r\n") : std::string(1, c);
  for (const std::string& text :
       {text_stl, capitals, tabs, one_line, carriage, "  \n" + text_stl, text_stl + std::string(3, '\0'),
        text_stl.substr(0, text_stl.find("endsolid"))}) {
    const MeshReading read = read_stl(text);
    EXPECT_EQ(read.problem, "") << text;
    EXPECT_EQ(read.shape.triangles.size(), 1u) << text;
    EXPECT_EQ(width(read.shape), 2.5F) << text;
  }
  EXPECT_EQ(read_stl(text_stl + text_stl).shape.triangles.size(), 2u) << "several solids";
  EXPECT_THAT(read_stl(with(text_stl, "+2.5e0", "2,5")).problem, HasSubstr("'2,5' is no coordinate"));
  EXPECT_THAT(read_stl(with(text_stl, "+2.5e0", "nan")).problem, HasSubstr("'nan' is no coordinate"));
  EXPECT_EQ(read_stl("solid x\nendsolid x\n").problem, "it has no faces");
}

TEST(Stl, ThatIsNoneIsToldAsSuch) {
  EXPECT_THAT(read_stl("").problem, HasSubstr("too short"));
  EXPECT_THAT(read_stl(std::string(84, '\1')).problem, HasSubstr("faces are announced"));
  EXPECT_EQ(read_stl(std::string(84, '\0')).problem, "it has no faces");
  MeshShape endless = tetrahedron();
  endless.corners[2][1] = std::numeric_limits<float>::infinity();
  EXPECT_THAT(read_stl(stl_bytes(endless)).problem, HasSubstr("no finite corners"));
}

const std::string corners = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 0 0 3\n";

TEST(Obj, MayHaveQuadsPolygonsAndIndicesOfAllKinds) {
  for (const char* faces :
       {"f 1 2 3 4\n", "f 1/1 2/2 3/3 4/4\n", "f 1//1 2//1 3//1 4//1\n", "f -5 -4 -3 -2\n",
        "f 1 2 \\\n 3 4\n", "f 1 2 3 4 # a quad\n", "\tf\t1 2 3 4\r\n"}) {
    const MeshReading read = read_obj(corners + faces);
    EXPECT_EQ(read.problem, "") << faces;
    EXPECT_EQ(read.shape.triangles.size(), 2u) << faces;
    EXPECT_TRUE(read.shape.plain);
  }
  const MeshReading five = read_obj(corners + "f 1 2 3 4 5\n");
  EXPECT_EQ(five.shape.triangles.size(), 3u);
  EXPECT_FALSE(five.shape.plain) << "MuJoCo takes triangles and quads only";
}

TEST(Obj, OfSeveralObjectsOrGroupsHasAllOfTheirFaces) {
  for (const char* part : {"o", "g"}) {
    const std::string text = std::string(part) + " one\n" + corners + "f 1 2 3\nf 1 3 4\n" + part +
                             " two\nv 9 0 0\nv 9 1 0\nv 9 0 1\nf 6 7 8\n" + part + " empty\n";
    const MeshReading read = read_obj(text);
    EXPECT_EQ(read.shape.parts, 2);
    EXPECT_EQ(read.shape.triangles.size(), 3u);
    EXPECT_EQ(width(read.shape), 9.0F);
  }
  EXPECT_EQ(read_obj("o one\n" + corners + "f 1 2 3\n").shape.parts, 1);
}

TEST(Obj, ThatNamesCornersThatAreNotThereIsToldWithItsLine) {
  for (const char* face : {"f 1 2 6", "f 0 1 2", "f -6 1 2", "f a b c", "f 1 2 99999999999999999999"})
    EXPECT_THAT(read_obj(corners + face).problem, HasSubstr("(line 6)")) << face;
  EXPECT_THAT(read_obj("v 1 2\nf 1 1 1\n").problem, HasSubstr("is no coordinate"));
  EXPECT_EQ(read_obj(corners).problem, "it has no faces");
}

TEST(MeshFile, IsReadByTheEndOfItsNameInCapitalsOrNot) {
  const Files files;
  const std::string stl = stl_bytes(tetrahedron());
  for (const char* name : {"a.stl", "a.STL", "a.Stl"})
    EXPECT_EQ(read_mesh(files.write(name, stl)).problem, "");
  EXPECT_EQ(read_mesh(files.write("a.OBJ", corners + "f 1 2 3\n")).problem, "");
  EXPECT_THAT(read_mesh(files.write("a.ply", stl)).problem, HasSubstr("neither STL, OBJ, COLLADA nor MSH"));
  EXPECT_THAT(read_mesh(files.path("gone.stl")).problem, HasSubstr("gone.stl"));
  EXPECT_THAT(
      read_mesh(files.write("b.stl", "version https://git-lfs.github.com/spec/v1\noid sha256:1\n")).problem,
      HasSubstr("git lfs pull"));
}

TEST(MeshHull, HasNoMoreCornersThanAskedForAndNoneOfAFlatMesh) {
  MeshShape shape;
  for (int i = 0; i < 300; ++i) {
    const float z = static_cast<float>(i) / 150.0F - 1.0F, r = std::sqrt(std::max(0.0F, 1.0F - z * z));
    shape.corners.push_back(
        {r * std::cos(2.4F * static_cast<float>(i)), r * std::sin(2.4F * static_cast<float>(i)), z});
  }
  EXPECT_EQ(hull_of(shape, 50).corners.size(), 50u);
  EXPECT_EQ(hull_of({.corners = {{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}}}, .triangles = {}}, 50)
                .triangles.size(),
            0u);
}

}  // namespace
}  // namespace amble::morphology
