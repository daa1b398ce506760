#pragma once

#include <fmt/format.h>

#include <cmath>
#include <numbers>
#include <string>
#include <vector>

namespace amble::tests {

/// A leg of two segments of 15 cm that are turned against each other at angle 0, with a ball as its foot.
struct PosedLeg {
  std::string name = {};
  double x = 0.0, y = 0.0;
  double thigh_deg = 0.0, shin_deg = 0.0;  ///< about y, at angle 0
  double spread_deg = 0.0;                 ///< of the thigh about x
  std::string hip = "-150 150", knee = "-150 150";
  double shin_m = 0.15;
  std::string axis = "0 1 0";
  std::string roll = {};                    ///< range of a hinge about x before the hip's; empty: none
  std::string on_thigh = {}, on_shin = {};  ///< more elements
  bool ball = true;
};

inline std::string posed_leg(const PosedLeg& leg) {
  const double rad = std::numbers::pi / 180.0 / 2.0;
  const auto about = [&](double deg, const char* form) {
    return fmt::format(fmt::runtime(form), std::cos(rad * deg), std::sin(rad * deg));
  };
  std::string text =
      fmt::format(R"(<body name="{0}_upper" pos="{1} {2} 0" {3}><body name="{0}_mount" {4}>)", leg.name,
                  leg.x, leg.y, leg.spread_deg == 0.0 ? "" : about(leg.spread_deg, R"(quat="{} {} 0 0")"),
                  leg.thigh_deg == 0.0 ? "" : about(leg.thigh_deg, R"(quat="{} 0 {} 0")"));
  if (!leg.roll.empty())
    text += fmt::format(R"(<joint name="{}_roll" axis="1 0 0" range="{}"/>)", leg.name, leg.roll);
  text += fmt::format(R"(<joint name="{0}_swing" axis="{1}" range="{2}"/>
<geom type="capsule" fromto="0 0 0 0 0 -0.15" size="0.015" mass="0.2"/>{3}
<body name="{0}_lower" pos="0 0 -0.15" {4}><joint name="{0}_fold" axis="{1}" range="{5}"/>
<geom type="capsule" fromto="0 0 0 0 0 {6}" size="0.01" mass="0.1"/>)",
                      leg.name, leg.axis, leg.hip, leg.on_thigh,
                      leg.shin_deg == 0.0 ? "" : about(leg.shin_deg, R"(quat="{} 0 {} 0")"), leg.knee,
                      -leg.shin_m + 0.02);
  if (leg.ball)
    text +=
        fmt::format(R"(<geom name="{}_ball" pos="0 0 {}" size="0.02" mass="0.05"/>)", leg.name, -leg.shin_m);
  text += leg.on_shin + "</body></body></body>";
  for (std::size_t at = text.find("NAME"); at != std::string::npos; at = text.find("NAME"))
    text.replace(at, 4, leg.name);
  return text;
}

/// `turn`: attributes of the trunk; `more`: bodies on it; `behind`: sections after the world.
inline std::string posed_model(const std::vector<PosedLeg>& legs, const std::string& more = {},
                               const std::string& turn = {}, const std::string& behind = {}) {
  std::string text = fmt::format(
      R"(<mujoco><compiler autolimits="true"/><worldbody><body name="trunk" pos="0 0 0.5" {}><freejoint/>
<geom type="box" size="0.2 0.08 0.04" mass="3"/>)",
      turn);
  for (const PosedLeg& leg : legs) text += posed_leg(leg);
  return text + more + "</body></worldbody>" + behind + "</mujoco>";
}

inline std::vector<PosedLeg> posed_legs(const PosedLeg& like = {}) {
  std::vector<PosedLeg> legs(4, like);
  const char* names[] = {"LF", "RF", "LH", "RH"};
  for (std::size_t l = 0; l < 4; ++l) {
    legs[l].name = names[l];
    legs[l].x = l < 2 ? 0.18 : -0.18;
    legs[l].y = l % 2 == 0 ? 0.11 : -0.11;
    if (l % 2 != 0) legs[l].spread_deg = -like.spread_deg;
  }
  return legs;
}

/// A leg of a biped: hip, knee and ankle about y, and a flat foot.
struct FlatFootedLeg {
  std::string hip = "-100 100", knee = "0 130", ankle = "-60 60";
  std::string foot = R"(<geom type="box" size="0.1 0.05 0.012" pos="0.02 0 -0.02" mass="0.2"/>)";
};

inline std::string flat_footed_biped(const FlatFootedLeg& leg = {}, const std::string& more = {},
                                     const std::string& turn = {}, const std::string& behind = {}) {
  std::string text = fmt::format(
      R"(<mujoco><worldbody><body name="pelvis" pos="0 0 0.7" {}><freejoint/>
<geom type="box" size="0.06 0.1 0.12" pos="0 0 0.1" mass="3"/>)",
      turn);
  for (const auto& [name, y] : {std::pair{"left", 0.09}, {"right", -0.09}})
    text +=
        fmt::format(R"(<body name="{0}_femur" pos="0 {1} 0"><joint name="{0}_hip" axis="0 1 0" range="{2}"/>
<geom type="capsule" fromto="0 0 0 0 0 -0.25" size="0.03" mass="0.8"/>
<body name="{0}_tibia" pos="0 0 -0.26"><joint name="{0}_knee" axis="0 1 0" range="{3}"/>
<geom type="capsule" fromto="0 0 0 0 0 -0.24" size="0.025" mass="0.5"/>
<body name="{0}_sole" pos="0 0 -0.26"><joint name="{0}_ankle" axis="0 1 0" range="{4}"/>{5}</body></body></body>)",
                    name, y, leg.hip, leg.knee, leg.ankle, leg.foot);
  return text + more + "</body></worldbody>" + behind + "</mujoco>";
}

/// A hexapod whose legs turn about z at the body; lifted by `femur_deg` and bent by `tibia_deg` at angle 0.
inline std::string sprawling_hexapod(double femur_deg, double tibia_deg) {
  std::string text = R"(<mujoco><worldbody><body name="hull" pos="0 0 0.4"><freejoint/>
<geom type="box" size="0.2 0.06 0.03" mass="1.5"/>)";
  for (int l = 0; l < 6; ++l) {
    const int row = l / 2;
    const bool left = l % 2 == 0;
    text += fmt::format(
        R"(<body name="limb{0}" pos="{1} {2} 0" euler="0 0 {3}"><joint name="pan{0}" axis="0 0 1" range="-50 50"/>
<geom type="capsule" fromto="0 0 0 0.04 0 0" size="0.012" mass="0.05"/>
<body name="mid{0}" pos="0.05 0 0" euler="0 {4} 0"><joint name="lift{0}" axis="0 1 0" range="-115 115"/>
<geom type="capsule" fromto="0 0 0 0.09 0 0" size="0.012" mass="0.05"/>
<body name="tip{0}" pos="0.1 0 0" euler="0 {5} 0"><joint name="bend{0}" axis="0 1 0" range="-150 150"/>
<geom type="capsule" fromto="0 0 0 0.13 0 0" size="0.01" mass="0.04"/></body></body></body>)",
        l + 1, 0.16 - 0.16 * row, left ? 0.07 : -0.07,
        (left ? 90.0 : -90.0) + (row - 1) * (left ? 30.0 : -30.0), femur_deg, tibia_deg);
  }
  return text + "</body></worldbody></mujoco>";
}

}  // namespace amble::tests
