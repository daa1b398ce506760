#include "amble/neat/reproduction.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <map>
#include <numeric>
#include <set>

#include "tests/neat/samples.hpp"

namespace amble::neat {
namespace {

/// A generation made by hand; genome i has the one link 0 → 2 of weight i / 1000, so that copies can be told.
struct Sample {
  std::vector<Genome> genomes;
  std::vector<Fitness> fitness;
  std::vector<Species> species;

  /// Adds a species; its members' fitness is given from the best objective to the worst.
  void add(const std::vector<Fitness>& members, int generations_without_improvement = 0) {
    Species& added = species.emplace_back();
    added.generations_without_improvement = generations_without_improvement;
    for (const Fitness& f : members) {
      added.members.push_back(static_cast<int>(genomes.size()));
      const double weight = static_cast<double>(genomes.size()) / 1000.0;
      genomes.push_back(sample_genome(1, 1, {}, {{0, 0, 2, weight, true}}));
      fitness.push_back(f);
    }
  }
  Generation generation() const { return {genomes, fitness, species}; }
  std::vector<Genome> breed(const Settings& settings, std::uint32_t number = 1) const {
    Innovations innovations(1, 1);
    innovations.link(0, 2);
    return reproduce(generation(), settings, true, innovations, 7, number);
  }
};

/// Children of two parents only, never changed: each is a mixture of its parents' links.
Settings only_crossover() {
  Settings settings;
  settings.reproduction.asexual_probability = 0.0;
  settings.reproduction.interspecies_probability = 0.0;
  return settings;
}

int parent_of(const Genome& child) {
  return static_cast<int>(std::lround(child.links[0].weight * 1000));
}

TEST(Places, FollowTheMeanSelectionOfASpecies) {
  Sample sample;
  sample.add({{4, 9}, {2, 8}});          // mean 3
  sample.add({{1, 7}, {1, 6}, {1, 5}});  // mean 1
  sample.add({{0, 4}, {8, 3}, {4, 2}});  // mean 4
  EXPECT_EQ(places_per_species(sample.generation(), {}), (std::vector<int>{3, 1, 4}));
}

TEST(Places, ArePunishedAfterTooManyGenerationsWithoutImprovement) {
  ReproductionSettings settings;
  settings.stagnation_generations = 15;
  Sample sample;
  sample.add(std::vector<Fitness>(50, {1, 9}), 15);  // not stagnant yet
  sample.add(std::vector<Fitness>(50, {1, 8}), 16);
  // Shares 1 and 0.01 of 100 places.
  EXPECT_EQ(places_per_species(sample.generation(), settings), (std::vector<int>{99, 1}));
  settings.stagnation_factor = 0.0;
  EXPECT_EQ(places_per_species(sample.generation(), settings), (std::vector<int>{100, 0}));
}

TEST(Places, KeepTheSpeciesOfTheBestObjectiveWhereALonePlaceIsAnElites) {
  Sample sample;
  sample.add({{5, 1}, {5, 1}, {5, 1}, {5, 1}});
  sample.add({{0, 2}, {0, 1}});  // worth nothing to the search, but it holds the best objective
  ReproductionSettings settings;
  EXPECT_EQ(places_per_species(sample.generation(), settings), (std::vector<int>{6, 0}));
  settings.lone_place = LonePlace::elite;
  EXPECT_EQ(places_per_species(sample.generation(), settings), (std::vector<int>{5, 1}));
}

TEST(Places, SurviveExtremeSelection) {
  Sample sample;
  const double huge = std::numeric_limits<double>::max();
  sample.add({{huge, 1}, {huge, 1}});
  sample.add({{huge, 1}, {huge, 1}});
  EXPECT_EQ(places_per_species(sample.generation(), {}), (std::vector<int>{2, 2}));
  Sample zero;
  zero.add({{0, 1}, {0, 1}, {0, 1}});
  zero.add({{0, 1}});
  EXPECT_EQ(places_per_species(zero.generation(), {}), (std::vector<int>{2, 2}));
}

TEST(Reproduction, CopiesATenthOfTheNextGenerationUnchanged) {
  Sample sample;
  std::vector<Fitness> members;
  for (int i = 0; i < 50; ++i) members.push_back({.selection = 1.0, .objective = 50.0 - i});
  sample.add(members);
  Settings settings;
  settings.reproduction.asexual_probability = 1.0;
  const auto children = sample.breed(settings);
  ASSERT_EQ(children.size(), 50u);
  for (std::size_t i = 0; i < 5; ++i) EXPECT_EQ(children[i], sample.genomes[i]);
  EXPECT_NE(children[5], sample.genomes[5]) << "mutated";
}

TEST(Reproduction, CopiesAsManyElitesAsTheShareSaysWhereBinaryNumbersFallShort) {
  Sample sample;
  std::vector<Fitness> members(100, {.selection = 1.0, .objective = 0.0});
  for (std::size_t i = 0; i < 100; ++i) members[i].objective = 100.0 - static_cast<double>(i);
  sample.add(members);
  Settings settings;
  settings.mutation.weights.jiggle_many_probability = settings.mutation.weights.jiggle_few_probability = 1.0;
  settings.reproduction.asexual_probability = 1.0;
  ASSERT_LT(0.29 * 100.0, 29.0);
  settings.reproduction.elitism = 0.29;
  const auto children = sample.breed(settings);
  for (std::size_t i = 0; i < 29; ++i) EXPECT_EQ(children[i], sample.genomes[i]) << i;
  EXPECT_NE(children[29], sample.genomes[29]);
  settings.reproduction.elitism = 0.299;
  EXPECT_NE(sample.breed(settings)[29], sample.genomes[29]) << "rounded down";
}

TEST(Reproduction, CopiesTheBestOfASmallSpecies) {
  Sample sample;
  sample.add({{1, 9}, {1, 8}, {1, 7}});
  sample.add({{1, 3}, {1, 2}});
  const auto children = sample.breed({});
  EXPECT_EQ(children[0], sample.genomes[0]);
  EXPECT_EQ(children[3], sample.genomes[3]);
}

TEST(Reproduction, GivesALonePlaceToTheEliteOrToAMutatedChild) {
  // 9 : 1 of ten places. The second species holds the best objective.
  Sample sample;
  sample.add({{9, 1}, {9, 1}, {9, 1}, {9, 1}, {9, 1}});
  sample.add({{1, 8}, {1, 7}, {1, 6}, {1, 5}, {1, 4}});
  Settings settings = only_crossover();
  settings.reproduction.lone_place = LonePlace::elite;
  ASSERT_EQ(places_per_species(sample.generation(), settings.reproduction), (std::vector<int>{9, 1}));
  EXPECT_EQ(sample.breed(settings)[9], sample.genomes[5]);

  settings.reproduction.lone_place = LonePlace::child;
  settings.mutation.weights.jiggle_limit = 1e-5;  // so that a child still shows its parent
  settings.mutation.weights.reset_few_share = settings.mutation.weights.reset_one_share = 0;
  settings.mutation.add_link_share = settings.mutation.add_node_share = 0;
  std::map<int, int> children_of;
  for (std::uint32_t number = 1; number <= 400; ++number) {
    const auto children = sample.breed(settings, number);
    ASSERT_EQ(children.size(), 10u);
    EXPECT_EQ(children[0], sample.genomes[0]) << "with more places than one there is an elite";
    EXPECT_EQ(std::ranges::find(sample.genomes, children[9]), sample.genomes.end()) << "mutated, not crossed";
    ++children_of[parent_of(children[9])];
  }
  ASSERT_EQ(children_of.size(), 4u) << "any of the four survivors";
  for (const auto& [member, count] : children_of) EXPECT_NEAR(count, 100, 5 * std::sqrt(75.0)) << member;
  EXPECT_EQ(children_of.begin()->first, 5);
}

TEST(Reproduction, CopiesNoMoreElitesThanThereAreMembers) {
  Sample sample;
  sample.add({{100, 9}});
  sample.add(std::vector<Fitness>(99, {0, 1}));
  Settings settings = only_crossover();
  settings.reproduction.elitism = 1.0;
  settings.reproduction.asexual_probability = 1.0;
  const auto children = sample.breed(settings);
  ASSERT_EQ(children.size(), 100u);
  EXPECT_EQ(children[0], sample.genomes[0]);
  EXPECT_NE(children[1], sample.genomes[0]);
}

/// How often each member of one species, in the order of its objective, gives its gene to a child.
std::map<int, int> genes_given(int members) {
  Sample sample;
  std::vector<Fitness> fitness;
  for (int i = 0; i < members; ++i)
    fitness.push_back({.selection = 1.0, .objective = static_cast<double>(members - i)});
  sample.add(fitness);
  std::map<int, int> given;
  for (std::uint32_t number = 1; number <= 500; ++number)
    for (const Genome& child : sample.breed(only_crossover(), number)) ++given[parent_of(child)];
  return given;
}

TEST(Reproduction, LetsOnlySurvivorsBeParents) {
  const auto of_ten = genes_given(10), of_two = genes_given(2), of_three = genes_given(3),
             of_four = genes_given(4), of_six = genes_given(6);
  ASSERT_EQ(of_ten.size(), 8u) << "80 % of ten survive, whatever the others' selection";
  for (const auto& [member, count] : of_ten) EXPECT_GT(count, 300) << member;
  EXPECT_FALSE(of_ten.contains(8) || of_ten.contains(9));
  EXPECT_EQ(of_three.size(), 2u) << "2.4 are two";
  EXPECT_EQ(of_four.size(), 3u) << "3.2 are three";
  EXPECT_EQ(of_two.size(), 2u) << "1.6 are two";
  EXPECT_EQ(of_six.size(), 5u) << "4.8 are five";
}

TEST(Reproduction, LetsAtLeastOneSurvive) {
  Settings settings = only_crossover();
  settings.reproduction.survival = 0.0;
  Sample sample;
  sample.add({{1, 2}, {1, 1}});
  const auto children = sample.breed(settings);
  EXPECT_EQ(children[0], sample.genomes[0]);
  EXPECT_NE(children[1], sample.genomes[0]) << "bred from the best alone, and so mutated";
}

TEST(Reproduction, DrawsParentsByTheirSelection) {
  Sample sample;
  sample.add({{3, 9}, {1, 8}, {0, 7}, {1, 6}});
  Settings settings;
  settings.reproduction.survival = 1.0;
  settings.reproduction.asexual_probability = 1.0;
  settings.mutation.weights.jiggle_limit = 1e-5;  // so that a child still shows its parent
  settings.mutation.weights.reset_few_share = settings.mutation.weights.reset_one_share = 0;
  settings.mutation.add_link_share = settings.mutation.add_node_share = 0;
  std::map<int, int> children_of;
  const int rounds = 5000;
  for (std::uint32_t number = 1; number <= rounds; ++number) {
    const auto children = sample.breed(settings, number);
    for (std::size_t i = 1; i < 4; ++i) ++children_of[parent_of(children[i])];
  }
  const double bred = 3.0 * rounds;
  EXPECT_NEAR(children_of[0], bred * 0.6, 5 * std::sqrt(bred * 0.24));
  EXPECT_NEAR(children_of[1], bred * 0.2, 5 * std::sqrt(bred * 0.16));
  EXPECT_EQ(children_of[2], 0);
  EXPECT_NEAR(children_of[3], bred * 0.2, 5 * std::sqrt(bred * 0.16));
}

/// Two parents that can be told by structure: the second has one more link.
Sample two_structures(double first_selection, double second_selection) {
  Sample sample;
  sample.add({{first_selection, 2}, {second_selection, 1}});
  sample.genomes[1].links.push_back({1, 1, 2, 0.5, true});
  return sample;
}

double share_with_two_links(const Sample& sample) {
  Settings settings = only_crossover();
  settings.crossover.weaker_genes_probability = 0.0;
  settings.reproduction.survival = 1.0;
  int two = 0;
  const int rounds = 4000;
  for (std::uint32_t number = 1; number <= rounds; ++number) {
    Innovations innovations(1, 1);
    innovations.link(0, 2);
    innovations.link(1, 2);
    two += reproduce(sample.generation(), settings, true, innovations, 7, number)[1].links.size() == 2;
  }
  return static_cast<double>(two) / rounds;
}

TEST(Reproduction, CallsTheParentWithTheLargerSelectionTheFitter) {
  EXPECT_EQ(share_with_two_links(two_structures(1, 2)), 1.0) << "although its objective is smaller";
  EXPECT_EQ(share_with_two_links(two_structures(2, 1)), 0.0);
  EXPECT_NEAR(share_with_two_links(two_structures(1, 1)), 0.5, 0.04) << "a coin decides";
  EXPECT_NEAR(share_with_two_links(two_structures(0, 0)), 0.5, 0.04);
}

TEST(Reproduction, GivesTheChildTheFunctionsOfTheParentDrawnFirst) {
  // Two parents of one structure whose hidden node differs in function. The first parent is drawn by
  // selection, and so nearly always the fitter; but of two equal ones each comes first in half of the cases.
  for (const double first_selection : {1.0, 99.0}) {
    Sample sample;
    sample.add({{first_selection, 2}, {1, 1}});
    for (std::size_t i = 0; i < 2; ++i)
      sample.genomes[i] =
          sample_genome(1, 1, {{3, NodeKind::hidden, i == 0 ? Activation::sine : Activation::gaussian}},
                        {{0, 0, 2, 0.1, true}, {1, 0, 3, 1.0, true}, {2, 3, 2, 0.3, true}});
    Settings settings = only_crossover();
    settings.reproduction.survival = 1.0;
    int sines = 0;
    const int rounds = 2000;
    for (std::uint32_t number = 1; number <= rounds; ++number)
      sines += sample.breed(settings, number)[1].nodes.back().activation == Activation::sine;
    const double share = first_selection / (first_selection + 1.0);
    EXPECT_NEAR(sines, rounds * share, 5 * std::sqrt(rounds * share * (1.0 - share)) + 1);
    EXPECT_LT(sines, rounds) << "not always the fitter's";
  }
}

TEST(Reproduction, MatesBetweenSpeciesWithTheGivenProbability) {
  Sample sample;
  sample.add(std::vector<Fitness>(10, {1, 2}));
  sample.add(std::vector<Fitness>(10, {1, 1}));
  Settings settings = only_crossover();
  settings.reproduction.interspecies_probability = 0.2;
  int foreign = 0, bred = 0;
  for (std::uint32_t number = 1; number <= 2000; ++number) {
    const auto children = sample.breed(settings, number);
    for (std::size_t i = 0; i < children.size(); ++i) {
      if (i == 0 || i == 10) continue;  // elites
      ++bred;
      foreign += (parent_of(children[i]) < 10) != (i < 10);
    }
  }
  // The one gene is the foreign parent's in half of the cases.
  EXPECT_NEAR(foreign, 0.1 * bred, 5 * std::sqrt(0.09 * bred));
}

TEST(Reproduction, MutatesWhereThereIsNoSecondParent) {
  Sample sample;
  sample.add({{9, 9}});
  sample.add({{0, 1}, {0, 1}, {0, 1}});
  const auto children = sample.breed(only_crossover());
  ASSERT_EQ(children.size(), 4u);
  EXPECT_EQ(children[0], sample.genomes[0]);
  for (std::size_t i = 1; i < 4; ++i) EXPECT_NE(children[i], sample.genomes[0]);
}

TEST(Reproduction, MutatesChildrenOfTwoParentsOnlyIfSet) {
  Sample sample;
  sample.add(std::vector<Fitness>(20, {1, 1}));
  const auto is_a_copy = [&](const Genome& child) {
    return std::ranges::find(sample.genomes, child) != sample.genomes.end();
  };
  Settings settings = only_crossover();
  EXPECT_EQ(std::ranges::count_if(sample.breed(settings), is_a_copy), 20);
  settings.crossover.mutate_child = true;
  EXPECT_EQ(std::ranges::count_if(sample.breed(settings), is_a_copy), 2) << "the two elites";
}

TEST(Reproduction, GivesEachChildItsOwnRandomNumbers) {
  // Two generations that differ in one species' genomes alone: the other's children are the same.
  Sample one;
  one.add(std::vector<Fitness>(10, {1, 1}));
  one.add(std::vector<Fitness>(10, {1, 2}));
  Sample two = one;
  for (std::size_t i = 0; i < 10; ++i) two.genomes[i].links.clear();
  Settings settings;
  settings.reproduction.interspecies_probability = 0.0;
  settings.mutation.add_node_share = 0.0;
  const auto first = one.breed(settings), second = two.breed(settings);
  for (std::size_t i = 10; i < 20; ++i) {
    ASSERT_EQ(first[i].links.size(), second[i].links.size()) << i;
    for (std::size_t g = 0; g < first[i].links.size(); ++g)
      EXPECT_EQ(first[i].links[g].weight, second[i].links[g].weight);
  }
}

TEST(Reproduction, GivesNoTwoChildrenOfAGenerationTheSameRandomNumbers) {
  // Three species alike in everything: nothing but the random numbers tells their children apart.
  Sample sample;
  for (int species = 0; species < 3; ++species) sample.add(std::vector<Fitness>(10, {1, 1}));
  for (Genome& genome : sample.genomes) genome = sample.genomes[0];
  Settings settings;
  settings.reproduction.asexual_probability = 1.0;
  settings.mutation.add_link_share = settings.mutation.add_node_share = 0.0;
  auto& weights = settings.mutation.weights;  // each weight is changed, and by a number from a continuum
  weights.jiggle_many_probability = weights.jiggle_few_probability = weights.reset_few_probability = 1.0;
  const auto children = sample.breed(settings);
  ASSERT_EQ(children.size(), 30u);
  std::set<double> seen;
  for (std::size_t i = 0; i < children.size(); ++i) {
    if (i % 10 == 0) continue;  // elites
    EXPECT_TRUE(seen.insert(children[i].links[0].weight).second) << i;
  }
}

}  // namespace
}  // namespace amble::neat
