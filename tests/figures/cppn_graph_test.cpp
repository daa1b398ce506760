#include "amble/figures/cppn_graph.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <random>

#include "tests/figures/cppn_samples.hpp"

namespace amble::figures {
namespace {

using testing::ElementsAre;

TEST(PlaceNodes, PutsInputsFirstOutputsLastAndHiddenNodesByTheirLongestWay) {
  const auto places = place_nodes(tests::cppn());
  // bias, leg, time | gaussian | sigmoid | pattern, offset
  EXPECT_THAT(places.layers,
              ElementsAre(ElementsAre(0, 1, 2), ElementsAre(5), ElementsAre(6), ElementsAre(3, 4)));
  EXPECT_THAT(places.layer, ElementsAre(0, 0, 0, 3, 3, 1, 2));
}

TEST(PlaceNodes, KnowsTheLinksThatLeadBack) {
  auto graph = tests::cppn();
  graph.links = {{6, 5, 1.0, true}, {5, 6, 1.0, true}, {3, 3, 1.0, true},
                 {3, 4, 1.0, true}, {1, 5, 1.0, true}, {6, 3, 1.0, true}};
  const auto places = place_nodes(graph);
  std::vector<bool> back;
  for (const CppnLink& link : graph.links) back.push_back(places.leads_back(link));
  EXPECT_THAT(back, ElementsAre(true, false, true, true, false, false));
}

TEST(PlaceNodes, TakesACppnWithoutHiddenNodesOrLinks) {
  auto graph = tests::cppn();
  graph.nodes.resize(5);
  graph.links.clear();
  const auto places = place_nodes(graph);
  EXPECT_THAT(places.layers, ElementsAre(ElementsAre(0, 1, 2), ElementsAre(3, 4)));
  EXPECT_DOUBLE_EQ(places.place[1], 0.5);
}

TEST(PlaceNodes, OrdersALayerByItsNeighbours) {
  // Two hidden nodes of one layer, the first fed from below, the second from above.
  auto graph = tests::cppn();
  graph.links = {{2, 5, 1.0, true}, {0, 6, 1.0, true}, {5, 4, 1.0, true}, {6, 3, 1.0, true}};
  EXPECT_THAT(place_nodes(graph).layers[1], ElementsAre(6, 5));
}

TEST(PlaceNodes, PlacesEveryNodeOfAnyGraphOnce) {
  std::minstd_rand random(7);
  const auto below = [&](std::size_t end) { return static_cast<std::size_t>(random()) % end; };
  for (int round = 0; round < 300; ++round) {
    CppnGraph graph;
    const std::size_t nodes = 2 + below(30);
    for (std::size_t i = 0; i < nodes; ++i)
      graph.nodes.push_back({static_cast<std::uint32_t>(i), static_cast<CppnRole>(below(4)), "sine", ""});
    for (std::size_t i = below(3 * nodes); i > 0; --i)
      graph.links.push_back({below(nodes), below(nodes), 1.0, below(2) == 0});
    const auto places = place_nodes(graph);
    std::vector<int> seen(nodes);
    for (std::size_t layer = 0; layer < places.layers.size(); ++layer) {
      EXPECT_FALSE(places.layers[layer].empty());
      for (const std::size_t node : places.layers[layer]) {
        ++seen[node];
        EXPECT_EQ(places.layer[node], layer);
        EXPECT_GT(places.place[node], 0.0);
        EXPECT_LT(places.place[node], 1.0);
      }
    }
    EXPECT_THAT(seen, testing::Each(1)) << round;
  }
}

TEST(CppnGraph, NamesNodesAndTheHeaviestWeight) {
  auto graph = tests::cppn();
  EXPECT_EQ(graph.name_of(1), "leg");
  EXPECT_EQ(graph.name_of(5), "node 9");
  EXPECT_EQ(graph.heaviest_weight(), 3.0);
  graph.links.clear();
  EXPECT_EQ(graph.heaviest_weight(), 1.0);
}

using testing::HasSubstr;

TEST(CppnDot, HasALineForEachNodeAndEachLink) {
  EXPECT_EQ(cppn_dot(tests::cppn()),
            "digraph cppn {\n"
            "  rankdir=LR;\n"
            "  node [fontname=\"sans-serif\", fontsize=11];\n"
            "  n0 [label=\"bias\", shape=plaintext];\n"
            "  n1 [label=\"leg\", shape=plaintext];\n"
            "  n2 [label=\"time\", shape=plaintext];\n"
            "  n3 [label=\"pattern\\nsine\", shape=ellipse];\n"
            "  n4 [label=\"offset\\nbipolar_sigmoid\", shape=ellipse];\n"
            "  n9 [label=\"gaussian\", shape=ellipse];\n"
            "  n12 [label=\"bipolar_sigmoid\", shape=ellipse];\n"
            "  { rank=source; n0; n1; n2; }\n"
            "  { rank=sink; n3; n4; }\n"
            "  n0 -> n9 [penwidth=2.53, color=\"#00796b\", style=solid, tooltip=\"1\"];\n"
            "  n2 -> n9 [penwidth=3.4, color=\"#c2410c\", style=solid, tooltip=\"-1.5\"];\n"
            "  n9 -> n12 [penwidth=1.67, color=\"#00796b\", style=solid, tooltip=\"0.5\"];\n"
            "  n12 -> n3 [penwidth=6, color=\"#00796b\", style=solid, tooltip=\"3\"];\n"
            "  n1 -> n4 [penwidth=2.1, color=\"#00796b\", style=dashed, tooltip=\"0.75\"];\n"
            "}\n");
}

TEST(CppnDot, LetsNoNameEndItsString) {
  auto graph = tests::cppn();
  graph.nodes[1].name = "a \"leg\" \\";
  EXPECT_THAT(cppn_dot(graph), HasSubstr("n1 [label=\"a \\\"leg\\\" \\\\\", shape=plaintext];\n"));
}

}  // namespace

}  // namespace amble::figures
