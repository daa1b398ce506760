#include "amble/neat/mutation.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <set>

#include "tests/neat/samples.hpp"

namespace amble::neat {
namespace {

TEST(Mutation, DrawsOperatorsByTheirNormalisedShares) {
  Innovations innovations(3, 2);
  Stream stream(91, Purpose::test);
  Settings settings;
  settings.mutation.delete_link_share = 0.02;
  const Genome before = grown_genome(3, 2, 20, true, innovations, stream);
  std::array<int, 5> hits{};
  const int count = 50000;
  for (int i = 0; i < count; ++i) {
    Genome genome = before;
    ++hits[static_cast<std::size_t>(mutate(genome, settings, true, innovations, stream))];
    ASSERT_NE(genome, before);
  }
  const std::array<double, 5> shares{0.96 / 1.05, 0.06 / 1.05, 0.01 / 1.05, 0.02 / 1.05, 0.0};
  for (std::size_t i = 0; i < hits.size(); ++i)
    EXPECT_NEAR(hits[i], count * shares[i], 5 * std::sqrt(count * shares[i] * (1 - shares[i]))) << i;
}

TEST(Mutation, DrawsAgainWhenAnOperatorFindsNothingToDo) {
  Innovations innovations(1, 1);
  Stream stream(92, Purpose::test);
  // Without links only add_link can work.
  for (int i = 0; i < 200; ++i) {
    Genome genome = sample_genome(1, 1, {}, {});
    ASSERT_EQ(mutate(genome, {}, false, innovations, stream), Mutation::add_link);
    ASSERT_EQ(genome.links.size(), 1u);
  }
}

TEST(Mutation, LeavesAGenomeAloneThatNoOperatorCanChange) {
  Innovations innovations(1, 1);
  Stream stream(93, Purpose::test);
  Settings settings;
  settings.mutation.add_link_share = 0;
  Genome genome = sample_genome(1, 1, {}, {});
  EXPECT_EQ(mutate(genome, settings, false, innovations, stream), Mutation::none);
  EXPECT_EQ(genome, sample_genome(1, 1, {}, {}));
}

using Pair = std::pair<std::uint32_t, std::uint32_t>;

/// Input 1 → hidden 4 → output 3, and bias 0 → output 2.
Genome chain(Innovations& innovations) {
  const auto bias = innovations.link(0, 2), straight = innovations.link(1, 3);
  const auto node = innovations.node(straight, Activation::sine, sample_genome(1, 2, {}, {}));
  EXPECT_EQ(node, 4u);
  const auto in = innovations.link(1, node), out = innovations.link(node, 3);
  return sample_genome(1, 2, {{node, NodeKind::hidden, Activation::sine}},
                       {{bias, 0, 2, 0.5, true}, {in, 1, node, 1.0, true}, {out, node, 3, 0.5, false}});
}

std::map<Pair, int> added_pairs(bool recurrent, int count) {
  Innovations innovations(1, 2);
  const Genome before = chain(innovations);
  Stream stream(71, Purpose::test);
  std::map<Pair, int> hits;
  for (int i = 0; i < count; ++i) {
    Genome genome = before;
    EXPECT_TRUE(add_link(genome, 1.5, recurrent, innovations, stream));
    EXPECT_EQ(genome.links.size(), before.links.size() + 1);
    EXPECT_EQ(genome.nodes, before.nodes);
    for (const LinkGene& link : genome.links)
      if (std::ranges::find(before.links, link.innovation, &LinkGene::innovation) == before.links.end()) {
        ++hits[{link.from, link.to}];
        EXPECT_LE(std::abs(link.weight), 1.5);
        EXPECT_TRUE(link.enabled);
        EXPECT_EQ(link.innovation, innovations.link(link.from, link.to));
      }
  }
  return hits;
}

TEST(AddLink, JoinsEveryFreePairOfARecurrentGenomeEquallyOften) {
  // Five sources (0 … 4), three targets (2, 3, 4), less the three pairs that are taken.
  const auto hits = added_pairs(true, 12000);
  EXPECT_EQ(hits.size(), 12u);
  for (const auto& [pair, count] : hits) {
    EXPECT_NEAR(count, 1000, 5 * std::sqrt(1000.0)) << pair.first << " → " << pair.second;
    EXPECT_GE(pair.second, 2u) << "neither bias nor input is a target";
  }
  EXPECT_TRUE(hits.contains({4, 4})) << "a node may be joined to itself";
  EXPECT_TRUE(hits.contains({3, 4}));
  EXPECT_FALSE(hits.contains({4, 3})) << "a disabled link is there, too";
}

TEST(AddLink, ClosesNoCycleInAFeedForwardGenome) {
  const auto hits = added_pairs(false, 9000);
  std::set<Pair> pairs;
  for (const auto& [pair, count] : hits) pairs.insert(pair);
  // Not among the twelve recurrent ones: a node to itself (three times), and 3 → 4, because 4 → 3 is there.
  EXPECT_EQ(pairs, (std::set<Pair>{{0, 3}, {0, 4}, {1, 2}, {1, 3}, {2, 3}, {2, 4}, {3, 2}, {4, 2}}));
}

TEST(AddLink, FillsAGenomeUpAndThenGivesUp) {
  for (const bool recurrent : {true, false}) {
    Innovations innovations(1, 2);
    Genome genome = chain(innovations);
    Stream stream(72, Purpose::test);
    while (add_link(genome, 1.5, recurrent, innovations, stream)) validate(genome, 1, 2, recurrent);
    // Recurrent: 5 × 3 pairs. Feed-forward: three computed nodes in some order have 3 pairs, and 2 × 3 come
    // from bias and input.
    EXPECT_EQ(genome.links.size(), recurrent ? 15u : 9u);
  }
}

TEST(DeleteLink, TakesEachLinkEquallyOftenAndItsLonelyNode) {
  Innovations innovations(1, 2);
  const Genome before = chain(innovations);
  Stream stream(73, Purpose::test);
  std::map<std::uint32_t, int> deleted;
  for (int i = 0; i < 3000; ++i) {
    Genome genome = before;
    ASSERT_TRUE(delete_link(genome, stream));
    ASSERT_EQ(genome.links.size(), 2u);
    ASSERT_EQ(genome.count(NodeKind::hidden), 1) << "one link still touches node 4";
    for (const LinkGene& link : before.links)
      if (std::ranges::find(genome.links, link) == genome.links.end()) ++deleted[link.innovation];
  }
  EXPECT_EQ(deleted.size(), 3u);
  for (const auto& [innovation, count] : deleted) EXPECT_NEAR(count, 1000, 5 * std::sqrt(1000.0));
}

TEST(DeleteLink, EndsWithTheBareGenome) {
  Innovations innovations(1, 2);
  Genome genome = chain(innovations);
  Stream stream(74, Purpose::test);
  for (int i = 0; i < 3; ++i) EXPECT_TRUE(delete_link(genome, stream));
  EXPECT_EQ(genome, sample_genome(1, 2, {}, {}));
  EXPECT_FALSE(delete_link(genome, stream));
}

/// Two links into output 3, the second disabled.
Genome two_links(Innovations& innovations) {
  return sample_genome(
      2, 1, {}, {{innovations.link(1, 3), 1, 3, -0.7, true}, {innovations.link(2, 3), 2, 3, 0.3, false}});
}

TEST(AddNode, ReplacesALinkByTwoAsTheAuthorsDid) {
  Innovations innovations(2, 1);
  Genome genome = two_links(innovations);
  Stream stream(81, Purpose::test);
  ASSERT_TRUE(add_node(genome, {}, innovations, stream));
  ASSERT_EQ(genome.count(NodeKind::hidden), 1);
  const NodeGene node = genome.nodes.back();
  EXPECT_EQ(node.id, 4u);
  EXPECT_EQ(genome.links,
            (std::vector<LinkGene>{{1, 2, 3, 0.3, false}, {2, 1, 4, 1.0, true}, {3, 4, 3, -0.7, true}}));
}

TEST(AddNode, DisablesTheOldLinkAsStanleyAndMiikkulainenDid) {
  Innovations innovations(2, 1);
  Genome genome = two_links(innovations);
  Settings settings;
  settings.mutation.split_link = SplitLink::disable;
  Stream stream(82, Purpose::test);
  ASSERT_TRUE(add_node(genome, settings, innovations, stream));
  EXPECT_EQ(genome.links,
            (std::vector<LinkGene>{
                {0, 1, 3, -0.7, false}, {1, 2, 3, 0.3, false}, {2, 1, 4, 1.0, true}, {3, 4, 3, -0.7, true}}));
}

TEST(AddNode, KeepsTheNewWeightWithinTheLimit) {
  Innovations innovations(2, 1);
  Genome genome = two_links(innovations);
  Settings settings;
  settings.genome.weight_limit = 0.8;
  Stream stream(83, Purpose::test);
  ASSERT_TRUE(add_node(genome, settings, innovations, stream));
  EXPECT_EQ(genome.links[1].weight, 0.8);
}

TEST(AddNode, DrawsTheFunctionByItsShare) {
  Settings settings;
  settings.genome.activation_shares = {0.1, 0.2, 0.0, 0.3};
  Stream stream(84, Purpose::test);
  std::array<int, 4> hits{};
  const int count = 30000;
  for (int i = 0; i < count; ++i) {
    Innovations innovations(2, 1);
    Genome genome = two_links(innovations);
    add_node(genome, settings, innovations, stream);
    ++hits[static_cast<std::size_t>(genome.nodes.back().activation)];
  }
  const std::array<double, 4> expected{count / 6.0, count / 3.0, 0.0, count / 2.0};
  for (std::size_t i = 0; i < 4; ++i) EXPECT_NEAR(hits[i], expected[i], 5 * std::sqrt(expected[i])) << i;
}

TEST(AddNode, NumbersTheSameSplitTheSameInTwoGenomes) {
  Innovations innovations(2, 1);
  Genome one = two_links(innovations), two = two_links(innovations);
  Settings settings;
  settings.genome.activation_shares = {1, 0, 0, 0};
  Stream stream(85, Purpose::test);
  add_node(one, settings, innovations, stream);
  add_node(two, settings, innovations, stream);
  EXPECT_EQ(one, two);
}

TEST(AddNode, SplitsALinkThatCameBackByAnotherNode) {
  Innovations innovations(2, 1);
  Genome genome = two_links(innovations);
  Settings settings;
  settings.genome.activation_shares = {1, 0, 0, 0};
  Stream stream(86, Purpose::test);
  add_node(genome, settings, innovations, stream);
  // Let the old link come back, as add_link would; all others are disabled so that it is split again.
  for (LinkGene& link : genome.links) link.enabled = false;
  insert_link(genome, {innovations.link(1, 3), 1, 3, 0.2, true});
  ASSERT_TRUE(add_node(genome, settings, innovations, stream));
  EXPECT_EQ(genome.count(NodeKind::hidden), 2);
  EXPECT_NO_THROW(validate(genome, 2, 1, false));
}

TEST(AddNode, NeedsAnEnabledLink) {
  Innovations innovations(2, 1);
  Stream stream(87, Purpose::test);
  Genome genome = two_links(innovations);
  genome.links[0].enabled = false;
  const Genome before = genome;
  EXPECT_FALSE(add_node(genome, {}, innovations, stream));
  EXPECT_EQ(genome, before);
}

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

TEST(MutateWeights, JigglesAWeightBeyondTheLimitFromWhereItIs) {
  Stream stream(65, Purpose::test);
  WeightMutationSettings settings;
  settings.reset_few_share = settings.reset_one_share = 0.0;
  Genome genome = forty_links(1.4);
  for (LinkGene& link : genome.links) link.weight = 4.0;
  mutate_weights(genome, settings, limit, stream);
  for (const LinkGene& link : genome.links) {
    EXPECT_LE(link.weight, 4.0);
    EXPECT_GE(link.weight, 4.0 - settings.jiggle_limit);
  }
}

TEST(MutateWeights, CannotWorkWithoutLinks) {
  Stream stream(64, Purpose::test);
  Genome genome = sample_genome(1, 1, {}, {});
  EXPECT_FALSE(mutate_weights(genome, {}, limit, stream));
}

}  // namespace

}  // namespace amble::neat
