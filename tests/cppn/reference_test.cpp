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

}  // namespace
}  // namespace amble::cppn
