#include "amble/neat/initial_genome.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace amble::neat {
namespace {

TEST(InitialGenome, LinksBiasAndInputsToAllOutputs) {
  Stream stream(1, Purpose::test);
  Innovations innovations(3, 2);
  const Genome genome = initial_genome({}, 3, 2, innovations, stream);
  EXPECT_NO_THROW(validate(genome, 3, 2, false));
  ASSERT_EQ(genome.links.size(), 8u);
  for (std::uint32_t from = 0; from < 4; ++from)
    for (std::uint32_t output = 0; output < 2; ++output) {
      const LinkGene& link = genome.links[from * 2 + output];
      EXPECT_EQ(link.innovation, from * 2 + output);
      EXPECT_EQ(link.from, from);
      EXPECT_EQ(link.to, 4 + output);
      EXPECT_TRUE(link.enabled);
    }
  EXPECT_EQ(genome.nodes[4].activation, Activation::bipolar_sigmoid);
}

TEST(InitialGenome, WeightsAreUniformWithinTheLimit) {
  GenomeSettings settings;
  settings.weight_limit = 1.5;
  Innovations innovations(9, 10);
  double sum = 0, squares = 0, largest = 0;
  const int genomes = 500, links = 100;
  for (int i = 0; i < genomes; ++i) {
    Stream stream(2, Purpose::initial_genome, 0, static_cast<std::uint32_t>(i));
    for (const LinkGene& link : initial_genome(settings, 9, 10, innovations, stream).links) {
      sum += link.weight;
      squares += link.weight * link.weight;
      largest = std::max(largest, std::abs(link.weight));
    }
  }
  const double count = genomes * links;
  EXPECT_NEAR(sum / count, 0.0, 5 * std::sqrt(0.75 / count));
  EXPECT_NEAR(squares / count, 0.75, 0.02);  // (2 · 1.5)² / 12
  EXPECT_LE(largest, 1.5);
  EXPECT_GT(largest, 1.499);
}

TEST(InitialGenome, LeavesLinksOutWithTheGivenProbability) {
  GenomeSettings settings;
  settings.initial_link_probability = 0.3;
  Innovations innovations(9, 10);
  std::size_t links = 0;
  for (std::uint32_t i = 0; i < 500; ++i) {
    Stream stream(3, Purpose::initial_genome, 0, i);
    const Genome genome = initial_genome(settings, 9, 10, innovations, stream);
    for (const LinkGene& link : genome.links)
      ASSERT_EQ(link.innovation, link.from * 10 + (link.to - 10))
          << "a number does not depend on what is left out";
    links += genome.links.size();
  }
  EXPECT_NEAR(static_cast<double>(links), 15000.0, 5 * std::sqrt(50000 * 0.3 * 0.7));
}

}  // namespace
}  // namespace amble::neat
