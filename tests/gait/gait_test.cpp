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

/// Ten strides of six legs without any spread; each pair at `across`, each lag at `lag`.
HexapodPhases six(double lag, double across = 0.5) {
  HexapodPhases phases;
  phases.pairs.fill({across, 1.0, 10});
  phases.lags.fill({lag, 1.0, 10});
  phases.lag = lag;
  phases.strides.fill(10);
  return phases;
}

TEST(HexapodRule, NamesTheGaitByTheLag) {
  const auto gait = [](double lag) { return classify(six(lag)); };
  const auto named = [](Gait name) { return Classification{name, Irregular::no}; };
  EXPECT_EQ(gait(1.0 / 2.0), named(Gait::tripod));
  EXPECT_EQ(gait(1.0 / 3.0), named(Gait::tetrapod));
  EXPECT_EQ(gait(1.0 / 6.0), named(Gait::wave));
  // Borders lie at 1/12, 3/12, 5/12 and 7/12.
  EXPECT_EQ(gait(0.418), named(Gait::tripod));
  EXPECT_EQ(gait(0.415), named(Gait::tetrapod));
  EXPECT_EQ(gait(0.252), named(Gait::tetrapod));
  EXPECT_EQ(gait(0.248), named(Gait::wave));
  EXPECT_EQ(gait(0.085), named(Gait::wave));
  EXPECT_EQ(gait(0.582), named(Gait::tripod));
  for (const double lag : {0.082, 0.0, 0.585, 0.75, 0.95})
    EXPECT_EQ(gait(lag), (Classification{Gait::irregular, Irregular::no_wave})) << lag;
}

TEST(HexapodRule, DemandsThatPairsAlternateOrInATetrapodDifferByAThird) {
  for (const double across : {0.401, 0.599}) EXPECT_EQ(classify(six(0.5, across)).gait, Gait::tripod);
  for (const double across : {0.399, 0.601, 1.0 / 3.0, 0.0})
    EXPECT_EQ(classify(six(0.5, across)), (Classification{Gait::irregular, Irregular::no_alternation}));
  for (const double across : {0.234, 1.0 / 3.0, 2.0 / 3.0, 0.766})
    EXPECT_EQ(classify(six(1.0 / 3.0, across)).gait, Gait::tetrapod);
  for (const double across : {0.233, 0.767, 0.0})
    EXPECT_EQ(classify(six(1.0 / 3.0, across)), (Classification{Gait::irregular, Irregular::no_alternation}));
  auto mixed = six(1.0 / 3.0, 1.0 / 3.0);
  mixed.pairs[1].phase = 2.0 / 3.0;
  EXPECT_EQ(classify(mixed).reason, Irregular::no_alternation);
}

TEST(HexapodRule, DemandsEqualLags) {
  for (std::size_t i = 0; i < 4; ++i) {
    auto phases = six(0.5);
    phases.lags[i].phase = 0.599;
    EXPECT_EQ(classify(phases).gait, Gait::tripod);
    phases.lags[i].phase = 0.601;
    EXPECT_EQ(classify(phases), (Classification{Gait::irregular, Irregular::uneven_lags}));
  }
}

TEST(HexapodRule, DemandsSteadyStridesOfEveryFoot) {
  auto phases = six(0.5);
  phases.strides[3] = 3;
  EXPECT_EQ(classify(phases).reason, Irregular::few_strides);
  phases.strides[3] = 20;
  EXPECT_EQ(classify(phases).reason, Irregular::uneven_counts);
  for (std::size_t i = 0; i < 3; ++i) {
    phases = six(0.5);
    phases.pairs[i].resultant = 0.699;
    EXPECT_EQ(classify(phases).reason, Irregular::spread_phases);
  }
  for (std::size_t i = 0; i < 4; ++i) {
    phases = six(0.5);
    phases.lags[i].resultant = 0.699;
    EXPECT_EQ(classify(phases).reason, Irregular::spread_phases);
  }
}

TEST(BipedRule, NamesTheGaitByPhaseAndDutyFactor) {
  const auto two = [](double phase, double duty_factor) {
    return classify(BipedPhases{.pair = {phase, 1.0, 10}, .duty_factor = duty_factor, .strides = {10, 10}});
  };
  for (const double phase : {0.401, 0.5, 0.599}) {
    EXPECT_EQ(two(phase, 0.6), (Classification{Gait::walk, Irregular::no}));
    EXPECT_EQ(two(phase, 0.5), (Classification{Gait::walk, Irregular::no}));
    EXPECT_EQ(two(phase, 0.499), (Classification{Gait::run, Irregular::no}));
  }
  for (const double phase : {0.901, 0.0, 0.099}) {
    EXPECT_EQ(two(phase, 0.6).gait, Gait::hop);
    EXPECT_EQ(two(phase, 0.3).gait, Gait::hop);
  }
  for (const double phase : {0.101, 0.25, 0.399, 0.601, 0.899})
    EXPECT_EQ(two(phase, 0.6), (Classification{Gait::irregular, Irregular::no_alternation})) << phase;
}

TEST(BipedRule, DemandsSteadyStridesOfBothFeet) {
  BipedPhases phases{.pair = {0.5, 1.0, 10}, .duty_factor = 0.6, .strides = {10, 3}};
  EXPECT_EQ(classify(phases).reason, Irregular::few_strides);
  phases.strides = {10, 20};
  EXPECT_EQ(classify(phases).reason, Irregular::uneven_counts);
  phases.strides = {10, 10};
  phases.pair.resultant = 0.699;
  EXPECT_EQ(classify(phases).reason, Irregular::spread_phases);
}

}  // namespace
}  // namespace amble::gait
