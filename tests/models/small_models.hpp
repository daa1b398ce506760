#pragma once

#include <fmt/format.h>

#include <string>
#include <vector>

namespace amble::tests {

/// A model written for the tests, with one thing that makes models of real robots hard to read.
struct SmallModel {
  std::string name, extension, text;
  std::size_t legs, driven, held;  ///< what is to be found in it
};

struct LegText {
  std::string name = {};
  double x = 0.0, y = 0.0;
  std::string hip = R"(range="-40 40")", knee = R"(range="-60 60")";  ///< attributes of the joints
  std::string hip_body = {}, shin_body = {};                          ///< more elements
  std::string foot = R"(type="sphere" size="0.02")";
};

inline std::string leg_text(const LegText& leg) {
  std::string text =
      fmt::format(R"(
      <body name="{0}_thigh" pos="{1} {2} 0">
        <joint name="{0}_hip" axis="0 1 0" {3}/>{5}
        <geom type="capsule" fromto="0 0 0 0 0 -0.2" size="0.02" mass="0.3"/>
        <body name="{0}_shin" pos="0 0 -0.2">
          <joint name="{0}_knee" axis="0 1 0" {4}/>
          <geom type="capsule" fromto="0 0 0 0 0 -0.2" size="0.015" mass="0.2"/>
          <geom name="{0}_foot" pos="0 0 -0.21" mass="0.05" friction="0.7" {7}/>{6}
        </body>
      </body>)",
                  leg.name, leg.x, leg.y, leg.hip, leg.knee, leg.hip_body, leg.shin_body, leg.foot);
  // "NAME" in what is given.
  for (std::size_t at = text.find("NAME"); at != std::string::npos; at = text.find("NAME"))
    text.replace(at, 4, leg.name);
  return text;
}

/// `root`: what joins the trunk to the world; `more`: bodies of the trunk; `behind`: sections after the
/// world.
inline std::string model_text(const std::vector<LegText>& legs, const std::string& root = "<freejoint/>",
                              const std::string& more = {}, const std::string& behind = {},
                              const std::string& before = {}) {
  std::string text = "<mujoco>" + before + "\n  <worldbody>\n    <geom type=\"plane\" size=\"9 9 1\"/>\n" +
                     "    <body name=\"trunk\" pos=\"0 0 0.5\">" + root +
                     "\n      <geom type=\"box\" size=\"0.25 0.1 0.05\" mass=\"3\"/>";
  for (const LegText& leg : legs) text += leg_text(leg);
  return text + more + "\n    </body>\n  </worldbody>\n" + behind + "</mujoco>\n";
}

inline std::vector<LegText> four_legs(const LegText& like = {}) {
  std::vector<LegText> legs(4, like);
  const std::vector<std::string> names{"FL", "FR", "RL", "RR"};
  for (std::size_t l = 0; l < 4; ++l) {
    legs[l].name = names[l];
    legs[l].x = l < 2 ? 0.2 : -0.2;
    legs[l].y = l % 2 == 0 ? 0.12 : -0.12;
  }
  return legs;
}

inline std::string motors(const std::string& attributes) {
  std::string text = "  <actuator>\n";
  for (const char* leg : {"FL", "FR", "RL", "RR"})
    for (const char* type : {"hip", "knee"})
      text += fmt::format(R"(    <{} joint="{}_{}"/>)", attributes, leg, type);
  return text + "\n  </actuator>\n";
}

inline std::string urdf_with_effort() {
  const std::string inertial =
      R"(<inertial><mass value="{}"/><inertia ixx="0.01" iyy="0.01" izz="0.01" ixy="0" ixz="0" iyz="0"/></inertial>)";
  std::string text = R"(<?xml version="1.0"?><robot name="r"><link name="base">)" + inertial + "</link>\n";
  text.replace(text.find("{}"), 2, "3");
  for (const char* side : {"left", "right"}) {
    std::string leg = inertial;
    leg.replace(leg.find("{}"), 2, "0.3");
    text += fmt::format(
        R"(<link name="{0}_thigh">{1}<visual><geometry><mesh filename="package://r/gone.dae"/></geometry></visual></link>
<link name="{0}_shin">{1}<collision><origin xyz="0 0 -0.2"/><geometry><sphere radius="0.03"/></geometry></collision></link>
<joint name="{0}_hip_joint" type="revolute"><parent link="base"/><child link="{0}_thigh"/><origin xyz="0 {2} 0"/>
<axis xyz="0 1 0"/><limit lower="-1" upper="1" effort="12" velocity="5"/><dynamics damping="0.3" friction="0.1"/></joint>
<joint name="{0}_knee_joint" type="revolute"><parent link="{0}_thigh"/><child link="{0}_shin"/>
<origin xyz="0 0 -0.2"/><axis xyz="0 1 0"/><limit lower="-2.5" upper="-0.5" effort="9" velocity="5"/></joint>
)",
        side, leg, side[0] == 'l' ? 0.1 : -0.1);
  }
  return text + "</robot>\n";
}

