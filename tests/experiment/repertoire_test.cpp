#include "amble/experiment/repertoire.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <vector>

#include "amble/neat/genome_io.hpp"
#include "tests/experiment/fixture.hpp"

namespace amble::experiment {
namespace {

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
