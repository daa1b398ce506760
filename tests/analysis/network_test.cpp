#include "amble/analysis/network.hpp"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "tests/analysis/fixture.hpp"

namespace amble::analysis {
namespace {

TEST(NeuralNetwork, IsReadFromJson) {
  const NeuralNetwork network = parse_network(tests::network_json(), "x");
  const Substrate& substrate = network.substrate;
  EXPECT_EQ(substrate.coordinates, (std::vector<std::string>{"x", "y"}));
  ASSERT_EQ(substrate.nodes.size(), 3u);
  EXPECT_EQ(substrate.nodes[0].role, NodeRole::sensor);
  EXPECT_EQ(substrate.nodes[1].role, NodeRole::hidden);
  EXPECT_EQ(substrate.nodes[2].role, NodeRole::joint);
  EXPECT_EQ(substrate.nodes[1].at, (std::vector{0.0, 0.5}));
  ASSERT_EQ(substrate.links.size(), 2u);
  EXPECT_EQ(substrate.links[0].kind, 0);
  EXPECT_EQ(substrate.links[1].kind, 1) << "inhibits";
  EXPECT_EQ(substrate.links[0].strength, 1.0);
  EXPECT_EQ(substrate.links[1].strength, 0.25);
  EXPECT_EQ(network.possible_links, 4);
}

template <typename Spoil>
std::string complaint(Spoil spoil) {
  auto json = nlohmann::json::parse(tests::network_json());
  spoil(json);
  return tests::error_of([&] { parse_network(json.dump(), "walk.rec: controller"); });
}

TEST(NeuralNetwork, NamesWhatIsWrong) {
  using Json = nlohmann::json;
  EXPECT_EQ(complaint([](Json& json) { json["links"][0]["target"] = 3; }),
            "walk.rec: controller: key 'links[0].target' must be the index of a node");
  EXPECT_EQ(complaint([](Json& json) { json["links"][0]["source"] = -1; }),
            "walk.rec: controller: key 'links[0].source' must be the index of a node");
  EXPECT_EQ(complaint([](Json& json) { json["nodes"][0]["at"] = {1}; }),
            "walk.rec: controller: key 'nodes[0].at' must be a number for each coordinate");
  EXPECT_EQ(complaint([](Json& json) { json["nodes"][0]["role"] = "king"; }),
            "walk.rec: controller: key 'nodes[0].role' must be sensor, hidden or joint");
  EXPECT_EQ(complaint([](Json& json) { json.erase("possible_links"); }),
            "walk.rec: controller: key 'possible_links' is missing");
}

}  // namespace
}  // namespace amble::analysis
