#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "amble/neat/genome_io.hpp"
#include "amble/search/map_elites.hpp"

namespace amble::search {
namespace {

/// Which of two genomes this one descends from, by mutations that change weights by 1e-9 at most.
bool descends(const neat::Genome& genome, const neat::Genome& from, const neat::Genome& other) {
  const auto distance = [&](const neat::Genome& ancestor) {
    return std::abs(genome.links[0].weight - ancestor.links[0].weight);
  };
  return distance(from) < distance(other);
}

TEST(Curiosity, OfAnEliteMovesWithItToAnotherCell) {
  MapElitesSettings settings;
  settings.descriptors.assign(1, {});
  settings.descriptors[0].bins = 4;
  settings.batch = settings.initial = 4000;
  settings.reevaluate_share = 0.01;
  settings.select = Selection::curiosity;
  settings.crossover_probability = 0.0;
  neat::Settings neat;
  neat.mutation.add_node_share = neat.mutation.add_link_share = 0.0;
  neat.mutation.weights = {.jiggle_limit = 1e-9,
                           .jiggle_many_share = 0.0,
                           .jiggle_few_share = 0.0,
                           .jiggle_one_share = 1.0,
                           .reset_few_share = 0.0,
                           .reset_one_share = 0.0};
  MapElites search(
      settings,
      {.neat = neat, .inputs = 3, .outputs = 2, .recurrent = true, .seed = 9, .behaviour_length = 1});
  const neat::Genome curious = search.ask()[0], other = search.ask()[1];
  std::vector<float> places(4000, 0.1f);
  std::vector<Evaluation> results;
  const auto tell = [&](auto place_and_objective) {
    results.clear();
    const auto candidates = search.ask();
    for (std::size_t i = 0; i < candidates.size(); ++i) {
      const auto [place, objective] = place_and_objective(i, candidates[i]);
      places[i] = place;
      results.push_back({.objective = objective, .behaviour = {&places[i], 1}, .viable = objective > 0.0});
    }
    search.tell(results);
  };
  using Result = std::pair<float, double>;
  const Result fails{0.0f, 0.0};

  // The two elites, in the first and the last cell.
  tell([&](std::size_t i, const auto&) {
    return i == 0 ? Result{0.1f, 1.0} : i == 1 ? Result{0.9f, 1.0} : fails;
  });
  ASSERT_EQ(search.elites().size(), 2u);
  // Children of the first take the third cell, each better than the last; those of the second fail.
  tell([&](std::size_t i, const auto& candidate) {
    const bool first = descends(candidate, curious, other);
    if (i < 2) return Result{first ? 0.1f : 0.9f, 1.0};
    return first ? Result{0.6f, 1.0 + static_cast<double>(i)} : fails;
  });
  ASSERT_EQ(search.elites().size(), 3u);
  // The first moves to the second cell, to 0.4 on average; no child enters.
  tell([&](std::size_t i, const auto& candidate) {
    if (i >= 3) return fails;
    if (candidate == curious) return Result{1.0f, 1.0};
    return candidate == other ? Result{0.9f, 1.0} : Result{0.6f, 1e6};
  });
  ASSERT_EQ(search.elites().size(), 3u);
  ASSERT_NE(search.elites().in(1), Elites::none);
  ASSERT_EQ(neat::expand(search.elites()[search.elites().in(1)].genome, ""), curious);
  // The more curious of two elites drawn is a parent, and else the one drawn first: the second elite is
  // if it is drawn first and then itself or the third, 2/9. Were all alike, it would be 1/3.
  const auto candidates = search.ask().subspan(3);
  const auto share =
      static_cast<double>(std::ranges::count_if(
          candidates, [&](const neat::Genome& child) { return descends(child, other, curious); })) /
      static_cast<double>(candidates.size());
  EXPECT_NEAR(share, 2.0 / 9.0, 0.03);
}

}  // namespace
}  // namespace amble::search
