#include "amble/morphology/collada.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <string>

#include "tests/morphology/files.hpp"

namespace amble::morphology {
namespace {

using testing::HasSubstr;

struct Dae {
  std::string asset = {};
  std::string faces =
      R"(<triangles count="2"><input semantic="VERTEX" source="#v" offset="0"/><p>0 1 2 0 2 3</p></triangles>)";
  std::string node = R"(<node><instance_geometry url="#g"/></node>)";
  std::string more = {};
};

/// A rectangle of 1 by 2 in the plane z = 0.
std::string text_of(const Dae& dae) {
  return R"(<?xml version="1.0"?><COLLADA xmlns="http://www.collada.org/2005/11/COLLADASchema" version="1.4.1"><asset>)" +
         dae.asset + R"(</asset><library_geometries><geometry id="g"><mesh>
    <source id="p"><float_array id="a" count="12">0 0 0  1 0 0
      1 2 0  0 +2 -0e0</float_array><technique_common><accessor source="#a" count="4" stride="3"/></technique_common></source>
    <vertices id="v"><input semantic="POSITION" source="#p"/></vertices>)" +
         dae.faces + "</mesh></geometry></library_geometries>" + dae.more +
         R"(<library_visual_scenes><visual_scene id="s">)" + dae.node +
         R"(</visual_scene></library_visual_scenes><scene><instance_visual_scene url="#s"/></scene></COLLADA>)";
}

MeshReading read(const Dae& dae) {
  return read_collada(text_of(dae), "m.dae");
}

/// The lowest and highest coordinates of the corners of its faces.
std::array<std::array<float, 3>, 2> box(const MeshReading& reading) {
  std::array<std::array<float, 3>, 2> box{{{1e9F, 1e9F, 1e9F}, {-1e9F, -1e9F, -1e9F}}};
  for (const auto& triangle : reading.shape.triangles)
    for (const int corner : triangle)
      for (std::size_t k = 0; k < 3; ++k) {
        const float value = reading.shape.corners[static_cast<std::size_t>(corner)][k];
        box[0][k] = std::min(box[0][k], value);
        box[1][k] = std::max(box[1][k], value);
      }
  return box;
}

void expect_box(const MeshReading& reading, std::array<float, 3> low, std::array<float, 3> high) {
  EXPECT_EQ(reading.problem, "");
  const auto found = box(reading);
  for (std::size_t k = 0; k < 3; ++k) {
    EXPECT_NEAR(found[0][k], low[k], 1e-6F) << k;
    EXPECT_NEAR(found[1][k], high[k], 1e-6F) << k;
  }
}

TEST(Collada, HasItsFacesInMetres) {
  expect_box(read({}), {0, 0, 0}, {1, 2, 0});
  for (const char* unit :
       {R"(<unit meter="0.001" name="millimeter"/>)", R"(<unit name="millimeter" meter="1e-3"/>)"})
    expect_box(read({.asset = unit}), {0, 0, 0}, {0.001F, 0.002F, 0});
  expect_box(read({.asset = R"(<unit meter="0.0254" name="inch"/>)"}), {0, 0, 0}, {0.0254F, 0.0508F, 0});
}

TEST(Collada, KeepsItsAxesWhateverIsUpAndSaysSo) {
  for (const char* up : {"Y_UP", "X_UP"}) {
    const MeshReading reading = read({.asset = "<up_axis>" + std::string(up) + "</up_axis>"});
    expect_box(reading, {0, 0, 0}, {1, 2, 0});
    EXPECT_THAT(reading.remarks, testing::ElementsAre(HasSubstr("up axis, which is not turned, as in ROS")));
  }
  EXPECT_THAT(read({.asset = "<up_axis>Z_UP</up_axis>"}).remarks, testing::IsEmpty());
}

TEST(Collada, AppliesTheTransformsOfNodesWithinEachOtherInTheirOrder) {
  const std::string geometry = R"(<instance_geometry url="#g"/>)";
  expect_box(read({.node = "<node><translate>5 0 0</translate>" + geometry + "</node>"}), {5, 0, 0},
             {6, 2, 0});
  expect_box(
      read({.node = "<node><rotate>0 0 1 90</rotate><translate>5 0 0</translate>" + geometry + "</node>"}),
      {-2, 5, 0}, {0, 6, 0});
  expect_box(
      read({.node = "<node><translate>5 0 0</translate><rotate>0 0 1 90</rotate>" + geometry + "</node>"}),
      {3, 0, 0}, {5, 1, 0});
  expect_box(
      read({.node = "<node><matrix>1 0 0 0 0 0 -1 0 0 1 0 7 0 0 0 1</matrix><node><scale>2 2 2</scale>" +
                    geometry + "</node></node>"}),
      {0, 0, 7}, {2, 0, 11});
  const auto turned = [&](const std::string& rotation) {
    return read({.node = "<node><rotate>" + rotation + "</rotate>" + geometry + "</node>"});
  };
  expect_box(turned("1 0 0 90"), {0, 0, 0}, {1, 0, 2});
  expect_box(turned("0 1 0 90"), {0, 0, -1}, {0, 2, 0});
  expect_box(turned("2 2 2 120"), {0, 0, 0}, {0, 1, 2});
  expect_box(turned("2 2 2 -120"), {0, 0, 0}, {2, 0, 1});
  const std::string unit = R"(<unit meter="0.1"/>)";
  expect_box(read({.asset = unit, .node = "<node><translate>5 0 0</translate>" + geometry + "</node>"}),
             {0.5F, 0, 0}, {0.6F, 0.2F, 0});
}

TEST(Collada, ShowsAGeometryAsOftenAsItsSceneDoes) {
  const std::string node = R"(<node><instance_geometry url="#g"/></node><node><translate>0 9 0</translate>
    <instance_node url="#part"/></node>)";
  const MeshReading reading = read(
      {.node = node,
       .more = R"(<library_nodes><node id="part"><instance_geometry url="#g"/></node></library_nodes>)"});
  EXPECT_EQ(reading.shape.triangles.size(), 4u);
  expect_box(reading, {0, 0, 0}, {1, 11, 0});
}

TEST(Collada, TurnsFacesThatAreMirrored) {
  const auto normal_z = [](const MeshReading& reading) {
    const auto& t = reading.shape.triangles[0];
    const auto at = [&](std::size_t k) { return reading.shape.corners[static_cast<std::size_t>(t[k])]; };
    return (at(1)[0] - at(0)[0]) * (at(2)[1] - at(0)[1]) - (at(1)[1] - at(0)[1]) * (at(2)[0] - at(0)[0]);
  };
  const std::string geometry = R"(<instance_geometry url="#g"/></node>)";
  EXPECT_GT(normal_z(read({})), 0.0F);
  EXPECT_GT(normal_z(read({.node = "<node><scale>-1 1 1</scale>" + geometry})), 0.0F);
  EXPECT_LT(normal_z(read({.node = "<node><scale>1 1 -1</scale>" + geometry})) *
                normal_z(read({.node = "<node><scale>1 1 1</scale>" + geometry})),
            0.0F);
}

TEST(Collada, KnowsAllItsKindsOfFaces) {
  const std::string inputs =
      R"(<input semantic="NORMAL" source="#v" offset="1"/><input semantic="VERTEX" source="#v" offset="0"/>)";
  const auto count = [&](const std::string& faces) {
    const MeshReading reading = read({.faces = faces});
    EXPECT_EQ(reading.problem, "") << faces;
    return reading.shape.triangles.size();
  };
  EXPECT_EQ(count("<polylist count=\"2\">" + inputs +
                  "<vcount>4 3</vcount><p>0 0 1 0 2 0 3 0 0 0 1 0 2 0</p></polylist>"),
            3u);
  EXPECT_EQ(count("<polygons>" + inputs + "<p>0 0 1 0 2 0 3 0</p><p>0 0 1 0 2 0</p></polygons>"), 3u);
  EXPECT_EQ(count("<tristrips>" + inputs + "<p>0 0 1 0 3 0 2 0</p></tristrips>"), 2u);
  EXPECT_EQ(count("<trifans>" + inputs + "<p>0 0 1 0 2 0 3 0</p></trifans>"), 2u);
  EXPECT_EQ(count("<lines>" + inputs + "<p>0 0 1 0</p></lines><triangles>" + inputs +
                  "<p>0 0 1 0 2 0</p></triangles>"),
            1u);
}

TEST(Collada, OfASkinIsInThePoseInWhichItWasBound) {
  expect_box(read({.node = R"(<node><instance_controller url="#c"/></node>)",
                   .more = R"(<library_controllers><controller id="c"><skin source="#g">
                     <bind_shape_matrix>1 0 0 3 0 1 0 0 0 0 1 0 0 0 0 1</bind_shape_matrix></skin></controller>
                     </library_controllers>)"}),
             {3, 0, 0}, {4, 2, 0});
}

TEST(Collada, ThatCannotBeReadIsToldAndNeverCrashes) {
  EXPECT_THAT(read_collada("", "m.dae").problem, HasSubstr("m.dae:1"));
  EXPECT_EQ(read_collada("<robot/>", "m.dae").problem, "it is no COLLADA file");
  EXPECT_EQ(read_collada("<COLLADA version=\"1.4.1\"/>", "m.dae").problem, "its scene has no faces");
  const std::string good = text_of({});
  for (const auto& [from, to] : std::initializer_list<std::pair<const char*, const char*>>{
           {"0 1 2 0 2 3</p>", "0 1 9</p>"},
           {"0 1 2 0 2 3</p>", "0 -1 2</p>"},
           {"0 1 2 0 2 3</p>", "0 a 2</p>"},
           {"stride=\"3\"", "stride=\"0\""},
           {"stride=\"3\"", "stride=\"1\""},
           {"source=\"#p\"/></vertices>", "source=\"#gone\"/></vertices>"},
           {"url=\"#g\"", "url=\"#gone\""},
           {"offset=\"0\"", "offset=\"4000000000\""},
           {"0 0 0  1 0 0", "nan 0 0 1 0 0"},
           {"1 2 0", "1e39 2 0"}})
    EXPECT_NE(read_collada(with(good, from, to), "m.dae").problem, "") << to;
  EXPECT_THAT(read({.node = R"(<node id="n"><instance_node url="#n"/></node>)"}).problem,
              HasSubstr("too deep"));
  for (std::size_t cut = 0; cut < good.size(); cut += 7) read_collada(good.substr(0, cut), "m.dae");
}

}  // namespace
}  // namespace amble::morphology
