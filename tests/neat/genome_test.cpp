#include "amble/neat/genome.hpp"

#include <gtest/gtest.h>

#include <limits>

#include "tests/neat/samples.hpp"

namespace amble::neat {
namespace {

Genome small() {
  return sample_genome(2, 1,
                       {{7, NodeKind::hidden, Activation::sine}, {9, NodeKind::hidden, Activation::gaussian}},
                       {{0, 0, 3, 0.5, true}, {2, 1, 7, -1.0, false}, {5, 7, 3, 1.0, true}});
}

TEST(Genome, CountsNodesByKindAndEnabledLinks) {
  const Genome genome = small();
  EXPECT_EQ(genome.count(NodeKind::bias), 1);
  EXPECT_EQ(genome.count(NodeKind::input), 2);
  EXPECT_EQ(genome.count(NodeKind::output), 1);
  EXPECT_EQ(genome.count(NodeKind::hidden), 2);
  EXPECT_EQ(genome.enabled_links(), 2);
}

TEST(Genome, FindsNodesById) {
  const Genome genome = small();
  EXPECT_EQ(genome.index_of(0), 0);
  EXPECT_EQ(genome.index_of(3), 3);
  EXPECT_EQ(genome.index_of(7), 4);
  EXPECT_EQ(genome.index_of(9), 5);
  EXPECT_EQ(genome.index_of(8), -1);
  EXPECT_EQ(genome.index_of(10), -1);
}

TEST(Genome, HashSeesEveryField) {
  const Genome genome = small();
  std::vector<Genome> variants(8, genome);
  variants[0].nodes[4].id = 8;
  variants[1].nodes[4].activation = Activation::linear;
  variants[2].nodes[5].kind = NodeKind::output;
  variants[3].links[1].innovation = 3;
  variants[4].links[1].from = 2;
  variants[5].links[1].to = 9;
  variants[6].links[0].weight += std::numeric_limits<double>::epsilon();
  variants[7].links[1].enabled = true;
  EXPECT_EQ(small().hash(), genome.hash());
  for (std::size_t i = 0; i < variants.size(); ++i) EXPECT_NE(variants[i].hash(), genome.hash()) << i;
}

TEST(Genome, InsertsGenesWhereTheirNumbersBelong) {
  Genome genome = small();
  insert_node(genome, {8, NodeKind::hidden, Activation::linear});
  EXPECT_EQ(genome.index_of(8), 5);
  insert_link(genome, {3, 1, 8, 0.0, true});
  insert_link(genome, {9, 8, 3, 0.0, true});
  std::vector<std::uint32_t> numbers;
  for (const LinkGene& link : genome.links) numbers.push_back(link.innovation);
  EXPECT_EQ(numbers, (std::vector<std::uint32_t>{0, 2, 3, 5, 9}));
}

TEST(Genome, DropsOnlyHiddenNodesThatNoLinkTouches) {
  Genome genome = small();
  remove_unlinked_hidden_nodes(genome);
  EXPECT_EQ(genome.index_of(9), -1) << "node 9 has no link";
  EXPECT_EQ(genome.index_of(7), 4);
  EXPECT_EQ(genome.index_of(2), 2) << "input 2 has no link either, but stays";
}

}  // namespace
}  // namespace amble::neat
