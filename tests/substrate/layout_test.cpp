#include "amble/substrate/layout.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "amble/core/random.hpp"
#include "tests/substrate/fixture.hpp"

namespace amble::substrate {
namespace {

using neat::Activation;
using neat::NodeKind;

/// A CPPN of linear functions: output k is the sum of row k times (bias, inputs…).
cppn::Network linear_cppn(const std::vector<std::vector<double>>& rows) {
  neat::Genome genome;
  const auto inputs = static_cast<std::uint32_t>(rows[0].size());
  std::uint32_t id = 0, innovation = 0;
  for (; id < inputs; ++id)
    genome.nodes.push_back({id, id == 0 ? NodeKind::bias : NodeKind::input, Activation::linear});
  for (const auto& row : rows) {
    genome.nodes.push_back({id, NodeKind::output, Activation::linear});
    for (std::uint32_t i = 0; i < inputs; ++i) genome.links.push_back({innovation++, i, id, row[i]});
    ++id;
  }
  return {genome, {cppn::Linear::identity, true}};
}

const std::string line = R"(
coordinates = ["x"]
outputs = ["weight", "bias", "tau"]
nodes = [
  { name = "a", group = "in", at = [-1], sensor = "sine" },
  { name = "b", group = "neuron", at = [0.25] },
  { name = "c", group = "neuron", at = [0.5], joint = "L_knee" },
]
links = [
  { from = "in", to = "neuron" },
  { from = "neuron", to = "neuron" },
  { from = "c", to = "c" },
]
properties = [
  { of = "neuron", property = "bias", output = "bias", low = -2, high = 6 },
  { of = "b", property = "time_constant", output = "tau", low = 1, high = 61, zero = ["x"] },
  { of = "c", property = "time_constant", value = 7 },
]
)";

TEST(Layout, LinksAGroupToItselfWithoutSelfLinksAndANodeToItselfByName) {
  const Layout layout(substrate_of(line), ctrnn_needs(), hopper());
  std::vector<std::pair<int, int>> links;
  for (const Link& link : layout.links()) links.emplace_back(link.source, link.target);
  EXPECT_EQ(links, (std::vector<std::pair<int, int>>{{0, 1}, {0, 2}, {1, 2}, {2, 1}, {2, 2}}));
}

TEST(Layout, KnowsWhichNodesDriveAJoint) {
  const Layout layout(substrate_of(line), ctrnn_needs(), hopper());
  std::vector<int> joints;
  for (const Node& node : layout.nodes()) joints.push_back(node.joint);
  EXPECT_EQ(joints, (std::vector{-1, -1, 0}));
}

TEST(Layout, TurnsOutputsIntoWeightsByThresholdAndRange) {
  const Layout layout(substrate_of(line), ctrnn_needs(), hopper());
  // o = source + 2 target: −0.5, 0, 1.25 (counts as 1), 1, 1.5. With threshold 0.2 and range 3 the weight is
  // sign(o) (|o| − 0.2)/0.8 × 3.
  const auto decoded = layout.decode(linear_cppn({{0, 1, 2}, {0, 0, 0}, {0, 0, 0}}));
  ASSERT_EQ(decoded.weights.size(), 5u);
  EXPECT_FLOAT_EQ(decoded.weights[0], -1.125f);
  EXPECT_EQ(decoded.weights[1], 0.0f);
  EXPECT_FLOAT_EQ(decoded.weights[2], 3.0f);
  EXPECT_FLOAT_EQ(decoded.weights[3], 3.0f);
  EXPECT_FLOAT_EQ(decoded.weights[4], 3.0f);
}

TEST(Layout, TakesOutputsBeyondOneForOneOnBothSides) {
  const Layout layout(substrate_of(line), ctrnn_needs(), hopper());
  for (const double o : {1.0, 1.25, 1.5, 40.0})
    for (const double sign : {-1.0, 1.0}) {
      const double x = sign * o;
      const auto decoded = layout.decode(linear_cppn({{x, 0, 0}, {x, 0, 0}, {x, 0, 0}}));
      for (const float weight : decoded.weights) EXPECT_FLOAT_EQ(weight, x > 0 ? 3.0f : -3.0f) << x;
      EXPECT_FLOAT_EQ(decoded.of("bias")[1], x > 0 ? 6.0f : -2.0f) << x;
      EXPECT_FLOAT_EQ(decoded.of("time_constant")[1], x > 0 ? 61.0f : 1.0f) << x;
    }
}

TEST(Layout, ExpressesNoLinkAtTheThresholdItself) {
  auto settings = substrate_of(line);
  settings.expression_threshold = 0.25;
  const Layout layout(settings, ctrnn_needs(), hopper());
  for (const double o : {0.25, -0.25})
    for (const float weight : layout.decode(linear_cppn({{o, 0, 0}, {0, 0, 0}, {0, 0, 0}})).weights)
      EXPECT_EQ(weight, 0.0f);
  for (const double o : {0.625, -0.625})
    for (const float weight : layout.decode(linear_cppn({{o, 0, 0}, {0, 0, 0}, {0, 0, 0}})).weights)
      EXPECT_FLOAT_EQ(weight, o > 0 ? 1.5f : -1.5f);
}

TEST(Layout, MultipliesWeightsByACoordinateOfTheirTargets) {
  auto settings = substrate_of(line);
  settings.nodes[2].at = {-0.5};
  settings.links[0].times = settings.links[2].times = "x";
  const Layout layout(settings, ctrnn_needs(), hopper());
  // All outputs say 0.6, which is (0.6 − 0.2)/0.8 × 3 = 1.5.
  const auto decoded = layout.decode(linear_cppn({{0.6, 0, 0}, {0, 0, 0}, {0, 0, 0}}));
  ASSERT_EQ(decoded.weights.size(), 5u);
  const double factors[] = {0.25, -0.5, 1.0, 1.0, -0.5};
  for (std::size_t i = 0; i < 5; ++i) EXPECT_NEAR(decoded.weights[i], 1.5 * factors[i], 1e-6) << i;
}

TEST(Layout, AsksForPropertiesWithTheOtherCoordinatesZero) {
  const Layout layout(substrate_of(line), ctrnn_needs(), hopper());
  // bias: o = 0.5 + x1 + 100 x2 with x2 = 0, so 0.75 and 1; on the line from −2 at −1 to 6 at 1 that is 5
  // and 6. time constant: o = 0.5 + x1 with x1 counting as 0, so 31 + 30 × 0.5 = 46.
  const auto decoded = layout.decode(linear_cppn({{0, 0, 0}, {0.5, 1, 100}, {0.5, 1, 0}}));
  EXPECT_FLOAT_EQ(decoded.of("bias")[1], 5.0f);
  EXPECT_FLOAT_EQ(decoded.of("bias")[2], 6.0f);
  EXPECT_FLOAT_EQ(decoded.of("time_constant")[1], 46.0f);
  EXPECT_FLOAT_EQ(decoded.of("time_constant")[2], 7.0f);
  EXPECT_EQ(decoded.of("bias")[0], 0.0f) << "a sensor has none";
  EXPECT_EQ(layout.lowest("time_constant"), 1.0);
  EXPECT_EQ(layout.lowest("bias"), -2.0);
}

TEST(Layout, KnowsTheLowestValueThatAnyCppnCanGive) {
  // Ranges and constants of two nodes, rising and falling: the least of what outputs of ±1 and beyond give.
  Stream stream(6, Purpose::test);
  for (int n = 0; n < 1000; ++n) {
    auto settings = substrate_of(line);
    for (auto& property : settings.properties) {
      property.low = stream.uniform(-5.0, 5.0);
      property.high = stream.uniform(-5.0, 5.0);
      property.value = stream.uniform(-5.0, 5.0);
    }
    const Layout layout(settings, ctrnn_needs(), hopper());
    for (const char* property : {"bias", "time_constant"}) {
      double lowest = INFINITY;
      for (const double o : {-1.0, 1.0, -7.0, 7.0}) {
        const auto decoded = layout.decode(linear_cppn({{0, 0, 0}, {o, 0, 0}, {o, 0, 0}}));
        for (const std::size_t neuron : {std::size_t{1}, std::size_t{2}})
          lowest = std::min(lowest, static_cast<double>(decoded.of(property)[neuron]));
      }
      ASSERT_NEAR(layout.lowest(property), lowest, 1e-6) << property << ' ' << n;
    }
  }
}

TEST(Layout, AsksForPatternsTickByTick) {
  const Layout layout(substrate_of(R"(
coordinates = ["x", "y"]
outputs = ["p", "o"]
nodes = [ { name = "k", group = "s", at = [0.25, -0.5], joint = "L_knee" } ]
properties = [
  { of = "s", property = "pattern", output = "p" },
  { of = "s", property = "offset", output = "o", zero = ["y"] },
]
)"),
                      supg_needs(4), hopper());
  EXPECT_EQ(layout.input_names(), (std::vector<std::string>{"x", "y", "time"}));
  const auto decoded = layout.decode(linear_cppn({{0, 1, 1, 1}, {0, 1, 1, 1}}));
  ASSERT_EQ(decoded.patterns.size(), 5u);
  for (std::size_t tick = 0; tick < 5; ++tick)
    EXPECT_FLOAT_EQ(decoded.patterns[tick], -0.25f + 0.25f * static_cast<float>(tick));
  EXPECT_FLOAT_EQ(decoded.of("offset")[0], 0.25f);
}

/// Whether two neurons with these entries for their time constants share them whatever the CPPN.
bool share_time_constant(const std::string& b, const std::string& c) {
  std::string text = line.substr(0, line.find("  { of = \"b\""));
  text.insert(text.find("]\nlinks"), "  { name = \"d\", group = \"neuron\", at = [0.75] },\n");
  text += R"(  { of = "d", property = "time_constant", output = "tau", low = 1, high = 2 },
  { of = "b", property = "time_constant", )" +
          b + R"( },
  { of = "c", property = "time_constant", )" +
          c + " },\n]\n";
  const Layout layout(substrate_of(text), ctrnn_needs(), hopper());
  EXPECT_EQ(layout.shared("time_constant", 1, 2), layout.shared("time_constant", 2, 1));
  return layout.shared("time_constant", 1, 2);
}

TEST(Layout, NodesShareAPropertyIfNoCppnCanGiveThemDifferentOnes) {
  const std::string one = R"(output = "tau", low = 1, high = 61, zero = ["x"])";
  EXPECT_TRUE(share_time_constant(one, one));
  EXPECT_FALSE(share_time_constant(one, R"(output = "tau", low = 1, high = 62, zero = ["x"])"));
  EXPECT_FALSE(share_time_constant(one, R"(output = "tau", low = 2, high = 61, zero = ["x"])"));
  EXPECT_FALSE(share_time_constant(one, R"(output = "bias", low = 1, high = 61, zero = ["x"])"));
  EXPECT_FALSE(share_time_constant(one, R"(output = "tau", low = 1, high = 61)"));
  EXPECT_FALSE(
      share_time_constant(R"(output = "tau", low = 1, high = 61)", R"(output = "tau", low = 1, high = 61)"))
      << "they lie at different places";
  EXPECT_TRUE(share_time_constant("value = 7", "value = 7"));
  EXPECT_FALSE(share_time_constant("value = 7", "value = 8"));
  EXPECT_FALSE(share_time_constant("value = 7", one));
}

TEST(Layout, LinksOnlyPairsThatAgreeInTheNamedCoordinates) {
  auto settings = part("ctrnn");
  settings.links = {{.from = "touch", .to = "hidden", .weight = "intra", .same = {"module_y"}}};
  settings.outputs = {"intra", "bias", "time_constant"};
  const Layout layout(settings, ctrnn_needs(), controllers::quadruped());
  ASSERT_EQ(layout.links().size(), 16u);
  for (const Link& link : layout.links())
    EXPECT_EQ(layout.nodes()[static_cast<std::size_t>(link.source)].at[3],
              layout.nodes()[static_cast<std::size_t>(link.target)].at[3]);
}

const std::string nodes_and_links = R"(
coordinates = ["x"]
outputs = ["weight", "bias"]
nodes = [
  { name = "clock", group = "in", at = [-1], sensor = "sine" },
  { name = "b", group = "neuron", at = [0.25] },
  { name = "c", group = "neuron", at = [0.5], joint = "L_knee" },
]
links = [ { from = "in", to = "neuron" } ]
properties = [
  { of = "neuron", property = "bias", output = "bias", low = -2, high = 6, zero = ["x"] },
  { of = "neuron", property = "time_constant", value = 7 },
]
)";

