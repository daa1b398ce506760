#include "amble/neat/population.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <map>
#include <ostream>

#include "amble/core/hash.hpp"
#include "tests/neat/samples.hpp"

namespace amble::neat {
namespace population_test {

Settings small_settings(int size = 60) {
  Settings settings = lively_settings();
  settings.population.size = size;
  settings.speciation.target_min = 5;
  settings.speciation.target_max = 7;
  return settings;
}

double best(const std::vector<Fitness>& fitness) {
  return std::ranges::max(fitness, {}, &Fitness::objective).objective;
}

TEST(Population, StartsWithRandomMinimalGenomes) {
  const Population population({}, 3, 2, true, 1);
  EXPECT_EQ(population.generation(), 0);
  ASSERT_EQ(population.genomes().size(), 300u);
  for (const Genome& genome : population.genomes()) {
    EXPECT_NO_THROW(validate(genome, 3, 2, true));
    EXPECT_EQ(genome.links.size(), 8u);
  }
  EXPECT_NE(population.genomes()[0], population.genomes()[1]);
  const PopulationStatistics statistics = population.statistics();
  EXPECT_EQ(statistics.species, 1) << "a threshold of 100 divides nothing yet";
  EXPECT_EQ(statistics.compatibility_threshold, 99.0);
  EXPECT_EQ(statistics.mean_hidden, 0.0);
  EXPECT_EQ(statistics.mean_links, 8.0);
}

TEST(Population, DependsOnTheSeedAlone) {
  const Population one({}, 3, 2, true, 1), same({}, 3, 2, true, 1), other({}, 3, 2, true, 2);
  EXPECT_TRUE(std::ranges::equal(one.genomes(), same.genomes()));
  EXPECT_FALSE(std::ranges::equal(one.genomes(), other.genomes()));
}

class Generations : public testing::TestWithParam<bool> {};

TEST_P(Generations, KeepEveryInvariant) {
  const bool recurrent = GetParam();
  Settings settings = small_settings();
  settings.reproduction.interspecies_probability = 0.1;
  settings.crossover.mutate_child = true;
  settings.innovations.key = InnovationKey::link_and_function;
  Population population(settings, 2, 2, recurrent, 3);
  Stream stream(131, Purpose::test);
  std::map<std::uint32_t, Activation> activation_of;
  for (int generation = 0; generation < 60; ++generation) {
    ASSERT_EQ(population.generation(), generation);
    ASSERT_EQ(population.genomes().size(), 60u);
    for (const Genome& genome : population.genomes()) {
      ASSERT_EQ(error_of([&] { validate(genome, 2, 2, recurrent); }), "");
      ASSERT_TRUE(all_hidden_nodes_are_linked(genome));
      for (const NodeGene& node : genome.nodes)
        ASSERT_EQ(activation_of.try_emplace(node.id, node.activation).first->second, node.activation)
            << "one id, one function";
    }
    int members = 0;
    for (const SpeciesStatistics& species : population.species()) members += species.size;
    ASSERT_EQ(members, 60);
    ASSERT_EQ(static_cast<int>(population.species().size()), population.statistics().species);

    // Extreme selection in turn: all equal, all zero, one huge, random.
    std::vector<Fitness> fitness(60);
    for (Fitness& f : fitness) f.objective = stream.uniform(-1, 1);
    if (generation % 4 == 0)
      for (Fitness& f : fitness) f.selection = 0.3;
    if (generation % 4 == 2) fitness[stream.below(60)].selection = 1e308;
    if (generation % 4 == 3)
      for (Fitness& f : fitness) f.selection = stream.uniform();
    population.advance(fitness);
  }
  EXPECT_GT(activation_of.size(), 50u) << "the sample holds many hidden nodes";
}

INSTANTIATE_TEST_SUITE_P(FeedForwardAndRecurrent, Generations, testing::Bool());

TEST(Population, NeverLosesTheBestObjectiveWithLonePlacesForElitesEvenIfSelectionDisagrees) {
  Settings settings = small_settings();
  settings.reproduction.lone_place = LonePlace::elite;
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    Population population(settings, 2, 1, true, seed);
    double best_so_far = 0.0;
    for (int generation = 0; generation < 60; ++generation) {
      auto fitness = evaluate(population, weights_near_one_half);
      // Selection prefers what the objective does not, and sometimes gives the best's species nothing at all.
      const double largest = best(fitness);
      for (Fitness& f : fitness) f.selection = largest - f.objective;
      ASSERT_GE(largest, best_so_far) << "generation " << generation;
      best_so_far = largest;
      population.advance(fitness);
    }
  }
}

TEST(Population, MayLoseTheBestObjectiveWithLonePlacesForChildren) {
  Population population(small_settings(), 2, 1, true, 1);
  double best_so_far = 0.0;
  int lost = 0;
  for (int generation = 0; generation < 60; ++generation) {
    auto fitness = evaluate(population, weights_near_one_half);
    const double largest = best(fitness);
    for (Fitness& f : fitness) f.selection = largest - f.objective;
    lost += largest < best_so_far;
    best_so_far = largest;
    population.advance(fitness);
    ASSERT_EQ(population.genomes().size(), 60u);
  }
  EXPECT_GT(lost, 0);
}

TEST(Population, ComesToItsTargetOfSpecies) {
  Settings settings;
  settings.speciation.corrections_per_generation = 5;
  Population population(settings, 3, 2, true, 4);
  int on_target = 0;
  for (int generation = 0; generation < 60; ++generation) {
    population.advance(evaluate(population, weights_near_one_half));
    const int species = population.statistics().species;
    if (generation >= 20) on_target += species >= 28 && species <= 30;
  }
  EXPECT_GE(on_target, 32) << "of the last forty generations";
}

TEST(Population, GivesTheSameGenomesForEver) {
  // A change of this number is a change of every run: it needs a reason and an entry in the changelog.
  Settings settings = small_settings();
  settings.crossover.mutate_child = true;
  std::uint64_t hash = 0;
  for (const bool recurrent : {true, false}) {
    Population population(settings, 2, 2, recurrent, 2013);
    for (int generation = 0; generation < 20; ++generation) {
      population.advance(evaluate(population, weights_near_one_half));
      for (const Genome& genome : population.genomes()) {
        const std::uint64_t pair[]{hash, genome.hash()};
        hash = hash_span(std::span<const std::uint64_t>(pair));
      }
    }
  }
  EXPECT_EQ(hex(hash), "7cf68a7678e709f1");
}

/// What happened to the species of a population on its way.
struct SpeciesHistory {
  int most = 0, stagnant = 0, extinct = 0;
  std::map<std::uint32_t, int> size;

