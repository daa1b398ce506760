#include "amble/experiment/repertoire.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <vector>

#include "amble/experiment/episodes.hpp"
#include "amble/experiment/evaluator.hpp"
#include "amble/neat/genome_compact.hpp"
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
  const auto scenarios = unseen_scenarios(problem, map.config.seed, 0, episodes, nullptr);
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

class EvolvedMap : public testing::Test {
 protected:
  EvolvedMap() {
    auto config = small_map_config(all_noise());
    config.generations = 6;
    Listener listener;
    Run::start(scratch_ / "run", config, 2).execute(listener, listener.stop);
  }
  Repertoire map() const { return load_repertoire(RunPaths(scratch_ / "run")); }

 private:
  TemporaryFolder scratch_;
};

TEST_F(EvolvedMap, TriedAgainIsWhatMapElitesFillsWithTheNewTrials) {
  const Repertoire map = this->map();
  for (const int episodes : {1, 4}) {
    const Retest retest = experiment::retest(map, episodes, 2, unstopped).value();
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
    EXPECT_EQ(retest.elites, map.elites.size());
    EXPECT_NEAR(retest.promised, promised, 1e-9);
    EXPECT_NEAR(retest.kept, kept, 1e-9);
    EXPECT_EQ(retest.in_place, in_place);
    EXPECT_EQ(retest.corrected_elites, rivals.size());
    EXPECT_NEAR(retest.corrected_score, corrected, 1e-9);
  }
}

TEST_F(EvolvedMap, TriedAgainIsTheSameForAnyNumberOfWorkers) {
  const Retest one = retest(map(), 2, 1, unstopped).value(), three = retest(map(), 2, 3, unstopped).value();
  EXPECT_EQ(three.kept, one.kept);
  EXPECT_EQ(three.in_place, one.in_place);
  EXPECT_EQ(three.corrected_elites, one.corrected_elites);
  EXPECT_EQ(three.corrected_score, one.corrected_score);
}

TEST_F(EvolvedMap, HasElitesWhoseChampionsHaveTheEpisodesOfTheirEvaluation) {
  const Repertoire map = this->map();
  int evaluated_once = 0;
  for (std::uint32_t i = 0; i < map.elites.size(); ++i) {
    const search::Elite& elite = map.elites[i];
    const Champion champion = elite_champion(map, elite.cell, 1, unstopped).value();
    EXPECT_EQ(champion.genome, neat::expand(elite.genome, "elite"));
    EXPECT_EQ(champion.generation, static_cast<int>(elite.round));
    EXPECT_EQ(champion.index, static_cast<int>(elite.candidate));
    if (elite.evaluations > 1) continue;
    ++evaluated_once;
    EXPECT_NEAR(champion.objective(), elite.objective, 1e-12 * std::abs(elite.objective));
  }
  EXPECT_GT(evaluated_once, 1);
}

}  // namespace
}  // namespace amble::experiment
