#include "amble/score/typical.hpp"

#include <gtest/gtest.h>

#include <array>

namespace amble::score {
namespace {

using record::Outcome;

TEST(Typical, IsTheMedianWithQuartilesAndTheLuckiestTrial) {
  const std::array values{5.0, 1.0, 9.0, 3.0, 2.0};
  const std::array outcomes{Outcome::completed, Outcome::fell, Outcome::completed, Outcome::completed,
                            Outcome::diverged};
  const Typical found = typical(values, outcomes);
  EXPECT_EQ(found, (Typical{.trials = 5,
                            .median = 3.0,
                            .lower_quartile = 2.0,
                            .upper_quartile = 5.0,
                            .best = 9.0,
                            .fell_share = 0.4}));
}

TEST(Typical, OfOneTrialIsThatTrial) {
  const Typical found = typical(std::array{2.5}, std::array{Outcome::completed});
  EXPECT_EQ(found.median, 2.5);
  EXPECT_EQ(found.lower_quartile, 2.5);
  EXPECT_EQ(found.best, 2.5);
  EXPECT_EQ(found.fell_share, 0.0);
}

TEST(Typical, DoesNotDependOnTheOrderOfTheTrials) {
  const std::array outcomes{Outcome::completed, Outcome::completed, Outcome::completed, Outcome::completed};
  EXPECT_EQ(typical(std::array{1.0, 2.0, 3.0, 10.0}, outcomes),
            typical(std::array{10.0, 3.0, 1.0, 2.0}, outcomes));
}

TEST(TypicalDeathTest, OfNoTrialIsRefused) {
  EXPECT_DEATH(typical({}, {}), "each trial has a value");
}

}  // namespace
}  // namespace amble::score
