#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "amble/neat/mutation.hpp"
#include "tests/neat/samples.hpp"

namespace amble::neat {
namespace {

constexpr int links = 40, rounds = 4000;
constexpr double limit = 1.5;

/// One input, forty outputs: forty links of the given weight.
Genome forty_links(double weight) {
  std::vector<LinkGene> genes;
  for (std::uint32_t i = 0; i < links; ++i) genes.push_back({i, 1, 2 + i, weight, i % 2 == 0});
  return sample_genome(1, links, {}, genes);
}

WeightMutationSettings only(double WeightMutationSettings::*share) {
  WeightMutationSettings settings;
  settings.jiggle_many_share = settings.jiggle_few_share = settings.jiggle_one_share = 0;
  settings.reset_few_share = settings.reset_one_share = 0;
  settings.*share = 1;
  return settings;
}

struct Changes {
  double mean_count = 0, largest = 0;
  int fewest = links, most = 0;
};

Changes changes(const WeightMutationSettings& settings) {
  Stream stream(61, Purpose::test);
  Changes result;
  const Genome before = forty_links(0.0);
  for (int round = 0; round < rounds; ++round) {
    Genome after = before;
    EXPECT_TRUE(mutate_weights(after, settings, limit, stream));
    int count = 0;
    for (const LinkGene& link : after.links) {
      count += link.weight != 0.0;
      result.largest = std::max(result.largest, std::abs(link.weight));
    }
    result.mean_count += static_cast<double>(count) / rounds;
    result.fewest = std::min(result.fewest, count);
    result.most = std::max(result.most, count);
    for (LinkGene& link : after.links) link.weight = 0.0;
    EXPECT_EQ(after, before) << "nothing but weights changes";
  }
  return result;
}

/// Five standard errors of the mean number of changed links.
double tolerance(double probability) {
  return 5 * std::sqrt(links * probability * (1 - probability) / rounds);
}

TEST(MutateWeights, JigglesHalfOfTheLinks) {
  const Changes c = changes(only(&WeightMutationSettings::jiggle_many_share));
  EXPECT_NEAR(c.mean_count, 20.0, tolerance(0.5));
  EXPECT_LE(c.largest, 0.05);
  EXPECT_GT(c.largest, 0.0499);
}

TEST(MutateWeights, JigglesATenthOfTheLinksAtLeastOne) {
  const Changes c = changes(only(&WeightMutationSettings::jiggle_few_share));
  // One link instead of none, which happens with probability 0.9^40.
  EXPECT_NEAR(c.mean_count, 4.0 + std::pow(0.9, 40), tolerance(0.1));
  EXPECT_EQ(c.fewest, 1);
  EXPECT_LE(c.largest, 0.05);
}

TEST(MutateWeights, JigglesOneLink) {
  const Changes c = changes(only(&WeightMutationSettings::jiggle_one_share));
  EXPECT_EQ(c.fewest, 1);
  EXPECT_EQ(c.most, 1);
  EXPECT_LE(c.largest, 0.05);
}

TEST(MutateWeights, ResetsATenthOfTheLinks) {
  const Changes c = changes(only(&WeightMutationSettings::reset_few_share));
  EXPECT_NEAR(c.mean_count, 4.0 + std::pow(0.9, 40), tolerance(0.1));
  EXPECT_GT(c.largest, 1.49);
  EXPECT_LE(c.largest, limit);
}

TEST(MutateWeights, ResetsOneLink) {
  const Changes c = changes(only(&WeightMutationSettings::reset_one_share));
  EXPECT_EQ(c.fewest, 1);
  EXPECT_EQ(c.most, 1);
  EXPECT_GT(c.largest, 1.49);
}

TEST(MutateWeights, DrawsTheKindsByTheirShares) {
  // Marked by how many links change: all (many), none but the one (few), …; resets are told by their size.
  WeightMutationSettings settings;
  settings.jiggle_many_probability = 1.0;
  settings.reset_few_probability = 1.0;
  Stream stream(62, Purpose::test);
  int jiggled_all = 0, jiggled_one = 0, reset_all = 0, reset_one = 0;
  const int count = 40000;
  for (int round = 0; round < count; ++round) {
    Genome genome = forty_links(10.0);  // a weight that jiggling cuts to the limit and a reset throws away
    for (LinkGene& link : genome.links) link.weight = 1.0;
    settings.jiggle_few_probability = 0.0;
    mutate_weights(genome, settings, limit, stream);
    int changed = 0;
    bool far = false;
    for (const LinkGene& link : genome.links) {
      changed += link.weight != 1.0;
      far = far || std::abs(link.weight - 1.0) > 0.05;
    }
    if (changed > 1)
      ++(far ? reset_all : jiggled_all);
    else
      ++(far ? reset_one : jiggled_one);
  }
  const auto near = [&](double n, double p) {
    return std::abs(n - count * p) < 5 * std::sqrt(count * p * (1 - p));
  };
  EXPECT_TRUE(near(jiggled_all, 0.125)) << jiggled_all;
  EXPECT_TRUE(near(reset_all, 0.5)) << reset_all;
  // A reset lands within 0.05 of the old weight with probability 0.1 / 3 and is then counted with the
  // jiggles.
  EXPECT_TRUE(near(jiggled_one, 0.25 + 0.125 / 30)) << jiggled_one;
  EXPECT_TRUE(near(reset_one, 0.125 - 0.125 / 30)) << reset_one;
}

TEST(MutateWeights, StaysWithinTheLimit) {
  Stream stream(63, Purpose::test);
  WeightMutationSettings settings;
  settings.jiggle_limit = 5.0;
  Genome genome = forty_links(1.4);
  for (int round = 0; round < 1000; ++round) {
    mutate_weights(genome, settings, limit, stream);
    for (const LinkGene& link : genome.links) ASSERT_LE(std::abs(link.weight), limit);
  }
}

TEST(MutateWeights, CannotWorkWithoutLinks) {
  Stream stream(64, Purpose::test);
  Genome genome = sample_genome(1, 1, {}, {});
  EXPECT_FALSE(mutate_weights(genome, {}, limit, stream));
}

}  // namespace
}  // namespace amble::neat
