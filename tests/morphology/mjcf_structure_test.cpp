#include "amble/morphology/mjcf_structure.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <mujoco/mujoco.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <set>
#include <string>

#include "amble/morphology/model_parts.hpp"
#include "amble/morphology/robot_guess.hpp"
#include "amble/robot/pose.hpp"
#include "tests/models/small_models.hpp"
#include "tests/morphology/files.hpp"

namespace amble::morphology {
namespace {

using testing::HasSubstr;
using testing::Not;

class Structure : public testing::Test {
 protected:
  ModelParts parts(const std::string& xml) const {
    return extract_parts(compile_model(files_.write("m.xml", xml)));
  }
  static const robot::Geom& geom(const ModelParts& parts, const std::string& name) {
    const auto found = std::ranges::find(parts.geoms, name, &robot::Geom::name);
    if (found == parts.geoms.end()) throw std::logic_error("no geom " + name + "\n" + parts.notes.text());
    return *found;
  }
  Files files_;
};

const std::string shin = R"(<geom name="shin" type="cylinder" pos="0 0 -0.2" size="0.04 0.2" mass="0.5"/>)";

TEST_F(Structure, AFrameMovesWhatIsInIt) {
  const ModelParts plain = parts(
      with(one_leg_xml, shin, R"(<geom name="shin" type="cylinder" pos="0.3 -0.2 0" axisangle="0 0 1 0.5"
                                                           size="0.04 0.2" mass="0.5"/>)"));
  const std::string bare = R"(<geom name="shin" type="cylinder" size="0.04 0.2" mass="0.5"/>)";
  for (const std::string& framed :
       {R"(<frame pos="0.3 -0.2 0" euler="0 0 0.5">)" + bare + "</frame>",
        R"(<frame pos="0.3 -0.2 0"><frame axisangle="0 0 1 0.5">)" + bare + "</frame></frame>",
        R"(<frame pos="0.3 -0.2 0" quat="0.96891242 0 0 0.24740396">)" + bare + "</frame>",
        R"(<frame name="f" pos="0.3 0 0"><frame name="f" pos="0 -0.2 0"><frame euler="0 0 0.5">)" + bare +
            "</frame></frame></frame>"}) {
    const ModelParts found = parts(with(one_leg_xml, shin, framed));
    EXPECT_NEAR(norm(geom(found, "shin").position_m - geom(plain, "shin").position_m), 0.0, 1e-7) << framed;
    EXPECT_NEAR(norm(rotate(geom(found, "shin").rotation, {1, 2, 3}) -
                     rotate(geom(plain, "shin").rotation, {1, 2, 3})),
                0.0, 1e-6);
    EXPECT_EQ(found.bodies.size(), plain.bodies.size());
    EXPECT_NEAR(found.bodies[2].mass_kg, plain.bodies[2].mass_kg, 1e-12);
    EXPECT_NEAR(norm(found.bodies[2].com_m - plain.bodies[2].com_m), 0.0, 1e-7);
    EXPECT_THAT(found.notes.text(), HasSubstr("<frame>: what is in them is moved as they say"));
  }
}

TEST_F(Structure, AFrameGivesItsClassAndTakesNoMassOfItsOwn) {
  std::string xml = with(one_leg_xml, "<option",
                         R"(<default><default class="thin"><geom size="0.01"/></default></default><option)");
  xml = with(xml, shin,
             R"(<inertial pos="0 0 -0.2" mass="0.7" diaginertia="0.01 0.01 0.01"/>
    <frame childclass="thin" pos="0 0 -0.1"><geom name="thin" mass="5"/></frame>)" +
                 shin);
  const ModelParts found = parts(xml);
  EXPECT_EQ(geom(found, "thin").size_m.x, 0.01);
  EXPECT_EQ(found.bodies[2].mass_kg, 0.7);
}

TEST_F(Structure, AFrameMayHoldJointsAndBodies) {
  const std::string knee =
      R"(<joint name="A_knee" type="hinge" axis="0 1 0" limited="true" range="-0.7 0"/>)";
  const ModelParts
      plain =
          parts(with(one_leg_xml, knee,
                     R"(<joint name="A_knee" pos="0.1 0 0" axis="-1 0 0" limited="true" range="-0.7 0"/>)")),
      framed = parts(with(one_leg_xml, knee,
                          R"(<frame pos="0.1 0 0" euler="0 0 1.5707963267948966">)" + knee + "</frame>"));
  ASSERT_EQ(framed.joints.size(), 2u);
  EXPECT_NEAR(norm(framed.joints[1].anchor_m - plain.joints[1].anchor_m), 0.0, 1e-12);
  EXPECT_NEAR(norm(framed.joints[1].axis - plain.joints[1].axis), 0.0, 1e-12);
  const ModelParts twice = parts(
      with(one_leg_xml, knee,
           R"(<frame pos="0.1 0 0"><frame euler="0 0 1.5707963267948966">)" + knee + "</frame></frame>"));
  ASSERT_EQ(twice.joints.size(), 2u);
  EXPECT_EQ(twice.bodies.size(), plain.bodies.size());
  EXPECT_NEAR(norm(twice.joints[1].anchor_m - plain.joints[1].anchor_m), 0.0, 1e-12);
  EXPECT_NEAR(norm(twice.joints[1].axis - plain.joints[1].axis), 0.0, 1e-12);
  // The whole robot, and a leg of it, in frames.
  std::string xml = with(one_leg_xml, R"(<body name="torso")",
                         R"(<frame pos="0 0 0.5"><frame pos="1 0 0"><body name="torso")");
  xml = with(xml, "</worldbody>", "</frame></frame></worldbody>");
  EXPECT_NEAR(parts(xml).bodies[0].position_m.x, 1.0, 1e-12);
  EXPECT_NEAR(parts(xml).bodies[0].position_m.z, parts(one_leg_xml).bodies[0].position_m.z + 0.5, 1e-12);
  xml = with(one_leg_xml, R"(<body name="shin")", R"(<frame pos="0.2 0 0"><body name="shin")");
  xml = with(xml, "</body>\n      </body>", "</body></frame>\n      </body>");
  const ModelParts leg = parts(xml);
  ASSERT_EQ(leg.bodies.size(), 3u);
  EXPECT_NEAR(leg.bodies[2].position_m.x, 0.2, 1e-12);
}

TEST_F(Structure, JointsWithoutNamesAreCalledAfterTheirBodies) {
  std::string xml = with(one_leg_xml, "name=\"A_knee\"", "");
  EXPECT_EQ(parts(xml).joints[1].name, "shin");
  EXPECT_THAT(parts(xml).notes.text(), HasSubstr("joints without a name, by that of their body: shin"));
  xml = with(xml, "name=\"A_hip\"", "name=\"shin\"");
  EXPECT_EQ(parts(xml).joints[1].name, "shin.1") << "the name is taken";
  xml = with(xml, "<body name=\"shin\"", "<body");
  EXPECT_EQ(parts(xml).joints[1].name, "joint");
  xml = with(one_leg_xml, R"(<joint name="A_knee")",
             R"(<joint axis="1 0 0"/><joint axis="0 0 1"/><joint name="A_knee")");
  EXPECT_EQ(parts(xml).joints[1].name, "shin");
  EXPECT_EQ(parts(xml).joints[2].name, "shin.1");
  EXPECT_THAT(parts(one_leg_xml).notes.text(), Not(HasSubstr("without a name")));
}

/// Without the names of such elements.
std::string nameless(std::string text, const std::string& element) {
  const std::string start = "<" + element + " name=\"";
  for (std::size_t at = 0; (at = text.find(start, at)) != std::string::npos;)
    text.erase(at + 1 + element.size(), text.find('"', at + start.size()) - at - element.size());
  return text;
}

TEST_F(Structure, BodiesWithoutNamesAreCalledAfterTheirJointsOrTheirParents) {
  const auto names = [](const ModelParts& found) {
    std::vector<std::string> all;
    for (const robot::Body& body : found.bodies) all.push_back(body.name);
    return all;
  };
  const std::string model = tests::model_text(tests::four_legs());
  const ModelParts by_joints = parts(nameless(model, "body"));
  EXPECT_THAT(names(by_joints), testing::ElementsAre("root", "FL_hip", "FL_knee", "FR_hip", "FR_knee",
                                                     "RL_hip", "RL_knee", "RR_hip", "RR_knee"));
  EXPECT_THAT(
      by_joints.notes.text(),
      HasSubstr("bodies without a name, by that of their joint, or that of their parent and a number: "
                "root, FL_hip, FL_knee"));
  const ModelParts by_place = parts(nameless(nameless(model, "body"), "joint"));
  EXPECT_THAT(names(by_place), testing::ElementsAre("root", "root_1", "root_1_1", "root_2", "root_2_1",
                                                    "root_3", "root_3_1", "root_4", "root_4_1"));
  for (const ModelParts* found : {&by_joints, &by_place}) {
    std::set<std::string> geoms;
    for (const robot::Geom& geom : found->geoms) geoms.insert(geom.name);
    EXPECT_EQ(geoms.size(), found->geoms.size()) << "each has a name of its own";
  }
  std::string taken = with(one_leg_xml, R"(<body name="shin")", "<body");
  taken = with(taken, R"(<body name="thigh")", R"(<body name="A_knee")");
  EXPECT_THAT(names(parts(taken)), testing::ElementsAre("torso", "A_knee", "A_knee.1"));
  EXPECT_THAT(parts(one_leg_xml).notes.text(), Not(HasSubstr("bodies without a name")));
}

TEST_F(Structure, ARootThatWasFusedIntoTheWorldGetsItsBodyBack) {
  // What is left of a model when its trunk's body is dissolved.
  std::string legs, world = R"(<geom name="hull" type="box" size="0.25 0.1 0.05" mass="3"/>)";
  for (const tests::LegText& leg : tests::four_legs()) legs += tests::leg_text(leg);
  const std::string floor = R"(<geom name="floor" type="plane" size="9 9 1"/>)";
  const ModelParts found = parts("<mujoco><worldbody>" + floor + world + legs + "</worldbody></mujoco>");
  EXPECT_EQ(found.bodies.size(), 9u);
  EXPECT_EQ(found.bodies[0].name, "root");
  EXPECT_EQ(found.bodies[0].mass_kg, 3.0);
  EXPECT_EQ(geom(found, "hull").body, 0);
  EXPECT_THAT(found.notes.text(),
              HasSubstr("the world's 1 shapes and 4 limbs by one body 'root' around them"));
  // Without shapes nothing is known of it, and two robots are no limbs.
  EXPECT_THAT(files_.error_of([&] { parts("<mujoco><worldbody>" + floor + legs + "</worldbody></mujoco>"); }),
              HasSubstr("but found 4; if they are limbs of one robot, put <body name=\"root\">"));
  const std::string pair = world + "<body name=\"a\"><geom size=\"0.1\"/>" + legs + "</body>";
  EXPECT_EQ(parts("<mujoco><worldbody>" + pair + "</worldbody></mujoco>").bodies[0].name, "a");
}

TEST_F(Structure, ContactsThatNameWhatIsNotThereAreLeftOutAndOthersKept) {
  const std::string contact =
      R"(</worldbody><contact><pair geom1="A_foot" geom2="floor"/><exclude body1="thigh" body2="cart"/>
    <pair geom1="A_foot" geom2="torso"/><exclude body1="torso" body2="thigh"/></contact>
    <sensor><touch site="gone"/><framepos objtype="geom" objname="floor"/></sensor>)";
  const ModelFile file = compile_model(files_.write("m.xml", with(one_leg_xml, "</worldbody>", contact)));
  EXPECT_EQ(file.model->npair, 1);
  EXPECT_EQ(file.model->nexclude, 1);
  EXPECT_THAT(file.notes.text(), HasSubstr("contact pair of 'A_foot' and 'floor': one of them is not there"));
  EXPECT_THAT(file.notes.text(), HasSubstr("contact exclusion of 'thigh' and 'cart'"));
  const std::string hills =
      R"(<asset><hfield name="h" nrow="2" ncol="2" size="5 5 0.1 0.1"/></asset><worldbody>
    <geom name="floor" type="hfield" hfield="h"/>)";
  const ModelParts found = parts(with(with(one_leg_xml, "<worldbody>", hills), "</worldbody>", contact));
  EXPECT_THAT(found.notes.text(), HasSubstr("geom 'floor' of height fields"));
}

