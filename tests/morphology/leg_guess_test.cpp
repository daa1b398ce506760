#include "amble/morphology/leg_guess.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "amble/morphology/robot_guess.hpp"
#include "tests/morphology/files.hpp"

namespace amble::morphology {
namespace {

using testing::ElementsAreArray;

struct Place {
  double x, y;
  double foot_y = 0.0;  ///< of the foot beside the hip
};

const std::vector<Place> four_places{{0.2, 0.1}, {0.2, -0.1}, {-0.2, 0.1}, {-0.2, -0.1}};

/// A trunk with legs at these places; `joints`: names by leg, from the trunk outwards.
std::string model_of_legs(const std::vector<std::vector<std::string>>& joints,
                          const std::vector<Place>& places) {
  std::string text =
      R"(<mujoco><worldbody><body name="trunk" pos="0 0 0.5"><freejoint/><geom type="box" size=".2 .1 .05"/>)";
  for (std::size_t l = 0; l < joints.size(); ++l) {
    const double length_m = 0.4 / static_cast<double>(joints[l].size());
    for (std::size_t j = 0; j < joints[l].size(); ++j)
      text += fmt::format(
          R"(<body pos="{} {} {}"><joint name="{}" axis="0 1 0" range="-40 40"/><geom size=".01" mass=".1"/>)",
          j == 0 ? places[l].x : 0.0, j == 0 ? places[l].y : 0.0, j == 0 ? 0.0 : -length_m, joints[l][j]);
    text += fmt::format(R"(<geom name="foot{}" pos="0 {} {}" size=".02" mass=".1"/>)", l, places[l].foot_y,
                        -length_m);
    for (std::size_t j = 0; j < joints[l].size(); ++j) text += "</body>";
  }
  return text + "</body></worldbody></mujoco>";
}

LegsGuess guess_of(const Files& files, const std::string& text) {
  return guess_legs(extract_parts(compile_model(files.write("m.xml", text))));
}

std::vector<std::string> names_of(const LegsGuess& guess) {
  std::vector<std::string> names;
  for (const LegGuess& leg : guess.legs) names.push_back(leg.name);
  return names;
}

struct Names {
  const char* what;
  std::vector<std::vector<std::string>> joints;
  std::vector<std::string> legs, types;  ///< that are to be found
};

/// How makers of robots name joints.
const Names ways_to_name[] = {
    {"LegAndType",
     {{"FL_hip", "FL_knee"}, {"FR_hip", "FR_knee"}, {"RL_hip", "RL_knee"}, {"RR_hip", "RR_knee"}},
     {"FL", "FR", "RL", "RR"},
     {"knee", "hip"}},
    {"WordsOfAllJoints",
     {{"robot_FL_hip_joint", "robot_FL_knee_joint"},
      {"robot_FR_hip_joint", "robot_FR_knee_joint"},
      {"robot_RL_hip_joint", "robot_RL_knee_joint"},
      {"robot_RR_hip_joint", "robot_RR_knee_joint"}},
     {"FL", "FR", "RL", "RR"},
     {"knee", "hip"}},
    {"NumbersBehindTypes",
     {{"hip1", "knee1"}, {"hip2", "knee2"}, {"hip3", "knee3"}, {"hip4", "knee4"}},
     {"leg1", "leg2", "leg3", "leg4"},
     {"knee", "hip"}},
    {"OneJointPerLeg", {{"FL_hip"}, {"FR_hip"}, {"RL_hip"}, {"RR_hip"}}, {"FL", "FR", "RL", "RR"}, {"hip"}},
    {"OneLegWithAWordOfItsOwn",
     {{"left_hip", "left_knee"}, {"hip", "knee"}},
     {"left", "right"},
     {"knee", "hip"}},
    {"TypesNamedAsLegs", {{"a_x", "a_b"}, {"b_x", "b_a"}}, {"a", "b"}, {"a_hinge", "b_hinge", "x"}},
    {"TypesNamedAsKeysOfTheFile",
     {{"a_foot", "a_joint"}, {"b_foot", "b_joint"}},
     {"a", "b"},
     {"joint_hinge", "foot_hinge"}},
    {"Capitals", {{"FLHip", "FLKnee"}, {"FRHip", "FRKnee"}}, {"FL", "FR"}, {"Knee", "Hip"}},
};

TEST(LegGuess, ReadsTheNamesThatMakersOfRobotsGive) {
  const Files files;
  for (const Names& way : ways_to_name) {
    const std::string text = model_of_legs(way.joints, four_places);
    const LegsGuess guess = guess_of(files, text);
    EXPECT_THAT(names_of(guess), ElementsAreArray(way.legs)) << way.what;
    auto types = guess.joint_types, expected = way.types;
    std::ranges::sort(types);
    std::ranges::sort(expected);
    EXPECT_EQ(types, expected) << way.what;
    // The file that is guessed is one that can be read, and each joint of a leg is driven.
    const auto file = guess_robot(compile_model(files.path("m.xml")), "m.xml");
    const robot::RobotSpec robot = load_robot(files.write("m.toml", file.toml));
    EXPECT_EQ(robot.leg_joint_count(), way.joints.size() * way.joints[0].size()) << way.what;
  }
}

/// Names of joints that tell nothing.
std::vector<std::vector<std::string>> silent_names(std::size_t legs) {
  std::vector<std::vector<std::string>> joints(legs);
  for (std::size_t l = 0; l < legs; ++l)
    joints[l] = {fmt::format("motor{}", 2 * l + 1), fmt::format("motor{}", 2 * l + 2)};
  return joints;
}

TEST(LegGuess, NamesLegsByPlaceSideBySideAndRowByRow) {
  struct Case {
    std::vector<Place> places;
    std::vector<std::string> names;  ///< in the order of the guess, from the front, left before right
  };
  const Case cases[] = {
      {four_places, {"front_left", "front_right", "rear_left", "rear_right"}},
      {{{0.0, 0.1}, {0.0, -0.1}}, {"left", "right"}},
      {{{0.2, 0.0}, {-0.2, 0.0}}, {"front", "rear"}},
      // Feet on the centre line, and across it: a leg is on the side of most of it.
      {{{0.2, 0.1, -0.1}, {0.2, -0.1, 0.1}, {-0.2, 0.1, -0.1}, {-0.2, -0.1, 0.1}},
       {"front_left", "front_right", "rear_left", "rear_right"}},
      {{{0.2, 0.1, -0.15}, {0.2, -0.1, 0.15}, {-0.2, 0.1, -0.15}, {-0.2, -0.1, 0.15}},
       {"front_left", "front_right", "rear_left", "rear_right"}},
      // Two legs of a side at the same place along the robot.
      {{{0.1, 0.2}, {0.1, 0.1}, {0.1, -0.1}, {0.1, -0.2}},
       {"front_left", "rear_left", "front_right", "rear_right"}},
      {{{0.2, 0.1}, {0.2, -0.1}, {0.0, 0.1}, {0.0, -0.1}, {-0.2, 0.1}, {-0.2, -0.1}},
       {"front_left", "front_right", "middle_left", "middle_right", "rear_left", "rear_right"}},
      {{{0.3, 0.1},
        {0.3, -0.1},
        {0.1, 0.1},
        {0.1, -0.1},
        {-0.1, 0.1},
        {-0.1, -0.1},
        {-0.3, 0.1},
        {-0.3, -0.1}},
       {"row1_left", "row1_right", "row2_left", "row2_right", "row3_left", "row3_right", "row4_left",
        "row4_right"}},
      {{{0.0, 0.0}}, {"leg"}},
      // A leg in the middle has no name by place if it is the only one there.
      {{{0.2, 0.1}, {0.2, -0.1}, {-0.2, 0.0}}, {"leg1", "leg2", "leg3"}},
  };
  const Files files;
  for (const Case& one : cases) {
    // The order of the legs in the model does not matter; only numbers follow it.
    auto places = one.places;
    const bool numbered = one.names[0] == "leg1";
    for (int order = 0; order < (numbered ? 1 : 2); ++order, std::ranges::reverse(places)) {
      const LegsGuess guess = guess_of(files, model_of_legs(silent_names(places.size()), places));
      if (places.size() > 1 && places[0].x == places[1].x && places.size() == 4 &&
          places[2].x == places[0].x) {
        auto found = names_of(guess), expected = one.names;
        std::ranges::sort(found);
        std::ranges::sort(expected);
        EXPECT_EQ(found, expected);
      } else {
        EXPECT_THAT(names_of(guess), ElementsAreArray(one.names)) << order;
      }
    }
  }
}

TEST(LegGuess, SaysWhereItHasNamesFrom) {
  const Files files;
  const auto reason = [&](const std::vector<std::vector<std::string>>& joints) {
    return guess_of(files, model_of_legs(joints, four_places)).why_names;
  };
  EXPECT_EQ(reason({{"FL_hip", "FL_knee"}, {"FR_hip", "FR_knee"}}),
            "the words that the names of a leg's joints share");
  EXPECT_EQ(reason({{"flhip", "flknee"}, {"frhip", "frknee"}}),
            "what the names of a leg's joints begin with");
  EXPECT_EQ(reason(silent_names(4)), "by place: the names of joints do not tell");
}

TEST(LegGuess, TakesNoFootThatIsOnlyToLookAt) {
  const Files files;
  const std::string text =
      with(model_of_legs(silent_names(4), four_places), R"(<geom name="foot0")",
           R"(<geom name="sock" pos="0 0 -0.5" size=".05" mass="0" contype="0" conaffinity="0"/>
              <geom name="foot0")");
  const ModelParts parts = extract_parts(compile_model(files.write("m.xml", text)));
  ASSERT_EQ(std::ranges::count(parts.geoms, "sock", &robot::Geom::name), 1);
  std::set<std::string> feet;
  for (const LegGuess& leg : guess_legs(parts).legs)
    feet.insert(parts.geoms[static_cast<std::size_t>(leg.foot_geom)].name);
  EXPECT_EQ(feet, (std::set<std::string>{"foot0", "foot1", "foot2", "foot3"}));
}

TEST(LegGuess, EndsNearTheGroundWhereverTheModelStands) {
  // A tail that ends at 0.3 of the height of the centre of mass over the lowest point is no leg, one at 0.2
  // is; and nothing changes when the whole robot is put higher or lower.
  const Files files;
  for (const double root_m : {0.5, 2.0, -3.0})
    for (const double share : {0.2, 0.3}) {
      const double tail_m = share * 0.42;
      std::string text = model_of_legs(silent_names(4), four_places);
      text = with(text, "0 0 0.5", fmt::format("0 0 {}", root_m));
      // A heavy trunk: the centre of mass is its, 0.42 m over the lowest point.
      text = with(text, R"(size=".2 .1 .05")", R"(size=".2 .1 .05" mass="1000")");
      text = with(text, "</body></worldbody>",
                  fmt::format(R"(<body pos="-0.4 0 0"><joint name="fifth" axis="0 1 0" range="-9 9"/>
                                 <geom pos="0 0 {}" size="0.01" mass="0.01"/></body></body></worldbody>)",
                              -0.42 + tail_m + 0.01));
      EXPECT_EQ(guess_of(files, text).legs.size(), share < 0.25 ? 5u : 4u) << root_m << " " << share;
    }
}

TEST(LegGuess, TakesATailThatRestsOnTheGroundForNoLeg) {
  const Files files;
  std::string text = model_of_legs(silent_names(4), four_places);
  for (const auto& [name, legs] : {std::pair{"tail_pitch", 4u}, {"fifth", 5u}}) {
    const std::string model =
        with(text, "</body></worldbody>",
             fmt::format(R"(<body pos="-0.4 0 0"><joint name="{}" axis="0 1 0" range="-9 9"/>
                                 <geom pos="0 0 -0.41" size="0.01" mass="0.01"/></body></body></worldbody>)",
                         name));
    EXPECT_EQ(guess_of(files, model).legs.size(), legs) << name;
  }
}

}  // namespace
}  // namespace amble::morphology
