#include <gtest/gtest.h>

#include <algorithm>
#include <array>

#include "amble/neat/population.hpp"
#include "tests/neat/samples.hpp"

namespace amble::neat {
namespace {

Settings small_settings(int size = 40) {
  Settings settings = lively_settings();
  settings.population.size = size;
  settings.speciation.target_min = 4;
  settings.speciation.target_max = 6;
  settings.speciation.initial_threshold = 20;
  return settings;
}

std::string bytes_of(const Population& population) {
  io::BinaryWriter writer;
  population.save(writer);
  return writer.bytes();
}

void advance(Population& population, int generations,
             double (*objective)(const Genome&) = weights_near_one_half) {
  for (int i = 0; i < generations; ++i) population.advance(evaluate(population, objective));
}

std::string load(Population& population, std::string_view bytes) {
  return error_of([&] {
    io::BinaryReader reader(bytes, "checkpoint");
    population.load(reader);
    reader.finish();
  });
}

TEST(PopulationLoad, ContinuesToTheBitAsIfNothingHadHappened) {
  for (const int before : {0, 1, 7, 25}) {
    Population uninterrupted(small_settings(), 2, 2, true, 9);
    advance(uninterrupted, before);
    Population resumed(small_settings(), 2, 2, true, 9);
    ASSERT_EQ(load(resumed, bytes_of(uninterrupted)), "");
    ASSERT_EQ(bytes_of(resumed), bytes_of(uninterrupted));
    advance(uninterrupted, 12);
    advance(resumed, 12);
    EXPECT_EQ(resumed.generation(), before + 12);
    EXPECT_TRUE(std::ranges::equal(resumed.genomes(), uninterrupted.genomes()));
    EXPECT_EQ(bytes_of(resumed), bytes_of(uninterrupted));
    EXPECT_EQ(resumed.statistics().species, uninterrupted.statistics().species);
    EXPECT_EQ(resumed.statistics().compatibility_threshold,
              uninterrupted.statistics().compatibility_threshold);
  }
}

TEST(PopulationLoad, ContinuesWithSpeciesThatAreStagnantAndOlderThanTheirStagnation) {
  Settings settings = small_settings();
  settings.speciation.initial_threshold = 4;
  settings.reproduction.stagnation_generations = 2;
  int stagnant = 0, improving = 0;
  for (int generations = 5; generations <= 30; generations += 5) {
    Population uninterrupted(settings, 2, 2, true, 9), resumed(settings, 2, 2, true, 9);
    advance(uninterrupted, generations, weights_in_steps);
    const auto before = uninterrupted.species();
    ASSERT_EQ(load(resumed, bytes_of(uninterrupted)), "");
    const auto after = resumed.species();
    ASSERT_EQ(after.size(), before.size());
    for (std::size_t i = 0; i < before.size(); ++i) {
      EXPECT_EQ(after[i].id, before[i].id);
      EXPECT_EQ(after[i].size, before[i].size);
      EXPECT_EQ(after[i].age, before[i].age);
      EXPECT_EQ(after[i].generations_without_improvement, before[i].generations_without_improvement);
      const bool is_stagnant = before[i].generations_without_improvement > 2;
      stagnant += is_stagnant && before[i].age > before[i].generations_without_improvement;
      improving += !is_stagnant && before[i].age > 2;
    }
    advance(uninterrupted, 8, weights_in_steps);
    advance(resumed, 8, weights_in_steps);
    EXPECT_TRUE(std::ranges::equal(resumed.genomes(), uninterrupted.genomes())) << generations;
  }
  EXPECT_GE(stagnant, 3);
  EXPECT_GE(improving, 5);
}

TEST(PopulationLoad, ContinuesToTheBitWithEveryRuleOfNumbering) {
  for (const auto scope : {InnovationScope::generation, InnovationScope::run})
    for (const auto key : {InnovationKey::link, InnovationKey::link_and_function}) {
      Settings settings = small_settings();
      settings.innovations = {scope, key};
      Population uninterrupted(settings, 2, 2, true, 9), resumed(settings, 2, 2, true, 9);
      advance(uninterrupted, 7);
      ASSERT_EQ(load(resumed, bytes_of(uninterrupted)), "");
      advance(uninterrupted, 5);
      advance(resumed, 5);
      EXPECT_EQ(bytes_of(resumed), bytes_of(uninterrupted));
    }
}

TEST(PopulationLoad, RefusesGenomesWhoseNumbersDisagree) {
  Population source(small_settings(), 2, 2, true, 9);
  advance(source, 10);
  const std::string bytes = bytes_of(source);
  // An old link, forgotten by the list of this generation: its number is kept and its source becomes another.
  const LinkGene& link = source.genomes()[0].links[0];
  std::string altered = bytes;
  const std::array<std::uint32_t, 3> gene{link.innovation, link.from, link.to};
  const std::string_view old(reinterpret_cast<const char*>(gene.data()), sizeof gene);
  const std::size_t at = altered.find(old);
  ASSERT_NE(at, std::string::npos);
  altered[at + 4] = static_cast<char>(link.from == 0 ? 1 : 0);
  Population population(small_settings(), 2, 2, true, 9);
  const std::string refusal = load(population, altered);
  EXPECT_TRUE(refusal.find("joins other nodes in another genome") != std::string::npos ||
              refusal.find("a second time") != std::string::npos)
      << refusal;
}

TEST(PopulationLoad, RefusesTheStateOfAnotherRun) {
  Population population(small_settings(), 2, 2, true, 9);
  const std::string bytes = bytes_of(population);
  const auto refusal = [&](Population other) { return load(other, bytes); };
  EXPECT_NE(refusal(Population(small_settings(), 3, 2, true, 9)).find("other numbers of inputs and outputs"),
            std::string::npos);
  EXPECT_NE(refusal(Population(small_settings(), 2, 1, true, 9)).find("other numbers of inputs and outputs"),
            std::string::npos);
  EXPECT_NE(refusal(Population(small_settings(), 2, 2, false, 9)).find("whether networks are recurrent"),
            std::string::npos);
  EXPECT_NE(refusal(Population(small_settings(), 2, 2, true, 10)).find("another seed"), std::string::npos);
  EXPECT_NE(refusal(Population(small_settings(41), 2, 2, true, 9)).find("another population size"),
            std::string::npos);
  EXPECT_EQ(refusal(Population(small_settings(), 2, 2, true, 9)), "");
}

TEST(PopulationLoad, RefusesEveryTruncationAndKeepsItsState) {
  Population source(small_settings(8), 2, 1, true, 9), population(small_settings(8), 2, 1, true, 9);
  advance(source, 5);
  const std::string bytes = bytes_of(source), before = bytes_of(population);
  for (std::size_t size = 0; size < bytes.size(); ++size)
    ASSERT_NE(load(population, std::string_view(bytes).substr(0, size)).find("checkpoint: "),
              std::string::npos)
        << size;
  EXPECT_EQ(bytes_of(population), before);
}

TEST(PopulationLoad, RefusesAlteredBytesOrGoesOnWithAValidPopulation) {
  Population source(small_settings(12), 2, 1, false, 9);
  advance(source, 8);
  const std::string bytes = bytes_of(source);
  Stream stream(141, Purpose::test);
  int refused = 0;
  for (int round = 0; round < 1500; ++round) {
    std::string altered = bytes;
    for (std::uint32_t i = 0; i <= stream.below(3); ++i)
      altered[stream.below(static_cast<std::uint32_t>(altered.size()))] =
          static_cast<char>(stream.below(256));
    Population population(small_settings(12), 2, 1, false, 9);
    if (!load(population, altered).empty()) {
      ++refused;
      continue;
    }
    for (const Genome& genome : population.genomes()) ASSERT_NO_THROW(validate(genome, 2, 1, false));
  }
  EXPECT_GT(refused, 500);
}

TEST(PopulationLoad, RefusesAWeightThatIsNotFinite) {
  Population population(small_settings(), 2, 1, true, 9);
  std::string bytes = bytes_of(population);
  const double weight = population.genomes()[3].links[1].weight,
               infinite = std::numeric_limits<double>::infinity();
  const std::string_view old(reinterpret_cast<const char*>(&weight), sizeof weight);
  const std::size_t at = bytes.find(old);
  ASSERT_NE(at, std::string::npos);
  bytes.replace(at, sizeof infinite, reinterpret_cast<const char*>(&infinite), sizeof infinite);
  EXPECT_NE(load(population, bytes).find("checkpoint: genome: link 1 has a weight that is not finite"),
            std::string::npos);
}

}  // namespace
}  // namespace amble::neat
