#include "amble/experiment/corrected_map.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <map>
#include <vector>

#include "amble/experiment/episodes.hpp"
#include "amble/experiment/evaluator.hpp"
#include "amble/neat/genome_io.hpp"
#include "amble/search/cells.hpp"
#include "tests/experiment/fixture.hpp"

namespace amble::experiment {
namespace {

/// What one elite did in its new trials.
struct Tried {
  std::uint32_t cell;
  double objective;
};

/// Each elite by itself, on one worker.
std::vector<Tried> try_again(const Repertoire& map, int episodes) {
  Problem problem = map.problem;
  problem.noise.score = trial::EpisodeScore::mean;
  const auto scenarios = unseen_scenarios(problem, map.config.seed, 0, episodes, nullptr, unstopped).value();
  const auto behaviour = map.config.make_behaviour(&problem.robot);
  const auto cells = search::make_cells(map.config.search.map_elites);
  Evaluator evaluator(problem, behaviour->path(), 1, behaviour->measures());
  std::vector<Tried> tried;
  for (std::uint32_t i = 0; i < map.elites.size(); ++i) {
    const std::vector<neat::Genome> genome{neat::expand(map.elites[i].genome, "elite")};
    const auto result = evaluator.evaluate(genome, unstopped, scenarios);
    tried.push_back({cells->of(behaviour->of(result->of_genome(0))), objectives(problem, *result)[0]});
  }
  return tried;
}

class TriedAgain : public EvolvedMap {};

TEST_F(TriedAgain, IsWhatMapElitesFillsWithTheNewTrials) {
  const Repertoire map = this->map();
  for (const int episodes : {1, 4}) {
    const CorrectedMap corrected_map = correct_map(map, episodes, 2, unstopped).value();
    double promised = 0.0, kept = 0.0;
    std::uint32_t in_place = 0;
    std::map<std::uint32_t, std::vector<double>> rivals;
    const auto tried = try_again(map, episodes);
    for (std::uint32_t i = 0; i < map.elites.size(); ++i) {
      promised += map.elites[i].objective;
      kept += tried[i].objective;
      in_place += tried[i].cell == map.elites[i].cell;
      rivals[tried[i].cell].push_back(tried[i].objective);
    }
    double corrected = 0.0;
    int decided_by_an_earlier_one = 0;
    for (const auto& [cell, objectives] : rivals) {
      corrected += std::ranges::max(objectives);
      decided_by_an_earlier_one += std::ranges::max(objectives) > objectives.back();
    }
    EXPECT_GT(decided_by_an_earlier_one, 0) << "else this test cannot tell the best of a cell from the last";
    EXPECT_EQ(corrected_map.elites.size(), map.elites.size());
    EXPECT_NEAR(corrected_map.promised(), promised, 1e-9);
    EXPECT_NEAR(corrected_map.kept(), kept, 1e-9);
    EXPECT_EQ(corrected_map.staying(), in_place);
    EXPECT_EQ(corrected_map.staying_share(), in_place / static_cast<double>(map.elites.size()));
    EXPECT_EQ(corrected_map.filled(), rivals.size());
    EXPECT_EQ(corrected_map.coverage(), static_cast<double>(rivals.size()) / map.elites.cells());
    EXPECT_NEAR(corrected_map.qd_score(), corrected, 1e-9);
  }
}

TEST_F(TriedAgain, IsTheSameForAnyNumberOfWorkers) {
  const auto one = correct_map(map(), 2, 1, unstopped).value(),
             three = correct_map(map(), 2, 3, unstopped).value();
  ASSERT_EQ(three.elites.size(), one.elites.size());
  for (std::size_t i = 0; i < one.elites.size(); ++i) {
    EXPECT_EQ(three.elites[i].objective, one.elites[i].objective);
    EXPECT_EQ(three.elites[i].descriptor, one.elites[i].descriptor);
    EXPECT_EQ(three.elites[i].typical_cell, one.elites[i].typical_cell);
  }
}

TEST(CorrectedMap, HasNoPlaceForAnEliteWhoseSimulationDiverged) {
  CorrectedMap corrected{.cells = 4, .trials = 1, .elites = {}};
  corrected.elites.push_back(
      {.cell = 2, .promised = 1.0, .objective = 0.5, .descriptor = {0.5f}, .typical_cell = 2});
  corrected.elites.push_back({.cell = 3, .promised = 3.0, .objective = 2.0, .descriptor = {}});
  EXPECT_EQ(corrected.staying_share(), 0.5);
  EXPECT_EQ(corrected.coverage(), 0.25);
  EXPECT_EQ(corrected.qd_score(), 0.5);
  EXPECT_EQ(CorrectedMap{}.staying_share(), 0.0);
}

}  // namespace
}  // namespace amble::experiment
