#include "amble/cppn/reference.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "amble/cppn/network.hpp"
#include "tests/cppn/random_genome.hpp"

namespace amble::cppn {
namespace {

TEST(Reference, ComputesAHandWorkedExample) {
  using neat::Activation;
  using neat::NodeKind;
  const neat::Genome genome{{{0, NodeKind::bias, Activation::linear},
                             {1, NodeKind::input, Activation::linear},
                             {2, NodeKind::output, Activation::bipolar_sigmoid},
                             {3, NodeKind::hidden, Activation::gaussian},
                             {4, NodeKind::hidden, Activation::sine}},
                            {{0, 1, 3, 0.5}, {1, 0, 4, 0.3}, {2, 3, 2, 2.0}, {3, 4, 2, -1.0}}};
  const double gaussian = 2.0 * std::exp(-6.25 * 0.2 * 0.2) - 1.0;
  const double expected = std::tanh((2.0 * gaussian - std::sin(0.6)) / 2.0);
  double output = 0.0;
  Reference(genome, {}).evaluate(std::array{0.4}, {&output, 1});
  EXPECT_NEAR(output, expected, 1e-15);
}

/// Largest difference between Network and Reference over random points and all outputs.
double largest_difference(const neat::Genome& genome, const Settings& settings, Stream& stream) {
  const Network network(genome, settings);
  const Reference reference(genome, settings);
  Points points(network.inputs(), 10);
  for (int p = 0; p < points.count(); ++p)
    for (int i = 0; i < points.inputs(); ++i) points.set(p, i, static_cast<float>(stream.uniform(-1.0, 1.0)));
  const auto outputs = static_cast<std::size_t>(network.outputs()),
             capacity = static_cast<std::size_t>(points.capacity());
  std::vector<float> results(outputs * capacity);
  network.evaluate(points, results);

  double largest = 0.0;
  for (int p = 0; p < points.count(); ++p) {
    std::vector<double> inputs, expected(outputs);
    for (int i = 0; i < points.inputs(); ++i) inputs.push_back(static_cast<double>(points.get(p, i)));
    reference.evaluate(inputs, expected);
    for (std::size_t o = 0; o < outputs; ++o)
      largest = std::max(
          largest,
          std::fabs(static_cast<double>(results[o * capacity + static_cast<std::size_t>(p)]) - expected[o]));
  }
  return largest;
}

TEST(Reference, AgreesWithTheNetworkWithoutCycles) {
  Stream stream(21, Purpose::test);
  for (int i = 0; i < 500; ++i) {
    const GenomeShape shape{3, 2, 7, 40, false};
    const neat::Genome genome = random_genome(shape, stream);
    ASSERT_LT(largest_difference(genome, {Linear::absolute, false}, stream), 1e-3) << i;
  }
}

TEST(Reference, AgreesWithTheNetworkWithCyclesOfFewPasses) {
  // Few hidden nodes and small weights: errors of single precision do not grow much in 2 × 3 + 3 passes.
  Stream stream(22, Purpose::test);
  for (int i = 0; i < 500; ++i) {
    const GenomeShape shape{3, 2, 3, 20, true, 0.5};
    const neat::Genome genome = random_genome(shape, stream);
    for (const Passes passes : {Passes::twice_hidden_plus_1, Passes::twice_hidden_plus_3})
      ASSERT_LT(largest_difference(genome, {Linear::absolute, true, passes}, stream), 1e-4) << i;
  }
}

TEST(Reference, AgreesWithTheNetworkWhereAChainOfOutputsIsLongerThanItsPasses) {
  using neat::Activation;
  using neat::NodeKind;
  neat::Genome chain{{{0, NodeKind::bias, Activation::linear}, {1, NodeKind::input, Activation::linear}}, {}};
  for (std::uint32_t id = 2; id < 6; ++id) {
    chain.nodes.push_back({id, NodeKind::output, Activation::sine});
    chain.links.push_back({id - 2, id - 1, id, 0.7});
  }
  Stream stream(34, Purpose::test);
  for (const Passes passes : {Passes::twice_hidden_plus_1, Passes::twice_hidden_plus_3})
    EXPECT_LT(largest_difference(chain, {Linear::absolute, true, passes}, stream), 1e-5);
}

Points random_points(int inputs, Stream& stream) {
  Points points(inputs, 100);
  for (int p = 0; p < points.count(); ++p)
    for (int i = 0; i < inputs; ++i) points.set(p, i, static_cast<float>(stream.uniform(-1.0, 1.0)));
  return points;
}

TEST(PrecisionSensitivity, IsThatOfRoundingWithoutCycles) {
  Stream stream(31, Purpose::test);
  for (int i = 0; i < 200; ++i) {
    const neat::Genome genome = random_genome({3, 2, 5, 20, false}, stream);
    const double largest = precision_sensitivity(genome, {Linear::absolute, false}, random_points(3, stream));
    EXPECT_GE(largest, 0.0);
    EXPECT_LT(largest, 1e-3) << i;
  }
}

/// x → a sin(2 x) + x₀, again and again: with a = 1.5 a chaotic map, whose errors grow with every pass.
neat::Genome iterated_sine(double weight, int hidden_nodes) {
  using neat::Activation;
  using neat::NodeKind;
  neat::Genome genome{{{0, NodeKind::bias, Activation::linear},
                       {1, NodeKind::input, Activation::linear},
                       {2, NodeKind::output, Activation::sine}},
                      {{0, 1, 2, 1.0}, {1, 2, 2, weight}}};
  // Nodes that do nothing but make passes.
  for (int i = 0; i < hidden_nodes; ++i)
    genome.nodes.push_back({static_cast<std::uint32_t>(3 + i), NodeKind::hidden, Activation::linear});
  return genome;
}

TEST(PrecisionSensitivity, IsLargeOfAChaoticCycleAndSmallOfATameOne) {
  Stream stream(32, Purpose::test);
  const Points points = random_points(1, stream);
  const Settings settings{Linear::absolute, true};
  EXPECT_LT(precision_sensitivity(iterated_sine(0.2, 30), settings, points), 1e-5) << "it forgets its errors";
  EXPECT_LT(precision_sensitivity(iterated_sine(3.0, 0), settings, points), 1e-3) << "three passes";
  const double chaotic = precision_sensitivity(iterated_sine(3.0, 30), settings, points);
  EXPECT_GT(chaotic, 0.5);
  EXPECT_LE(chaotic, 2.0);
}

TEST(PrecisionSensitivity, LooksAtEveryPointAndOutput) {
  Stream stream(33, Purpose::test);
  const Settings settings{Linear::absolute, true};
  const neat::Genome chaotic = iterated_sine(3.0, 30);
  Points points(1, 70);
  EXPECT_LT(precision_sensitivity(chaotic, settings, points), 1e-6) << "0 stays 0 in any precision";
  points.set(69, 0, 0.3f);
  EXPECT_GT(precision_sensitivity(chaotic, settings, points), 0.01) << "the last one, beyond a block";
}

TEST(PrecisionSensitivity, IsOfOutputsAsSubstratesClampThem) {
  // A linear output of a large number differs by its rounding, beyond what is used of it.
  const neat::Genome genome{{{0, neat::NodeKind::bias, neat::Activation::linear},
                             {1, neat::NodeKind::input, neat::Activation::linear},
                             {2, neat::NodeKind::output, neat::Activation::linear}},
                            {{0, 1, 2, 123456789.123456789}}};
  Points points(1, 1);
  points.set(0, 0, 1.0f);
  EXPECT_EQ(precision_sensitivity(genome, {Linear::absolute, false}, points), 0.0);
}

}  // namespace

}  // namespace amble::cppn
