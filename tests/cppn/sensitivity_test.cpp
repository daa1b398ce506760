#include "amble/cppn/sensitivity.hpp"

#include <gtest/gtest.h>

#include "tests/cppn/random_genome.hpp"

namespace amble::cppn {
namespace {

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