/// One for each difficulty.
inline std::vector<SmallModel> small_models() {
  const auto with = [](const LegText& like) { return model_text(four_legs(like)); };
  std::vector<LegText> uneven = four_legs();
  uneven[0].shin_body = uneven[1].shin_body =
      R"(<body name="NAME_toes" pos="0 0 -0.21"><joint name="NAME_toe" axis="0 1 0" range="-20 20"/><geom size="0.02" mass="0.02"/></body>)";
  const std::string head =
      R"(<body name="head" pos="0.3 0 0.1"><joint name="neck" axis="0 0 1" range="-60 60"/><geom size="0.05" mass="0.2"/></body>)";
  const std::string arm =
      R"(<body name="arm" pos="0 0 0.1"><joint name="lift" type="slide" axis="0 0 1" range="0 0.1"/><geom size="0.03" mass="0.2"/></body>)";
  const std::string planar =
      R"(<joint name="rootx" type="slide" axis="1 0 0"/><joint name="rootz" type="slide" axis="0 0 1"/>
      <joint name="rooty" axis="0 1 0"/>)";
  const std::string mesh =
      R"(<asset><mesh name="sole" vertex="-.04 -.02 -.02 .04 -.02 -.02 -.04 .02 -.02 .04 .02 -.02
      -.04 -.02 .02 .04 -.02 .02 -.04 .02 .02 .04 .02 .02"/></asset>)";
  const std::string crouch =
      R"(<keyframe><key name="home" qpos="0 0 0.4 1 0 0 0 .5 -1 .5 -1 .5 -1 .5 -1" ctrl="0 0 0 0 0 0 0 0"/></keyframe>)";
  return {
      {"keyframe", "xml",
       model_text(four_legs(), "<freejoint/>", "", motors(R"(position kp="40" forcerange="-9 9")") + crouch),
       4, 8, 0},
      {"no_limits", "xml", with({.hip = "", .knee = ""}), 4, 8, 0},
      {"wide_ranges", "xml", with({.hip = R"(range="-180 180")", .knee = R"(range="-540 540")"}), 4, 8, 0},
      {"uneven_legs", "xml", model_text(uneven), 4, 10, 0},
      {"head", "xml", model_text(four_legs(), "<freejoint/>", head), 4, 8, 1},
      {"arm", "xml", model_text(four_legs(), "<freejoint/>", arm), 4, 8, 0},
      {"three_hinges", "xml", with({.hip_body = R"(<joint name="NAME_roll" axis="1 0 0" range="-20 20"/>
        <joint name="NAME_yaw" axis="0 0 1" range="-20 20"/>)"}),
       4, 16, 0},
      {"planar_base", "xml", model_text(four_legs(), planar), 4, 8, 0},
      {"fixed_base", "xml", model_text(four_legs(), ""), 4, 8, 0},
      {"mesh_feet", "xml",
       model_text(four_legs({.foot = R"(type="mesh" mesh="sole")"}), "<freejoint/>", "", "", mesh), 4, 8, 0},
      {"newer_mujoco", "xml",
       model_text(four_legs({.hip = R"(range="-40 40" actuatorfrcrange="-11 11")"}), "<freejoint/>", "",
                  motors(R"(position kp="30" kv="1.5" inheritrange="1")"),
                  R"(<option integrator="implicitfast" ls_iterations="5"/>)"),
       4, 8, 0},
      {"effort", "urdf", urdf_with_effort(), 2, 4, 0},
  };
}

}  // namespace amble::tests
