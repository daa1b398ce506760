#include "amble/cppn/network.hpp"

#include <gtest/gtest.h>

#include <thread>

#include "amble/core/random.hpp"
#include "tests/cppn/plain_twin.hpp"
#include "tests/cppn/random_genome.hpp"
#include "tests/cppn/targets.hpp"

namespace amble::cppn {
namespace {

using neat::Activation;
using neat::NodeKind;

constexpr Settings recurrent{Linear::absolute, true}, feed_forward{Linear::absolute, false};

/// Bias 0, inputs 1 and 2, output 3, hidden 4 and 5.
neat::Genome small_genome(Activation output, Activation first, Activation second) {
  return {{{0, NodeKind::bias, Activation::linear},
           {1, NodeKind::input, Activation::linear},
           {2, NodeKind::input, Activation::linear},
           {3, NodeKind::output, output},
           {4, NodeKind::hidden, first},
           {5, NodeKind::hidden, second}},
          {}};
}

Points random_points(int inputs, int count, Stream& stream) {
  Points points(inputs, count);
  for (int p = 0; p < count; ++p)
    for (int i = 0; i < inputs; ++i) points.set(p, i, static_cast<float>(stream.uniform(-1.0, 1.0)));
  return points;
}

std::vector<float> evaluate(const Network& network, const Points& points) {
  std::vector<float> results(static_cast<std::size_t>(network.outputs()) *
                             static_cast<std::size_t>(points.capacity()));
  network.evaluate(points, results);
  return results;
}

float evaluate_one(const neat::Genome& genome, const Settings& settings, std::vector<float> inputs) {
  Points points(static_cast<int>(inputs.size()), 1);
  for (std::size_t i = 0; i < inputs.size(); ++i) points.set(0, static_cast<int>(i), inputs[i]);
  return evaluate(Network(genome, settings), points)[0];
}

void expect_same_as_plain(const neat::Genome& genome, const Settings& settings, int passes,
                          const Points& points) {
  const Network network(genome, settings);
  const std::vector<float> results = evaluate(network, points);
  for (int p = 0; p < points.count(); ++p) {
    std::vector<float> inputs;
    for (int i = 0; i < points.inputs(); ++i) inputs.push_back(points.get(p, i));
    const std::vector<float> expected = plain::evaluate(genome, settings.linear, inputs, passes);
    for (std::size_t output = 0; output < expected.size(); ++output) {
      const float value =
          results[output * static_cast<std::size_t>(points.capacity()) + static_cast<std::size_t>(p)];
      ASSERT_EQ(plain::bits(value), plain::bits(expected[output])) << "point " << p << ", output " << output;
    }
  }
}

TEST(Points, ArePaddedToWholeBlocks) {
  EXPECT_EQ(Points(3, 0).capacity(), 0);
  EXPECT_EQ(Points(3, 1).capacity(), Points::block);
  EXPECT_EQ(Points(3, Points::block).capacity(), Points::block);
  EXPECT_EQ(Points(3, Points::block + 1).capacity(), 2 * Points::block);
}

TEST(Points, StoreInputByInput) {
  Points points(2, 70);
  points.set(69, 1, 0.5f);
  EXPECT_EQ(points.get(69, 1), 0.5f);
  EXPECT_EQ(points.input(1)[69], 0.5f);
  EXPECT_EQ(points.get(69, 0), 0.0f);
}

TEST(PointsDeathTest, RefuseWhatIsNotACoordinate) {
  Points points(2, 3);
  EXPECT_DEATH(points.set(3, 0, 0.0f), "no such query point");
  EXPECT_DEATH(points.set(0, 0, std::numeric_limits<float>::quiet_NaN()), "out of range");
  EXPECT_DEATH(points.set(0, 0, std::numeric_limits<float>::infinity()), "out of range");
}

TEST(Network, ComputesAHandWorkedExample) {
  // hidden 4 = |2 a − b + 0.5|, output = |−4 hidden + 0.25 b|: with a = 1, b = 0.5 that is |−8 + 0.125|.
  neat::Genome genome = small_genome(Activation::linear, Activation::linear, Activation::linear);
  genome.links = {{0, 1, 4, 2.0}, {1, 2, 4, -1.0}, {2, 0, 4, 0.5}, {3, 4, 3, -4.0}, {4, 2, 3, 0.25}};
  EXPECT_EQ(evaluate_one(genome, feed_forward, {1.0f, 0.5f}), 7.875f);
  EXPECT_EQ(evaluate_one(genome, recurrent, {1.0f, 0.5f}), 7.875f);
  EXPECT_EQ(evaluate_one(genome, Settings{Linear::identity, true}, {1.0f, 0.5f}), -7.875f);
}

constexpr Settings shorter{Linear::absolute, true, Passes::twice_hidden_plus_1};

TEST(Network, RunsACycleAsManyPassesAsTheSettingSays) {
  // Output = |output + input| grows by the input in each pass. Two idle hidden nodes make it 7 or 5 passes,
  // none make it 3 or 1.
  neat::Genome genome = small_genome(Activation::linear, Activation::sine, Activation::sine);
  genome.links = {{0, 1, 3, 1.0}, {1, 3, 3, 1.0}};
  EXPECT_TRUE(Network(genome, recurrent).cyclic());
  EXPECT_EQ(evaluate_one(genome, recurrent, {0.5f, 0.0f}), 3.5f);
  EXPECT_EQ(evaluate_one(genome, shorter, {0.5f, 0.0f}), 2.5f);
  genome.nodes.resize(4);
  EXPECT_EQ(evaluate_one(genome, recurrent, {0.5f, 0.0f}), 1.5f);
  EXPECT_EQ(evaluate_one(genome, shorter, {0.5f, 0.0f}), 0.5f);
}

TEST(Network, NeedsNoSetNumberOfPassesWhereTheHiddenNodesFormNoCycle) {
  neat::Genome genome = small_genome(Activation::sine, Activation::gaussian, Activation::bipolar_sigmoid);
  genome.links = {{0, 1, 4, 0.7}, {1, 4, 5, -0.9}, {2, 5, 3, 1.1}, {3, 2, 3, 0.4}};
  EXPECT_EQ(plain::bits(evaluate_one(genome, recurrent, {0.5f, 0.3f})),
            plain::bits(evaluate_one(genome, shorter, {0.5f, 0.3f})));
}

TEST(Network, IgnoresDisabledLinks) {
  neat::Genome genome = small_genome(Activation::linear, Activation::linear, Activation::linear);
  genome.links = {{0, 1, 3, 1.0}, {1, 2, 3, 5.0, false}, {2, 3, 3, 1.0, false}};
  const Network network(genome, recurrent);
  EXPECT_FALSE(network.cyclic());
  EXPECT_EQ(evaluate_one(genome, recurrent, {0.5f, 7.0f}), 0.5f);
}

TEST(Network, IsCyclicOnlyIfAnOutputDependsOnTheCycle) {
  neat::Genome genome = small_genome(Activation::linear, Activation::linear, Activation::linear);
  genome.links = {{0, 1, 3, 1.0}, {1, 4, 5, 1.0}, {2, 5, 4, 1.0}};
  EXPECT_FALSE(Network(genome, recurrent).cyclic());
  genome.links.push_back({3, 5, 3, 1.0});
  EXPECT_TRUE(Network(genome, recurrent).cyclic());
}

TEST(Network, GivesAnOutputWithoutLinksItsFunctionOfZero) {
  EXPECT_EQ(evaluate_one(small_genome(Activation::gaussian, Activation::sine, Activation::sine), recurrent,
                         {1.0f, 1.0f}),
            1.0f);
  EXPECT_EQ(evaluate_one(small_genome(Activation::sine, Activation::sine, Activation::sine), recurrent,
                         {1.0f, 1.0f}),
            0.0f);
}

TEST(Network, AddsLinksInOrderOfInnovation) {
  // (2^24 + 1) − 2^24 is 0 in single precision, (2^24 − 2^24) + 1 is 1.
  neat::Genome genome = small_genome(Activation::linear, Activation::linear, Activation::linear);
  genome.links = {{0, 1, 3, 0x1p24}, {1, 0, 3, 1.0}, {2, 2, 3, -0x1p24}};
  EXPECT_EQ(evaluate_one(genome, recurrent, {1.0f, 1.0f}), 0.0f);
  genome.links = {{0, 1, 3, 0x1p24}, {1, 2, 3, -0x1p24}, {2, 0, 3, 1.0}};
  EXPECT_EQ(evaluate_one(genome, recurrent, {1.0f, 1.0f}), 1.0f);
}

TEST(Network, EqualsSynchronousPassesForThousandsOfGenomesWithoutCycles) {
  Stream stream(11, Purpose::test);
  const Points points = random_points(3, 4, stream);
  for (int i = 0; i < 3000; ++i) {
    GenomeShape shape{3, 2, static_cast<int>(stream.below(12)), static_cast<int>(stream.below(80)), false};
    const neat::Genome genome = random_genome(shape, stream);
    ASSERT_FALSE(Network(genome, recurrent).cyclic());
    ASSERT_NO_FATAL_FAILURE(
        expect_same_as_plain(genome, recurrent, plain::recurrent_passes(genome, recurrent.passes), points))
        << i;
    const int enough = static_cast<int>(genome.nodes.size());
    ASSERT_NO_FATAL_FAILURE(expect_same_as_plain(genome, feed_forward, enough, points)) << i;
  }
}

TEST(Network, EqualsSynchronousPassesForThousandsOfGenomesWithCycles) {
  Stream stream(12, Purpose::test);
  const Points points = random_points(3, 2, stream);
  int cyclic = 0;
  for (int i = 0; i < 3000; ++i) {
    GenomeShape shape{3, 2, static_cast<int>(stream.below(12)), static_cast<int>(stream.below(60)), true};
    const neat::Genome genome = random_genome(shape, stream);
    for (const Passes passes : {Passes::twice_hidden_plus_1, Passes::twice_hidden_plus_3}) {
      const Settings settings{i % 2 == 0 ? Linear::absolute : Linear::identity, true, passes};
      ASSERT_NO_FATAL_FAILURE(
          expect_same_as_plain(genome, settings, plain::recurrent_passes(genome, passes), points))
          << i;
    }
    cyclic += Network(genome, recurrent).cyclic();
  }
  EXPECT_GT(cyclic, 1000);
}

TEST(Network, CutsChainsOfOutputsOffLikeThePasses) {
  // Without hidden nodes there are three passes or one; in the first, an output still sees the others as 0.
  Stream stream(13, Purpose::test);
  const Points points = random_points(2, 3, stream);
  int cut_off = 0, cut_off_later = 0;
  for (int i = 0; i < 500; ++i) {
    const GenomeShape shape{2, 6, static_cast<int>(stream.below(3)), 40, false};
    const neat::Genome genome = random_genome(shape, stream);
    for (const Settings& settings : {recurrent, shorter}) {
      const int passes = plain::recurrent_passes(genome, settings.passes);
      ASSERT_NO_FATAL_FAILURE(expect_same_as_plain(genome, settings, passes, points)) << i;
    }
    ASSERT_NO_FATAL_FAILURE(expect_same_as_plain(genome, feed_forward, 10, points)) << i;
    const std::vector<float> settled = evaluate(Network(genome, feed_forward), points);
    cut_off += evaluate(Network(genome, shorter), points) != settled;
    cut_off_later += evaluate(Network(genome, recurrent), points) != settled;
  }
  EXPECT_GT(cut_off_later, 10);
  EXPECT_GT(cut_off, cut_off_later);
}

TEST(Network, GivesTheSameBitsOnEveryInstructionSet) {
  Stream stream(14, Purpose::test);
  const Points points = random_points(3, 200, stream);
  for (int i = 0; i < 60; ++i) {
    GenomeShape shape;
    shape.cycles = i % 2 == 0;
    shape.weight_limit = 3.0;
    const neat::Genome genome = random_genome(shape, stream);
    for_each_target([&] {
      ASSERT_NO_FATAL_FAILURE(
          expect_same_as_plain(genome, recurrent, plain::recurrent_passes(genome, recurrent.passes), points))
          << i;
    });
  }
}

TEST(Network, StaysFiniteWhenValuesGrowWithoutBound) {
  Stream stream(15, Purpose::test);
  const Points points = random_points(3, 8, stream);
  bool clamped = false;
  for (int i = 0; i < 300; ++i) {
    GenomeShape shape{3, 2, 20, 150, true, 1e9};
    neat::Genome genome = random_genome(shape, stream);
    if (i % 2 == 0)
      for (neat::NodeGene& node : genome.nodes) node.activation = Activation::linear;
    const Network network(genome, {i % 4 < 2 ? Linear::absolute : Linear::identity, true});
    const std::vector<float> results = evaluate(network, points);
    for (const float value : results) {
      ASSERT_TRUE(std::isfinite(value));
      clamped |= std::fabs(value) == 0x1p64f;
    }
  }
  EXPECT_TRUE(clamped);
}

TEST(Network, TakesAHugeWeightOfEitherSignAsTwoToThePowerOf32) {
  neat::Genome genome = small_genome(Activation::linear, Activation::linear, Activation::linear);
  const Settings identity{Linear::identity, true};
  for (const double sign : {-1.0, 1.0})
    for (const double weight : {0x1p32, 0x1p33, 1e300}) {
      genome.links = {{0, 1, 4, sign * weight}, {1, 4, 3, 0.25}};
      EXPECT_EQ(evaluate_one(genome, identity, {0.5f, 0.0f}), static_cast<float>(sign * 0x1p29)) << weight;
    }
}

TEST(Network, GivesAPointTheSameValueWhereverItStands) {
  Stream stream(16, Purpose::test);
  const neat::Genome genome = random_genome({}, stream);
  const Network network(genome, recurrent);
  const Points many = random_points(3, 300, stream);
  const std::vector<float> together = evaluate(network, many);
  for (int p = 0; p < many.count(); p += 7) {
    Points one(3, 1);
    for (int i = 0; i < 3; ++i) one.set(0, i, many.get(p, i));
    ASSERT_EQ(plain::bits(evaluate(network, one)[0]), plain::bits(together[static_cast<std::size_t>(p)]));
  }
}

TEST(Network, IsSharedByThreads) {
  Stream stream(17, Purpose::test);
  const Network network(random_genome({}, stream), recurrent);
  const Points points = random_points(3, 500, stream);
  const std::vector<float> expected = evaluate(network, points);
  std::vector<std::vector<float>> results(4);
  std::vector<std::thread> threads;
  for (std::vector<float>& mine : results)
    threads.emplace_back([&network, &points, &mine] {
      for (int i = 0; i < 20; ++i) mine = evaluate(network, points);
    });
  for (std::thread& thread : threads) thread.join();
  for (const std::vector<float>& mine : results) EXPECT_EQ(mine, expected);
}

TEST(NetworkDeathTest, RefusesAGenomeItCannotRun) {
  neat::Genome genome = small_genome(Activation::linear, Activation::linear, Activation::linear);
  genome.links = {{0, 3, 3, 1.0}};
  EXPECT_DEATH(Network(genome, feed_forward), "feed-forward CPPN has a cycle");
  genome.links = {{0, 1, 3, std::numeric_limits<double>::quiet_NaN()}};
  EXPECT_DEATH(Network(genome, recurrent), "weight is not finite");
  genome.links = {{0, 1, 9, 1.0}};
  EXPECT_DEATH(Network(genome, recurrent), "a link names a node");
}

TEST(NetworkDeathTest, RefusesPointsOrResultsOfAnotherSize) {
  const Network network(small_genome(Activation::linear, Activation::linear, Activation::linear), recurrent);
  std::vector<float> results(64);
  EXPECT_DEATH(network.evaluate(Points(3, 1), results), "another number of inputs");
  EXPECT_DEATH(network.evaluate(Points(2, 65), results), "another size");
}

}  // namespace
}  // namespace amble::cppn
