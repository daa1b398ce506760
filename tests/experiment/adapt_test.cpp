#include "amble/experiment/adapt.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <vector>

#include "amble/core/error.hpp"
#include "amble/experiment/episodes.hpp"
#include "amble/experiment/evaluator.hpp"
#include "amble/neat/genome_io.hpp"
#include "tests/experiment/fixture.hpp"

namespace amble::experiment {
namespace {

/// The map, and a robot whose leg FL is missing.
class Adapting : public EvolvedMap {};

AdaptSettings settings() {
  AdaptSettings settings;
  settings.engine = "batch";
  settings.most_trials = 8;
  settings.damage.parts = {{.kind = damage::Kind::missing, .leg = "FL"}};
  settings.search.stop_share = 2.0;  // all trials
  settings.test_trials = 3;
  return settings;
}

/// Mean objective of an elite in trials first … first + count − 1 of those unseen, on one worker.
double mean_of(const Problem& problem, const Repertoire& map, std::uint32_t number, int first, int count) {
  Problem judged = problem;
  judged.noise.score = trial::EpisodeScore::mean;
  Evaluator evaluator(judged, record::PathSampling(), 1);
  const std::vector<neat::Genome> genome{neat::expand(map.elites[number].genome, "elite")};
  const auto scenarios = unseen_scenarios(judged, map.config.seed, first, count, nullptr, unstopped).value();
  return objectives(judged, *evaluator.evaluate(genome, unstopped, scenarios)).front();
}

std::map<std::uint32_t, std::uint32_t> numbers_by_cell(const Repertoire& map) {
  std::map<std::uint32_t, std::uint32_t> numbers;
  for (std::uint32_t i = 0; i < map.elites.size(); ++i) numbers[map.elites[i].cell] = i;
  return numbers;
}

TEST_F(Adapting, StartsWithTheMapsBestAndWithWhatTheMapSays) {
  const Repertoire map = this->map();
  const Adaptation adaptation = adapt(map, settings(), 2, unstopped).value();
  ASSERT_EQ(adaptation.steps.size(), 8u);
  EXPECT_FALSE(adaptation.done);
  EXPECT_DOUBLE_EQ(adaptation.steps[0].expected, map.elites.best_objective());
  EXPECT_NEAR(adaptation.steps[0].predicted, map.elites.best_objective(), 1e-9) << "nothing is known yet";
  const auto numbers = numbers_by_cell(map);
  for (const AdaptStep& step : adaptation.steps)
    EXPECT_DOUBLE_EQ(step.expected, map.elites[numbers.at(step.cell)].objective);
}

TEST_F(Adapting, MeasuresTheDamagedRobotInTrialsThatItsJudgesDoNotUse) {
  const Repertoire map = this->map();
  const Adaptation adaptation = adapt(map, settings(), 2, unstopped).value();
  const auto numbers = numbers_by_cell(map);
  const Problem damaged = damaged_problem(map, settings());
  for (std::size_t s = 0; s < adaptation.steps.size(); ++s)
    EXPECT_DOUBLE_EQ(adaptation.steps[s].measured, mean_of(damaged, map, numbers.at(adaptation.steps[s].cell),
                                                           settings().test_trials + static_cast<int>(s), 1))
        << s;
  AdaptSettings whole = settings();
  whole.damage = {};
  const std::uint32_t best = numbers.at(adaptation.steps[0].cell);
  EXPECT_DOUBLE_EQ(adaptation.intact, mean_of(damaged_problem(map, whole), map, best, 0, 3));
  EXPECT_DOUBLE_EQ(adaptation.damaged, mean_of(damaged, map, best, 0, 3));
  EXPECT_DOUBLE_EQ(adaptation.adapted, mean_of(damaged, map, numbers.at(adaptation.cell), 0, 3));
}

TEST_F(Adapting, TakesForATrialTheMeanOfAttemptsThatNoOtherTrialUses) {
  const Repertoire map = this->map();
  AdaptSettings thrice = settings();
  thrice.episodes = 3;
  const Adaptation adaptation = adapt(map, thrice, 2, unstopped).value();
  const auto numbers = numbers_by_cell(map);
  const Problem damaged = damaged_problem(map, thrice);
  ASSERT_EQ(adaptation.steps.size(), 8u);
  for (std::size_t s = 0; s < adaptation.steps.size(); ++s)
    EXPECT_DOUBLE_EQ(adaptation.steps[s].measured, mean_of(damaged, map, numbers.at(adaptation.steps[s].cell),
                                                           thrice.test_trials + 3 * static_cast<int>(s), 3))
        << s;
}

TEST_F(Adapting, PredictsOfEachGaitWhatTheTrialsBeforeLeaveOfTheMap) {
  const Repertoire map = this->map();
  const Adaptation adaptation = adapt(map, settings(), 2, unstopped).value();
  const auto& dimensions = map.config.search.map_elites.descriptors;
  std::vector<adaptation::Candidate> candidates;
  for (std::uint32_t i = 0; i < map.elites.size(); ++i) {
    candidates.push_back({.descriptor = {}, .expected = map.elites[i].objective});
    for (std::size_t d = 0; d < dimensions.size(); ++d)
      candidates[i].descriptor.push_back(
          std::clamp((double{map.elites.descriptor(i)[d]} - dimensions[d].least) /
                         (dimensions[d].most - dimensions[d].least),
                     0.0, 1.0));
  }
  adaptation::TrialAndError search(candidates, settings().search);
  const auto numbers = numbers_by_cell(map);
  for (const AdaptStep& step : adaptation.steps) {
    const std::uint32_t number = numbers.at(step.cell);
    EXPECT_EQ(search.next(), number);
    EXPECT_DOUBLE_EQ(step.predicted, search.mean(number));
    EXPECT_DOUBLE_EQ(step.deviation, search.deviation(number));
    search.tell(number, step.measured);
  }
  EXPECT_EQ(adaptation.cell, map.elites[static_cast<std::uint32_t>(search.best())].cell);
}

TEST_F(Adapting, IsTheSameForAnyNumberOfWorkers) {
  const Repertoire map = this->map();
  const Adaptation one = adapt(map, settings(), 1, unstopped).value();
  const Adaptation three = adapt(map, settings(), 3, unstopped).value();
  ASSERT_EQ(one.steps.size(), three.steps.size());
  for (std::size_t s = 0; s < one.steps.size(); ++s) {
    EXPECT_EQ(one.steps[s].cell, three.steps[s].cell);
    EXPECT_EQ(one.steps[s].measured, three.steps[s].measured);
  }
  EXPECT_EQ(one.adapted, three.adapted);
}

TEST_F(Adapting, StopsWhenNothingBetterIsPredictedOrWhenItIsTold) {
  const Repertoire map = this->map();
  AdaptSettings easy = settings();
  easy.search.stop_share = 0.0;
  const Adaptation adaptation = adapt(map, easy, 1, unstopped).value();
  EXPECT_TRUE(adaptation.done);
  EXPECT_EQ(adaptation.steps.size(), 1u);
  EXPECT_EQ(adaptation.cell, adaptation.steps[0].cell);
  EXPECT_EQ(adaptation.adapted, adaptation.damaged);
  const std::atomic<bool> stop{true};
  EXPECT_FALSE(adapt(map, settings(), 1, stop).has_value());
}

TEST_F(Adapting, RefusesAttemptsThatWouldAllBeTheSame) {
  Repertoire map = this->map();
  map.problem.noise = {};
  AdaptSettings thrice = settings();
  thrice.episodes = 3;
  EXPECT_THROW(adapt(map, thrice, 1, unstopped), UserError);
  EXPECT_NO_THROW(adapt(map, settings(), 1, unstopped));
}

TEST_F(Adapting, RefusesAnEngineOrADamageThatThereIsNot) {
  const Repertoire map = this->map();
  AdaptSettings unknown = settings();
  unknown.engine = "mujoko";
  EXPECT_THROW(adapt(map, unknown, 1, unstopped), UserError);
  AdaptSettings no_leg = settings();
  no_leg.damage.parts[0].leg = "FX";
  EXPECT_THROW(adapt(map, no_leg, 1, unstopped), UserError);
}

}  // namespace
}  // namespace amble::experiment
