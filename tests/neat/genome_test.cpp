#include "amble/neat/genome.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <ostream>

#include "amble/core/error.hpp"
#include "tests/neat/samples.hpp"

namespace amble::neat {
namespace genome_test {

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

Genome good() {
  return sample_genome(
      2, 1, {{7, NodeKind::hidden, Activation::sine}, {9, NodeKind::hidden, Activation::gaussian}},
      {{0, 0, 3, 0.5, true}, {2, 1, 7, -1.0, true}, {5, 7, 9, 1.0, true}, {6, 9, 3, 1.0, true}});
}

struct Defect {
  const char* name;
  void (*make)(Genome&);
  const char* message;
  friend std::ostream& operator<<(std::ostream& out, const Defect& defect) { return out << defect.name; }
};

class Validate : public testing::TestWithParam<Defect> {};

TEST_P(Validate, RefusesWithTheReason) {
  Genome genome = good();
  GetParam().make(genome);
  EXPECT_EQ(error_of([&] { validate(genome, 2, 1, false); }), GetParam().message);
}

INSTANTIATE_TEST_SUITE_P(
    Defects, Validate,
    testing::Values(
        Defect{"TooFewNodes", [](Genome& g) { g.nodes.resize(3); },
               "genome: 3 nodes, expected at least 4: bias, 2 inputs, 1 outputs"},
        Defect{"OutputInPlaceOfInput", [](Genome& g) { g.nodes[2].kind = NodeKind::output; },
               "genome: node 2 of the list must be of kind input"},
        Defect{"HiddenNodeCalledOutput", [](Genome& g) { g.nodes[4].kind = NodeKind::output; },
               "genome: node 4 of the list must be of kind hidden"},
        Defect{"IdThatIsNotItsIndex", [](Genome& g) { g.nodes[3].id = 4; },
               "genome: node 3 of the list has id 4, expected 3"},
        Defect{"HiddenIdsThatFall", [](Genome& g) { std::swap(g.nodes[4], g.nodes[5]); },
               "genome: hidden node 7 is out of order: ids must rise from at least 4"},
        Defect{"HiddenIdOfAnOutput", [](Genome& g) { g.nodes[4].id = 3; },
               "genome: hidden node 3 is out of order: ids must rise from at least 4"},
        Defect{"UnknownActivation", [](Genome& g) { g.nodes[4].activation = static_cast<Activation>(4); },
               "genome: node 7 has an unknown activation function"},
        Defect{"InputWithAnActivation", [](Genome& g) { g.nodes[1].activation = Activation::sine; },
               "genome: node 1 must have the activation linear, as bias and inputs do"},
        Defect{"LinksOutOfOrder", [](Genome& g) { g.links[1].innovation = 0; },
               "genome: link 0 is out of order: innovation numbers must rise"},
        Defect{"UnknownNode", [](Genome& g) { g.links[1].from = 8; },
               "genome: link 2 names node 8, which is not there"},
        Defect{"LinkIntoAnInput", [](Genome& g) { g.links[1].to = 2; },
               "genome: link 2 leads into node 2, which is the bias or an input"},
        Defect{"LinkIntoTheBias", [](Genome& g) { g.links[1].to = 0; },
               "genome: link 2 leads into node 0, which is the bias or an input"},
        Defect{"NotANumber", [](Genome& g) { g.links[2].weight = std::nan(""); },
               "genome: link 5 has a weight that is not finite"},
        Defect{"Infinite", [](Genome& g) { g.links[2].weight = -std::numeric_limits<double>::infinity(); },
               "genome: link 5 has a weight that is not finite"},
        Defect{"DoubleLink", [](Genome& g) { g.links[3].from = 7, g.links[3].to = 9; },
               "genome: link 6 joins nodes 7 and 9 a second time"},
        Defect{"Cycle",
               [](Genome& g) {
                 g.links.push_back({8, 9, 7, 0.1, true});
               },
               "genome: link 8 from node 9 to node 7 closes a cycle, but the network must be feed-forward"},
        Defect{"DisabledCycle",
               [](Genome& g) {
                 g.links.push_back({8, 3, 7, 0.1, false});
               },
               "genome: link 8 from node 3 to node 7 closes a cycle, but the network must be feed-forward"}),
    [](const auto& defect) { return std::string(defect.param.name); });

TEST(Validate, AcceptsAGoodGenome) {
  EXPECT_EQ(error_of([] { validate(good(), 2, 1, false); }), "");
  EXPECT_EQ(error_of([] { validate(sample_genome(0, 1, {}, {}), 0, 1, false); }), "");
}

TEST(Validate, AcceptsCyclesWhereNetworksAreRecurrent) {
  Genome genome = good();
  genome.links.push_back({8, 9, 7, 0.1, true});
  genome.links.push_back({9, 3, 3, 0.1, true});
  EXPECT_EQ(error_of([&] { validate(genome, 2, 1, true); }), "");
}

TEST(Validate, RefusesAnotherNumberOfInputsOrOutputs) {
  EXPECT_NE(error_of([] { validate(good(), 1, 1, false); }), "");
  EXPECT_NE(error_of([] { validate(good(), 2, 2, false); }), "");
}

TEST(Validate, CallsItABadFile) {
  try {
    validate(good(), 3, 1, false);
    FAIL();
  } catch (const UserError& error) {
    EXPECT_EQ(error.code(), ExitCode::bad_file);
  }
}

TEST(Validate, DrawsTheBordersBetweenKindsOfNodesWhereTheyAre) {
  for (std::size_t node = 0; node < good().nodes.size(); ++node)
    for (const NodeKind kind : {NodeKind::bias, NodeKind::input, NodeKind::output, NodeKind::hidden}) {
      Genome genome = good();
      const bool same = genome.nodes[node].kind == kind;
      genome.nodes[node].kind = kind;
      EXPECT_EQ(error_of([&] { validate(genome, 2, 1, false); }).empty(), same) << node;
    }
  for (std::size_t node = 0; node < 4; ++node) {
    Genome genome = good();
    ++genome.nodes[node].id;
    EXPECT_NE(error_of([&] { validate(genome, 2, 1, false); }).find("expected"), std::string::npos) << node;
  }
  for (const std::size_t node : {0u, 1u, 2u}) {
    Genome genome = good();
    genome.nodes[node].activation = Activation::gaussian;
    EXPECT_NE(error_of([&] { validate(genome, 2, 1, false); }), "") << node;
  }
  Genome genome = good();
  genome.nodes[3].activation = Activation::gaussian;
  EXPECT_EQ(error_of([&] { validate(genome, 2, 1, false); }), "") << "outputs may have any function";
  genome.nodes[4].id = 4;
  genome.links[1].to = genome.links[2].from = 4;
  EXPECT_EQ(error_of([&] { validate(genome, 2, 1, false); }), "") << "the first hidden id";
  genome.nodes[5].id = 4;
  EXPECT_NE(error_of([&] { validate(genome, 2, 1, false); }).find("out of order"), std::string::npos);
  genome = good();
  genome.links[1].innovation = genome.links[2].innovation;
  EXPECT_NE(error_of([&] { validate(genome, 2, 1, false); }).find("out of order"), std::string::npos);
}

}  // namespace genome_test

}  // namespace amble::neat