TEST_F(Structure, AdhesionTakesItsRangeFromItsClassAndIsNamed) {
  const std::string sticky =
      R"(</worldbody><actuator><adhesion name="gecko" body="shin"/><adhesion body="thigh" ctrlrange="0 2"/>
    <motor joint="A_hip"/></actuator>)";
  for (const char* defaults : {R"(<default><adhesion ctrlrange="0 3"/></default>)", ""}) {
    const ModelParts found =
        parts(with(with(one_leg_xml, "</worldbody>", sticky), "<option", defaults + std::string("<option")));
    EXPECT_THAT(found.notes.text(),
                HasSubstr("adhesion actuators, as nothing sticks to the ground: 'gecko', 'thigh'"));
    EXPECT_THAT(found.notes.text(), HasSubstr("1 actuators"));
  }
}

TEST_F(Structure, IncludesMayComeFromNeighbouringFoldersAndTheRepository) {
  for (const char* folder : {"repo/robots/dog", "repo/robots/common", "repo/shared"})
    std::filesystem::create_directories(files_.path(folder));
  files_.write("repo/robots/common/look.xml",
               R"(<mujocoinclude><asset><material name="grey" rgba="1 0 0 1"/></asset></mujocoinclude>)");
  files_.write("repo/shared/size.xml", "<mujoco><size nconmax=\"9\"/></mujoco>");
  const auto model = [&](const std::string& include) {
    const std::string text =
        with(one_leg_xml, "<worldbody>", "<include file=\"" + include + "\"/><worldbody>");
    return files_.error_of([&] { compile_model(files_.write("repo/robots/dog/m.xml", text)); });
  };
  EXPECT_EQ(model("../common/look.xml"), "accepted");
  EXPECT_EQ(model(R"(..\common\LOOK.xml)"), "accepted");
  EXPECT_EQ(model((files_.path("repo/robots/common/look.xml")).string()), "accepted");
  EXPECT_THAT(model("../../shared/size.xml"), HasSubstr("in its neighbours and in its repository are read"));
  std::filesystem::create_directories(files_.path("repo/.git"));
  EXPECT_EQ(model("../../shared/size.xml"), "accepted");
  EXPECT_THAT(model("../../../m.xml"), HasSubstr("in its neighbours and in its repository are read"));
  EXPECT_THAT(model("../common/none.xml"), HasSubstr("there is no such file"));
}

TEST_F(Structure, IncludesAreFoundWithoutRegardToCapitalsWithANote) {
  std::filesystem::create_directories(files_.path("parts"));
  files_.write("parts/legs.xml", R"(<mujoco><option timestep="0.001"/></mujoco>)");
  const auto read = [&](const std::string& name) {
    return parts(with(one_leg_xml, "<worldbody>", "<include file=\"" + name + "\"/><worldbody>"))
        .notes.text();
  };
  EXPECT_THAT(read("Parts/Legs.xml"),
              HasSubstr("the path of an include, by what is there: Parts/Legs.xml ("));
  EXPECT_THAT(read("parts/legs.xml"), Not(HasSubstr("path of an include")));
  EXPECT_THAT(files_.error_of([&] { read("Gone/legs.xml"); }), HasSubstr("there is no such file"));
  // By a path without a folder, as in a shell that stands there.
  const std::filesystem::path before = std::filesystem::current_path();
  std::filesystem::current_path(files_.path(""));
  EXPECT_EQ(files_.error_of([] { compile_model("m.xml"); }),
            R"(m.xml:4: <include file="Gone/legs.xml">: there is no such file)");
  std::filesystem::current_path(before);
}

}  // namespace
}  // namespace amble::morphology
