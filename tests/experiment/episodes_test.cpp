#include "amble/experiment/episodes.hpp"

#include <gtest/gtest.h>

#include <array>
#include <atomic>

#include "amble/experiment/plan/typical_level.hpp"
#include "tests/experiment/fixture.hpp"

namespace amble::experiment {
namespace {

TEST(Episodes, CountByTheirMeanMedianLowerQuartileOrWorst) {
  const std::array<double, 3> distances_m{3.0, 1.0, 5.0};
  EXPECT_EQ(objective(trial::EpisodeScore::mean, distances_m), 3.0);
  EXPECT_EQ(objective(trial::EpisodeScore::worst, distances_m), 1.0);
  EXPECT_EQ(objective(trial::EpisodeScore::median, std::array{9.0, 1.0, 2.0}), 2.0);
  EXPECT_EQ(objective(trial::EpisodeScore::lower_quartile, std::array{1.0, 2.0, 3.0, 4.0, 5.0}), 2.0);
}

TEST(Episodes, OfWhichThereIsButOneCountAsItsDistanceToTheBit) {
  const std::array<double, 1> distance_m{0.1 + 0.2};
  EXPECT_EQ(objective(trial::EpisodeScore::mean, distance_m), 0.1 + 0.2);
  EXPECT_EQ(objective(trial::EpisodeScore::worst, distance_m), 0.1 + 0.2);
}

/// A problem whose episodes are combined so.
Problem problem_of(trial::EpisodeScore combined, double fall_factor = 1.0) {
  Problem problem = small_problem();
  problem.noise.score = combined;
  problem.trial.fall_factor = fall_factor;
  return problem;
}

TEST(Episodes, BelongToTheirGenomes) {
  GenerationResult result;
  result.episodes = 2;
  for (const double walked_m : {1.0, 3.0, 10.0, 30.0}) {
    record::Trajectory trajectory;
    trajectory.com_end_m = {walked_m, 0.0, 0.0};
    result.trajectories.push_back(trajectory);
  }
  EXPECT_EQ(objectives(problem_of(trial::EpisodeScore::mean), result), (std::vector<double>{2.0, 20.0}));
  EXPECT_EQ(objectives(problem_of(trial::EpisodeScore::worst), result), (std::vector<double>{1.0, 10.0}));
}

TEST(Episodes, ThatEndInAFallCountForTheShareThatIsSet) {
  GenerationResult result;
  result.episodes = 2;
  for (const auto outcome : {record::Outcome::fell, record::Outcome::completed}) {
    record::Trajectory trajectory;
    trajectory.com_end_m = {4.0, 0.0, 0.0};
    trajectory.outcome = outcome;
    result.trajectories.push_back(trajectory);
  }
  EXPECT_EQ(objectives(problem_of(trial::EpisodeScore::mean, 0.5), result), (std::vector<double>{3.0}));
  EXPECT_EQ(objectives(problem_of(trial::EpisodeScore::mean, 0.0), result), (std::vector<double>{2.0}));
}

TEST(Episodes, UnseenOnesAreNotDrawnOnceTheyAreNoLongerWanted) {
  Problem problem = small_problem();
  problem.noise = typical_level(problem, "milli").noise;
  const std::atomic<bool> stopped = true;
  EXPECT_EQ(unseen_scenarios(problem, 1, 0, 3, nullptr, unstopped).value().size(), 3U);
  EXPECT_FALSE(unseen_scenarios(problem, 1, 0, 3, nullptr, stopped));
}

TEST(Episodes, AreScoredAsTheConfigSays) {
  Problem problem = problem_of(trial::EpisodeScore::mean);
  problem.score.terms = {{.quantity = "forward"}};
  GenerationResult result;
  result.trajectories.resize(1);
  result.trajectories[0].com_end_m = {3.0, 4.0, 0.0};
  EXPECT_EQ(objectives(problem, result), (std::vector<double>{3.0}));
}

}  // namespace
}  // namespace amble::experiment
