#include "amble/gait/gait.hpp"

#include <gtest/gtest.h>

namespace amble::gait {
namespace {

/// Ten strides of a gait without any spread. `hind` and `fore`: right after left; `lateral`: fore after hind.
QuadrupedPhases steady(double hind, double fore, double lateral) {
  const auto pair = [](double phase) { return PairPhase{phase, 1.0, 10}; };
  return {.hind = pair(hind),
          .fore = pair(fore),
          .left = pair(lateral),
          .right = pair(lateral),
          .lateral = lateral,
          .strides = {10, 10, 10, 10}};
}

struct Case {
  double hind, fore, lateral;
  Gait gait;
};

class Rule : public testing::TestWithParam<Case> {};

TEST_P(Rule, NamesTheGait) {
  const auto [hind, fore, lateral, gait] = GetParam();
  EXPECT_EQ(classify(steady(hind, fore, lateral)), (Classification{gait, Irregular::no}));
}

INSTANTIATE_TEST_SUITE_P(Centres, Rule,
                         testing::Values(Case{0.5, 0.5, 0.25, Gait::walk_lateral},
                                         Case{0.5, 0.5, 0.75, Gait::walk_diagonal},
                                         Case{0.5, 0.5, 0.5, Gait::trot}, Case{0.5, 0.5, 0.0, Gait::pace},
                                         Case{0.0, 0.0, 0.5, Gait::bound}, Case{0.0, 0.0, 0.0, Gait::pronk},
                                         Case{0.2, 0.2, 0.6, Gait::gallop},
                                         Case{0.0, 0.25, 0.5, Gait::gallop}));

INSTANTIATE_TEST_SUITE_P(
    LateralBorders, Rule,
    testing::Values(Case{0.5, 0.5, 0.0625, Gait::pace}, Case{0.5, 0.5, 0.063, Gait::walk_lateral},
                    Case{0.5, 0.5, 0.437, Gait::walk_lateral}, Case{0.5, 0.5, 0.4375, Gait::trot},
                    Case{0.5, 0.5, 0.5625, Gait::trot}, Case{0.5, 0.5, 0.563, Gait::walk_diagonal},
                    Case{0.5, 0.5, 0.937, Gait::walk_diagonal}, Case{0.5, 0.5, 0.9375, Gait::pace},
                    Case{0.5, 0.5, 0.9999, Gait::pace}));

INSTANTIATE_TEST_SUITE_P(
    PairBorders, Rule,
    testing::Values(Case{0.401, 0.599, 0.5, Gait::trot}, Case{0.39, 0.39, 0.5, Gait::gallop},
                    Case{0.61, 0.61, 0.5, Gait::gallop}, Case{0.099, 0.901, 0.5, Gait::bound},
                    Case{0.101, 0.0, 0.5, Gait::gallop}, Case{0.0, 0.899, 0.5, Gait::gallop},
                    Case{0.0, 0.0, 0.099, Gait::pronk}, Case{0.0, 0.0, 0.901, Gait::pronk},
                    Case{0.0, 0.0, 0.101, Gait::bound}, Case{0.0, 0.0, 0.899, Gait::bound}));

TEST(Rule, CallsOneAlternatingPairIrregular) {
  EXPECT_EQ(classify(steady(0.5, 0.0, 0.25)), (Classification{Gait::irregular, Irregular::mixed_pairs}));
  EXPECT_EQ(classify(steady(0.2, 0.5, 0.25)), (Classification{Gait::irregular, Irregular::mixed_pairs}));
}

TEST(Rule, DemandsFourStridesOfEveryFoot) {
  auto phases = steady(0.5, 0.5, 0.5);
  phases.strides = {4, 4, 4, 4};
  EXPECT_EQ(classify(phases).gait, Gait::trot);
  phases.strides = {4, 4, 3, 4};
  EXPECT_EQ(classify(phases), (Classification{Gait::irregular, Irregular::few_strides}));
}

TEST(Rule, DemandsThatFeetLandEquallyOftenButForAQuarterAndOne) {
  auto phases = steady(0.5, 0.5, 0.5);
  phases.strides = {20, 20, 20, 26};
  EXPECT_EQ(classify(phases).gait, Gait::trot);
  phases.strides = {20, 20, 20, 27};
  EXPECT_EQ(classify(phases), (Classification{Gait::irregular, Irregular::uneven_counts}));
}

TEST(Rule, DemandsThatEveryPairKeepsItsPhase) {
  for (PairPhase QuadrupedPhases::*pair :
       {&QuadrupedPhases::hind, &QuadrupedPhases::fore, &QuadrupedPhases::left, &QuadrupedPhases::right}) {
    auto phases = steady(0.5, 0.5, 0.5);
    (phases.*pair).resultant = 0.7;
    EXPECT_EQ(classify(phases).gait, Gait::trot);
    (phases.*pair).resultant = 0.699;
    EXPECT_EQ(classify(phases), (Classification{Gait::irregular, Irregular::spread_phases}));
  }
}

}  // namespace
}  // namespace amble::gait
