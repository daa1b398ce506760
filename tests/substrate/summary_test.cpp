#include "amble/substrate/summary.hpp"

#include <gtest/gtest.h>

#include "tests/substrate/fixture.hpp"

namespace amble::substrate {
namespace {

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