  void see(const Population& population, int stagnation_generations) {
    std::map<std::uint32_t, int> now;
    for (const SpeciesStatistics& species : population.species()) {
      now[species.id] = species.size;
      stagnant += species.generations_without_improvement > stagnation_generations &&
                  species.age > species.generations_without_improvement;
    }
    for (const auto& [id, members] : size) extinct += !now.contains(id);
    most = std::max(most, static_cast<int>(now.size()));
    size = now;
  }
};

std::uint64_t hash_of(const Population& population, std::uint64_t hash) {
  const double threshold = population.statistics().compatibility_threshold;
  hash = hash_span(std::span(&threshold, 1), hash);
  for (const SpeciesStatistics& species : population.species()) {
    const std::array<int, 4> numbers{static_cast<int>(species.id), species.size, species.age,
                                     species.generations_without_improvement};
    hash = hash_span<int>(numbers, hash);
  }
  for (const Genome& genome : population.genomes()) {
    const std::uint64_t own = genome.hash();
    hash = hash_span(std::span(&own, 1), hash);
  }
  return hash;
}

struct GoldenSpecies {
  LonePlace lone_place;
  const char* hash;
};

void PrintTo(const GoldenSpecies& golden, std::ostream* out) {
  *out << lone_place_names[static_cast<std::size_t>(golden.lone_place)];
}

class PopulationOfManySpecies : public testing::TestWithParam<GoldenSpecies> {};

TEST_P(PopulationOfManySpecies, GivesTheSameGenomesForEver) {
  // As above, a change of these numbers is a change of every run. Here species are many, some stagnate, some
  // die out, and selection is not the objective.
  Settings settings = small_settings(90);
  settings.speciation.initial_threshold = 4;
  settings.speciation.target_min = 8;
  settings.speciation.target_max = 12;
  settings.reproduction.lone_place = GetParam().lone_place;
  settings.reproduction.stagnation_generations = 4;
  settings.reproduction.interspecies_probability = 0.1;
  settings.reproduction.elitism = 0.29;
  std::uint64_t hash = 0;
  for (const bool recurrent : {true, false}) {
    SpeciesHistory history;
    Population population(settings, 2, 2, recurrent, 2013);
    for (int generation = 0; generation < 40; ++generation) {
      auto fitness = evaluate(population, weights_in_steps);
      for (std::size_t i = 0; i < fitness.size(); ++i)
        fitness[i].selection = 1.0 / (1.0 + static_cast<double>(population.genomes()[i].links.size() % 5));
      population.advance(fitness);
      history.see(population, settings.reproduction.stagnation_generations);
      hash = hash_of(population, hash);
    }
    EXPECT_GE(history.most, 8);
    EXPECT_GE(history.stagnant, 20) << "species × generations";
    EXPECT_GE(history.extinct, 5);
  }
  EXPECT_EQ(hex(hash), GetParam().hash);
}

INSTANTIATE_TEST_SUITE_P(LonePlaces, PopulationOfManySpecies,
                         testing::Values(GoldenSpecies{LonePlace::child, "3d8124e20e869841"},
                                         GoldenSpecies{LonePlace::elite, "094722561cc5325c"}),
                         [](const auto& golden) {
                           return golden.param.lone_place == LonePlace::child ? "ForChildren" : "ForElites";
                         });

TEST(PopulationDeathTest, AbortsOnFitnessThatIsNoNumber) {
  Population population(small_settings(), 2, 1, true, 1);
  std::vector<Fitness> fitness(60);
  for (const std::size_t i : {0u, 7u, 59u}) {
    fitness[i].objective = std::numeric_limits<double>::quiet_NaN();
    EXPECT_DEATH(population.advance(fitness), "fitness is finite");
    fitness[i] = {.selection = -1.0, .objective = 0.0};
    EXPECT_DEATH(population.advance(fitness), "selection not negative");
    fitness[i] = {};
  }
  EXPECT_DEATH(population.advance(std::span(fitness).first(59)), "one fitness per genome");
}

}  // namespace population_test
}  // namespace amble::neat
