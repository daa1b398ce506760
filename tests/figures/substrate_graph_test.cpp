#include "amble/figures/substrate_graph.hpp"

#include <gtest/gtest.h>

#include "tests/motion/fixture.hpp"

namespace amble::figures {
namespace {

TEST(SubstrateGraph, ShowsSignsAsKindsAndWeightsAsSharesOfTheLargest) {
  const Substrate substrate = substrate_of(motion::parse_network(tests::network_json(), "x"));
  EXPECT_EQ(substrate.coordinates, (std::vector<std::string>{"x", "y"}));
  ASSERT_EQ(substrate.nodes.size(), 3u);
  EXPECT_EQ(substrate.nodes[1].name, "inner");
  EXPECT_EQ(substrate.nodes[2].role, motion::NodeRole::joint);
  EXPECT_EQ(substrate.link_kinds, (std::vector<std::string>{"excites", "inhibits"}));
  ASSERT_EQ(substrate.links.size(), 2u);
  EXPECT_EQ(substrate.links[0].kind, 0);
  EXPECT_EQ(substrate.links[1].kind, 1);
  EXPECT_EQ(substrate.links[0].strength, 1.0);
  EXPECT_EQ(substrate.links[1].strength, 0.25);
  EXPECT_EQ(substrate.links[1].source, 1);
  EXPECT_EQ(substrate.links[1].target, 2);
}

TEST(SubstrateGraph, ShowsPortsAsKindsWhereLinksHaveThem) {
  motion::NeuralNetwork network = motion::parse_network(tests::network_json(), "x");
  network.links = {{0, 1, 4.0, "hidden"}, {1, 2, -0.1, "rate"}, {0, 2, 0.2, "rate"}, {0, 1, -1.0, "hidden"}};
  const Substrate substrate = substrate_of(network);
  EXPECT_EQ(substrate.link_kinds, (std::vector<std::string>{"hidden", "rate"}));
  const std::vector<int> kinds{0, 1, 1, 0};
  const std::vector<double> strengths{1.0, 0.5, 1.0, 0.25};
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_EQ(substrate.links[i].kind, kinds[i]);
    EXPECT_EQ(substrate.links[i].strength, strengths[i]) << "a share of the port's largest weight";
    EXPECT_EQ(substrate.links[i].negative, network.links[i].weight < 0.0);
  }
}

TEST(SubstrateGraph, HasNoStrengthWhereAllWeightsAreZero) {
  motion::NeuralNetwork network = motion::parse_network(tests::network_json(), "x");
  for (motion::NetworkLink& link : network.links) link.weight = 0.0;
  for (const SubstrateLink& link : substrate_of(network).links) {
    EXPECT_EQ(link.kind, 0);
    EXPECT_EQ(link.strength, 0.0);
  }
}

TEST(SubstrateGraph, CanBeDrawnWithUpToFourCoordinates) {
  EXPECT_TRUE(
      can_be_drawn({.coordinates = {"a", "b", "c", "d"}, .nodes = {}, .links = {}, .link_kinds = {}}));
  EXPECT_FALSE(
      can_be_drawn({.coordinates = {"a", "b", "c", "d", "e"}, .nodes = {}, .links = {}, .link_kinds = {}}));
}

}  // namespace
}  // namespace amble::figures
