#include "amble/motion/neural_network.hpp"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "tests/motion/fixture.hpp"

namespace amble::motion {
namespace {

TEST(NeuralNetwork, IsReadFromJson) {
  const NeuralNetwork network = parse_network(tests::network_json(), "x");
  EXPECT_EQ(network.coordinates, (std::vector<std::string>{"x", "y"}));
  ASSERT_EQ(network.nodes.size(), 3u);
  EXPECT_EQ(network.nodes[0].role, NodeRole::sensor);
  EXPECT_EQ(network.nodes[1].role, NodeRole::hidden);
  EXPECT_EQ(network.nodes[2].role, NodeRole::joint);
  EXPECT_EQ(network.nodes[1].name, "inner");
  EXPECT_EQ(network.nodes[1].at, (std::vector{0.0, 0.5}));
  ASSERT_EQ(network.links.size(), 2u);
  EXPECT_EQ(network.links[0].source, 0);
  EXPECT_EQ(network.links[0].target, 1);
  EXPECT_EQ(network.links[0].weight, 2.0);
  EXPECT_EQ(network.links[1].weight, -0.5);
  EXPECT_EQ(network.possible_links, 4);
}

template <typename Spoil>
std::string error_after(Spoil spoil) {
  auto json = nlohmann::json::parse(tests::network_json());
  spoil(json);
  return tests::error_of([&] { parse_network(json.dump(), "walk.rec: controller"); });
}

TEST(NeuralNetwork, NamesWhatIsWrong) {
  using Json = nlohmann::json;
  EXPECT_EQ(error_after([](Json& json) { json["links"][0]["target"] = 3; }),
            "walk.rec: controller: key 'links[0].target' must be the index of a node");
  EXPECT_EQ(error_after([](Json& json) { json["links"][0]["source"] = -1; }),
            "walk.rec: controller: key 'links[0].source' must be the index of a node");
  EXPECT_EQ(error_after([](Json& json) { json["nodes"][0]["at"] = {1}; }),
            "walk.rec: controller: key 'nodes[0].at' must be a number for each coordinate");
  EXPECT_EQ(error_after([](Json& json) { json["nodes"][0]["role"] = "king"; }),
            "walk.rec: controller: key 'nodes[0].role' must be sensor, hidden or joint");
  for (const std::int64_t count : {std::int64_t{-1}, std::int64_t{1} << 31})
    EXPECT_EQ(error_after([count](Json& json) { json["possible_links"] = count; }),
              "walk.rec: controller: key 'possible_links' must be a whole number from 0 to 2147483647");
  EXPECT_EQ(error_after([](Json& json) { json.erase("possible_links"); }),
            "walk.rec: controller: key 'possible_links' is missing");
}

TEST(NeuralNetwork, LinksNodesFromTheFirstToTheLast) {
  using Json = nlohmann::json;
  for (const char* end : {"source", "target"}) {
    for (const int node : {0, 2})
      EXPECT_EQ(error_after([&](Json& json) { json["links"][1][end] = node; }), "no error");
    for (const int node : {-1, 3})
      EXPECT_NE(
          error_after([&](Json& json) { json["links"][1][end] = node; }).find("must be the index of a node"),
          std::string::npos)
          << end << " " << node;
  }
  EXPECT_NE(error_after([](Json& json) { json["links"][1]["weight"] = "inf"; }).find("a finite number"),
            std::string::npos);
  EXPECT_NE(error_after([](Json& json) {
              json["nodes"][0]["at"] = {1, 2, 3};
            }).find("a number for each coordinate"),
            std::string::npos);
}

}  // namespace
}  // namespace amble::motion