const std::string nodes_and_properties = R"(CPPN inputs   source.x, target.x
CPPN outputs  weight, bias

3 nodes (x)
  clock  in      (-1)  senses sine
  b      neuron  (0.25)
  c      neuron  (0.5)  drives L_knee

properties
  bias of neuron: -2 to 6 by output bias, queried with x = 0
  time_constant of neuron: 7
)";

TEST(Summary, NamesEveryNodePropertyAndLink) {
  const Settings settings = substrate_of(nodes_and_links);
  EXPECT_EQ(summary(settings, Layout(settings, ctrnn_needs(), hopper())), nodes_and_properties + R"(
2 links
      2  in -> neuron, by output weight

link by link
  clock  ->  b      weight
  clock  ->  c      weight
)");
}

TEST(Summary, HasNoListOfLinksWhereThereIsNone) {
  const Settings settings = substrate_of(
      "coordinates = ['x']\noutputs = ['pattern', 'offset']\n"
      "nodes = [ { name = 'a', at = [0.5], joint = 'L_knee' } ]\n"
      "properties = [ { of = 'a', property = 'pattern', output = 'pattern' },"
      " { of = 'a', property = 'offset', output = 'offset' } ]\n");
  const std::string text = summary(settings, Layout(settings, supg_needs(), hopper()));
  EXPECT_TRUE(text.ends_with("\n0 links\n")) << text;
}

}  // namespace

}  // namespace amble::substrate
