#include "amble/experiment/referees.hpp"

#include <gtest/gtest.h>

namespace amble::experiment {
namespace {

TEST(EngineResult, CountsTheMedianOfItsTrials) {
  EngineResult result;
  for (const double distance_m : {9.0, 1.0, 2.0}) {
    TrialResult trial;
    trial.distance_m = distance_m;
    result.trials.push_back(trial);
  }
  EXPECT_EQ(result.distance_m(), 2.0);
  result.trials.pop_back();
  EXPECT_EQ(result.distance_m(), 5.0);
}

}  // namespace
}  // namespace amble::experiment
