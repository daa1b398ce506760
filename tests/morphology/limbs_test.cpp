#include "amble/morphology/limbs.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "amble/core/index.hpp"
#include "amble/morphology/leg_choice.hpp"
#include "tests/models/posed_models.hpp"
#include "tests/morphology/files.hpp"

namespace amble::morphology {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;
using tests::posed_legs;
using tests::posed_model;
using tests::PosedLeg;

class Limbs : public testing::Test {
 protected:
  ModelParts parts_of(const std::string& text) const {
    return extract_parts(compile_model(files_.write("m.xml", text)));
  }
  static std::vector<std::string> names(const ModelParts& parts, const std::vector<int>& joints) {
    std::vector<std::string> names;
    for (const int j : joints) names.push_back(parts.joints[to_index(j)].name);
    return names;
  }
  const Files files_;
};

const std::string rod =
    R"(<body name="NAME_rod" pos="0 0 -0.04"><joint name="NAME_pivot" axis="0 1 0"/><geom size="0.005" pos="0.02 0 0" mass="0.01"/></body>)";

TEST_F(Limbs, AreTheSameInEveryPose) {
  for (const PosedLeg& like :
       {PosedLeg{}, PosedLeg{.thigh_deg = 90.0, .shin_deg = 180.0}, PosedLeg{.spread_deg = 70.0}}) {
    const ModelParts parts = parts_of(posed_model(posed_legs(like)));
    const std::vector<Limb> limbs = find_limbs(parts);
    ASSERT_EQ(limbs.size(), 4u);
    EXPECT_THAT(names(parts, limbs[0].joints), ElementsAre("LF_swing", "LF_fold"));
    for (const Limb& limb : limbs) EXPECT_NEAR(limb.length_m, 0.3, 1e-9);
  }
}

TEST_F(Limbs, LeversBranchOffAndChainsGoOn) {
  for (const PosedLeg& like : {PosedLeg{.on_thigh = rod}, PosedLeg{.on_shin = rod}}) {
    const ModelParts parts = parts_of(posed_model(posed_legs(like)));
    const Limb limb = find_limbs(parts).front();
    EXPECT_THAT(names(parts, limb.joints), ElementsAre("LF_swing", "LF_fold"));
    EXPECT_THAT(names(parts, limb.side_joints), ElementsAre("LF_pivot"));
    EXPECT_THAT(limb.toe_joints, IsEmpty());
  }
}

TEST_F(Limbs, OneToeIsThePartAtTheEndOfAChainAndTwoBranchOff) {
  const auto toe = [](int number) {
    return fmt::format(
        R"(<body name="NAME_toe{0}" pos="0 {1} -0.15"><joint name="NAME_curl{0}" axis="0 1 0"/><geom size="0.01" pos="0.03 0 0" mass="0.01"/></body>)",
        number, 0.02 * number);
  };
  ModelParts parts = parts_of(posed_model(posed_legs({.on_shin = toe(0), .ball = false})));
  EXPECT_THAT(names(parts, find_limbs(parts)[0].joints), ElementsAre("LF_swing", "LF_fold", "LF_curl0"));
  parts = parts_of(posed_model(posed_legs({.on_shin = toe(0) + toe(1), .ball = false})));
  EXPECT_THAT(names(parts, find_limbs(parts)[0].joints), ElementsAre("LF_swing", "LF_fold"));
  EXPECT_THAT(names(parts, find_limbs(parts)[0].toe_joints), ElementsAre("LF_curl0", "LF_curl1"));
}

TEST_F(Limbs, LegsBehindASpineHangFromThePartThatItMoves) {
  std::string rear =
      R"(<body name="rump" pos="-0.2 0 0"><joint name="spine" axis="0 0 1" range="-30 30"/><geom type="box" size="0.1 0.08 0.04" mass="1"/>)";
  for (const double y : {0.11, -0.11})
    rear += tests::posed_leg({.name = y > 0 ? "LH" : "RH", .x = -0.1, .y = y});
  auto front = posed_legs();
  front.resize(2);
  const ModelParts parts = parts_of(posed_model(front, rear + "</body>"));
  const std::vector<Limb> limbs = find_limbs(parts);
  ASSERT_EQ(limbs.size(), 4u);
  for (const Limb& limb : limbs) EXPECT_EQ(limb.joints.size(), 2u);
  EXPECT_EQ(parts.bodies[to_index(limbs.back().trunk)].name, "rump");
}

TEST_F(Limbs, PartsOfLegsAreToldFromWordsThatOnlyContainThem) {
  // "whip" is no hip, and "swing" no wing.
  const std::string whip =
      R"(<body name="whip" pos="-0.2 0 0.02"><joint name="whip" axis="0 1 0"/><geom type="capsule" fromto="0 0 0 -0.2 0 0" size="0.01" mass="0.1"/></body>)";
  const ModelParts parts = parts_of(posed_model(posed_legs({.thigh_deg = 90.0, .shin_deg = 180.0}), whip));
  const LegChoice choice = choose_legs(parts, find_limbs(parts), LegSearch::by_structure);
  EXPECT_THAT(choice.limbs, ElementsAre(0, 1, 2, 3));
}

}  // namespace
}  // namespace amble::morphology
