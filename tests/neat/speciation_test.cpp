#include "amble/neat/speciation.hpp"

#include <gtest/gtest.h>

#include <ostream>
#include <set>

#include "amble/neat/genome_io.hpp"
#include "tests/neat/samples.hpp"

namespace amble::neat {
namespace {

/// One link of the given weight: two such genomes are 3 × |difference| apart.
Genome with_weight(double weight) {
  return sample_genome(1, 1, {}, {{0, 0, 2, weight, true}});
}

std::vector<Genome> with_weights(const std::vector<double>& weights) {
  std::vector<Genome> genomes;
  for (const double weight : weights) genomes.push_back(with_weight(weight));
  return genomes;
}

std::vector<Fitness> with_objectives(const std::vector<double>& objectives) {
  std::vector<Fitness> fitness;
  for (const double objective : objectives) fitness.push_back({.selection = 1.0, .objective = objective});
  return fitness;
}

SpeciationSettings unsteered(double threshold) {
  SpeciationSettings settings;
  settings.initial_threshold = threshold;
  settings.corrections_per_generation = 0;
  return settings;
}

std::vector<std::vector<int>> members(const Speciation& speciation) {
  std::vector<std::vector<int>> result;
  for (const Species& species : speciation.species()) result.push_back(species.members);
  return result;
}

using Groups = std::vector<std::vector<int>>;

TEST(Speciation, PutsIdenticalGenomesIntoOneSpecies) {
  Speciation speciation(unsteered(Threshold::lowest));
  speciation.assign(with_weights({0.5, 0.5, 0.5}));
  EXPECT_EQ(members(speciation), (Groups{{0, 1, 2}}));
}

TEST(Speciation, TakesTheFirstSpeciesThatIsCloserThanTheThreshold) {
  Speciation speciation(unsteered(1.5));
  // Founders 0.0 and 1.0; 0.4 is close to the first, 0.6 only to the second, and 0.5 lies at the threshold of
  // both: it is not closer than that, and founds a third.
  speciation.assign(with_weights({0.0, 1.0, 0.4, 0.6, 0.5}));
  EXPECT_EQ(members(speciation), (Groups{{0, 2}, {1, 3}, {4}}));
  Speciation wide(unsteered(2.0));
  // 0.5 is close to both now: the older species has it.
  wide.assign(with_weights({0.0, 1.0, 0.5}));
  EXPECT_EQ(members(wide), (Groups{{0, 2}, {1}}));
}

TEST(Speciation, ComparesWithTheBestOfTheLastGeneration) {
  Speciation speciation(unsteered(1.5));
  const auto genomes = with_weights({0.0, 0.4});
  speciation.assign(genomes);
  ASSERT_EQ(members(speciation), (Groups{{0, 1}}));
  speciation.record(genomes, with_objectives({1.0, 2.0}));
  EXPECT_EQ(speciation.species()[0].representative, genomes[1]);
  EXPECT_EQ(speciation.species()[0].members, (std::vector<int>{1, 0}));
  // 0.8 is within 0.5 of 0.4, but not of the founder 0.0.
  speciation.assign(with_weights({0.8, -0.2}));
  EXPECT_EQ(members(speciation), (Groups{{0}, {1}}));
  EXPECT_EQ(speciation.species()[0].id, 0u);
  EXPECT_EQ(speciation.species()[0].age, 1);
  EXPECT_EQ(speciation.species()[1].id, 1u);
  EXPECT_EQ(speciation.species()[1].age, 0);
}

TEST(Speciation, ForgetsSpeciesWithoutMembersAndTheirNumbers) {
  Speciation speciation(unsteered(1.5));
  speciation.assign(with_weights({0.0, 1.0}));
  speciation.assign(with_weights({1.0, 1.0}));
  ASSERT_EQ(members(speciation), (Groups{{0, 1}}));
  EXPECT_EQ(speciation.species()[0].id, 1u);
  speciation.assign(with_weights({1.0, 0.0}));
  EXPECT_EQ(speciation.species()[1].id, 2u) << "number 0 is not given again";
}

TEST(Speciation, CountsGenerationsWithoutABetterObjective) {
  Speciation speciation(unsteered(100));
  const auto genomes = with_weights({0.0, 0.1});
  const auto stagnation_after = [&](const std::vector<double>& objectives) {
    speciation.assign(genomes);
    speciation.record(genomes, with_objectives(objectives));
    return speciation.species()[0].generations_without_improvement;
  };
  EXPECT_EQ(stagnation_after({-2.0, -1.0}), 0);
  EXPECT_EQ(stagnation_after({-1.0, -3.0}), 1) << "an equal objective is no improvement";
  EXPECT_EQ(stagnation_after({-5.0, -3.0}), 2);
  EXPECT_EQ(speciation.species()[0].best_objective, -1.0) << "the best of its life";
  EXPECT_EQ(stagnation_after({-0.5, -3.0}), 0);
  EXPECT_EQ(speciation.species()[0].age, 3);
}

TEST(Speciation, OrdersEqualObjectivesByIndex) {
  Speciation speciation(unsteered(100));
  const auto genomes = with_weights({0.0, 0.1, 0.2, 0.3});
  speciation.assign(genomes);
  speciation.record(genomes, with_objectives({1.0, 2.0, 1.0, 2.0}));
  EXPECT_EQ(speciation.species()[0].members, (std::vector<int>{1, 3, 0, 2}));
}

TEST(Speciation, SortsAnewAfterEachCorrectionOfTheThreshold) {
  SpeciationSettings settings = unsteered(3.15);
  settings.target_min = 2;
  settings.target_max = 2;
  const auto genomes = with_weights({0.0, 1.03});  // 3.09 apart
  Speciation still(settings);
  still.assign(genomes);
  EXPECT_EQ(still.species().size(), 1u);
  settings.corrections_per_generation = 1;  // one step of 0.1: 3.05
  Speciation steered(settings);
  steered.assign(genomes);
  EXPECT_EQ(steered.species().size(), 2u);
  EXPECT_DOUBLE_EQ(steered.threshold(), 3.05);
}

struct Start {
  double threshold;
  int corrections;
  friend std::ostream& operator<<(std::ostream& out, const Start& start) {
    return out << "threshold " << start.threshold << ", corrections " << start.corrections;
  }
};

class Steering : public testing::TestWithParam<Start> {};

/// Numbers of species, generation by generation, of a synthetic population of 300 whose weights drift while
/// its structure and its order of objectives stay.
std::vector<int> species_while_weights_drift(const SpeciationSettings& settings, int generations) {
  Stream stream(121, Purpose::test);
  Innovations innovations(3, 2, {InnovationScope::run, InnovationKey::link_and_function});
  std::vector<Genome> genomes;
  std::vector<Fitness> fitness(300);
  for (Fitness& f : fitness) {
    genomes.push_back(grown_genome(3, 2, static_cast<int>(stream.below(12)), true, innovations, stream));
    f.objective = stream.uniform();
  }
  Speciation speciation(settings);
  std::vector<int> species;
  for (int generation = 0; generation < generations; ++generation) {
    speciation.assign(genomes);
    species.push_back(static_cast<int>(speciation.species().size()));
    speciation.record(genomes, fitness);
    for (Genome& genome : genomes)
      for (LinkGene& link : genome.links)
        if (stream.chance(0.02)) link.weight += stream.uniform(-0.05, 0.05);
  }
  return species;
}

TEST_P(Steering, ReachesTheTargetAndStaysThereBySmallFirstSteps) {
  SpeciationSettings settings;
  settings.first_step_up = 0.01;
  settings.initial_threshold = GetParam().threshold;
  settings.corrections_per_generation = GetParam().corrections;
  const std::vector<int> species = species_while_weights_drift(settings, 200);
  int on_target = 0;
  for (std::size_t generation = 100; generation < 200; ++generation) {
    on_target += species[generation] >= settings.target_min && species[generation] <= settings.target_max;
    EXPECT_GE(species[generation], 25);
    EXPECT_LE(species[generation], 33);
  }
  EXPECT_GE(on_target, 90) << "of the last hundred generations";
}

INSTANTIATE_TEST_SUITE_P(FromBothSides, Steering,
                         testing::Values(Start{100.0, 1}, Start{0.5, 1}, Start{100.0, 5}, Start{0.5, 5}),
                         [](const auto& start) {
                           return std::string(start.param.threshold > 1 ? "Above" : "Below") +
                                  std::to_string(start.param.corrections);
                         });

TEST(Speciation, MergesSpeciesAgainAndAgainByTheAuthorsFirstStepUp) {
  for (const double threshold : {100.0, 0.5}) {
    SpeciationSettings settings;
    settings.initial_threshold = threshold;
    const std::vector<int> species = species_while_weights_drift(settings, 200);
    int merged = 0;
    for (std::size_t generation = 101; generation < 200; ++generation)
      merged += species[generation - 1] > settings.target_max && species[generation] < settings.target_min;
    EXPECT_GE(merged, 1) << "in the last hundred generations";
  }
}

TEST(Speciation, ReachesTheTargetSoonerWithMoreCorrections) {
  Stream stream(123, Purpose::test);
  Innovations innovations(3, 2);
  std::vector<Genome> genomes;
  for (int i = 0; i < 300; ++i)
    genomes.push_back(grown_genome(3, 2, static_cast<int>(stream.below(12)), true, innovations, stream));
  const auto generations_to_target = [&](int corrections) {
    SpeciationSettings settings;
    settings.corrections_per_generation = corrections;
    Speciation speciation(settings);
    for (int generation = 1; generation < 200; ++generation) {
      speciation.assign(genomes);
      const auto species = static_cast<int>(speciation.species().size());
      if (species >= settings.target_min && species <= settings.target_max) return generation;
    }
    return 200;
  };
  EXPECT_LT(generations_to_target(1), 60);
  EXPECT_EQ(generations_to_target(200), 1);
}

TEST(Speciation, PutsEveryGenomeCloseToItsRepresentative) {
  Stream stream(122, Purpose::test);
  Innovations innovations(3, 2);
  Speciation speciation(SpeciationSettings{});
  for (int generation = 0; generation < 60; ++generation) {
    std::vector<Genome> genomes;
    for (int i = 0; i < 60; ++i)
      genomes.push_back(grown_genome(3, 2, static_cast<int>(stream.below(12)), true, innovations, stream));
    speciation.assign(genomes);
    std::set<int> placed;
    for (std::size_t s = 0; s < speciation.species().size(); ++s)
      for (const int member : speciation.species()[s].members) {
        EXPECT_TRUE(placed.insert(member).second);
        const Genome& genome = genomes[static_cast<std::size_t>(member)];
        for (std::size_t earlier = 0; earlier <= s; ++earlier) {
          const double distance = compatibility_distance(speciation.species()[earlier].representative, genome,
                                                         DistanceSettings{});
          if (earlier < s) {
            ASSERT_GE(distance, speciation.threshold());
          } else {
            ASSERT_LT(distance, speciation.threshold());
          }
        }
      }
    EXPECT_EQ(placed.size(), genomes.size());
  }
}

TEST(Speciation, ComesBackFieldByFieldAfterSaveAndLoad) {
  // Species 0 dies out; 1 improves once and then stagnates, so it is older than it is stagnant; 2 is new; the
  // threshold is on its way, so that its next step depends on the last one.
  SpeciationSettings settings = unsteered(1.5);
  settings.corrections_per_generation = 1;
  settings.target_min = settings.target_max = 3;
  Speciation speciation(settings);
  std::vector<Genome> genomes = with_weights({-2.0, 0.0, 0.1});
  const auto live = [&](const std::vector<double>& objectives) {
    speciation.assign(genomes);
    speciation.record(genomes, with_objectives(objectives));
  };
  live({1.0, 2.0, 3.0});
  genomes = with_weights({0.0, 0.1, 0.2});
  live({1.0, 4.0, 2.0});
  for (int generation = 0; generation < 3; ++generation) live({3.0, 2.0, 1.0});
  genomes = with_weights({0.1, 3.0, 0.0});
  live({-1.0, 7.0, 0.0});
  const std::vector<Species> before = speciation.species();
  ASSERT_EQ(before.size(), 2u);
  ASSERT_EQ(before[0].age, 5);
  ASSERT_EQ(before[0].generations_without_improvement, 4);
  ASSERT_EQ(before[0].best_objective, 4.0);
  ASSERT_EQ(before[1].age, 0);
  ASSERT_EQ(before[1].best_objective, 7.0);
  const double threshold = speciation.threshold();
  ASSERT_NE(threshold, settings.initial_threshold);

  io::BinaryWriter writer;
  speciation.save(writer);
  Speciation loaded(settings);
  const std::string bytes = writer.bytes();
  io::BinaryReader reader(bytes, "checkpoint");
  loaded.load(reader, genomes.size());
  reader.finish();

  EXPECT_EQ(loaded.threshold(), threshold);
  ASSERT_EQ(loaded.species().size(), before.size());
  for (std::size_t i = 0; i < before.size(); ++i) {
    const Species& species = loaded.species()[i];
    EXPECT_EQ(species.id, before[i].id);
    EXPECT_EQ(species.representative, before[i].representative);
    EXPECT_EQ(species.members, before[i].members);
    EXPECT_EQ(species.age, before[i].age);
    EXPECT_EQ(species.generations_without_improvement, before[i].generations_without_improvement);
    EXPECT_EQ(species.best_objective, before[i].best_objective);
  }
  // What cannot be read: the number of the next species, and the threshold's last step.
  genomes = with_weights({0.1, 3.0, -3.0});
  speciation.assign(genomes);
  loaded.assign(genomes);
  EXPECT_EQ(loaded.threshold(), speciation.threshold());
  ASSERT_EQ(loaded.species().size(), 3u);
  EXPECT_EQ(loaded.species()[2].id, before[1].id + 1);
}

/// What a stored species of two genomes has; by default what can be.
struct StoredSpecies {
  std::uint32_t next_id = 1, id = 0;
  std::vector<int> members = {0, 1};
  int age = 0, without_improvement = 0;
  double best = 1.0;
};

std::string refusal_of(const StoredSpecies& stored) {
  io::BinaryWriter writer;
  writer.put(1.0);  // threshold
  writer.put(0.0);  // and its step
  writer.put(stored.next_id);
  writer.put(std::uint64_t{1});
  writer.put(stored.id);
  neat::save(sample_genome(1, 1, {}, {}), writer);
  writer.put_span(std::span<const int>(stored.members));
  writer.put(stored.age);
  writer.put(stored.without_improvement);
  writer.put(stored.best);
  Speciation speciation({});
  io::BinaryReader reader(writer.bytes(), "checkpoint");
  return error_of([&] {
    speciation.load(reader, 2);
    reader.finish();
  });
}

TEST(Speciation, LoadsNoSpeciesThatCannotBe) {
  EXPECT_EQ(refusal_of({}), "");
  EXPECT_EQ(refusal_of({.next_id = 8, .id = 7, .age = 3, .without_improvement = 3, .best = -1e300}), "");
  for (const StoredSpecies& stored : {StoredSpecies{.next_id = 7, .id = 7},
                                      {.members = {}},
                                      {.age = -1},
                                      {.without_improvement = -1},
                                      {.best = std::nan("")}})
    EXPECT_NE(refusal_of(stored).find("a species that cannot be"), std::string::npos);
  for (const std::vector<int>& members : {std::vector{0}, {0, 0}, {0, 2}, {-1, 0}, {0, 1, 1}})
    EXPECT_NE(refusal_of({.members = members}).find("a genome of no species or of two"), std::string::npos);
}

}  // namespace
}  // namespace amble::neat
