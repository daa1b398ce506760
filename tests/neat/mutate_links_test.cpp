#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <set>

#include "amble/neat/mutation.hpp"
#include "tests/neat/samples.hpp"

namespace amble::neat {
namespace {

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
  // Of the recurrent twelve not: a node to itself (three times), and 3 → 4, because 4 → 3 is there.
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

}  // namespace
}  // namespace amble::neat
