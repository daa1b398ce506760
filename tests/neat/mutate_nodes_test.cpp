#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "amble/neat/mutation.hpp"
#include "tests/neat/samples.hpp"

namespace amble::neat {
namespace {

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

}  // namespace
}  // namespace amble::neat
