#include "amble/neat/crossover.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/neat/samples.hpp"

namespace amble::neat {
namespace {

const NodeGene hidden_4{4, NodeKind::hidden, Activation::sine},
    hidden_5{5, NodeKind::hidden, Activation::gaussian};

/// Both have links 0 and 1; 2 and 3 (node 4) are the first's, 4 and 5 (node 5) the second's.
Genome first() {
  return sample_genome(
      2, 1, {hidden_4},
      {{0, 0, 3, 0.1, true}, {1, 1, 3, 0.1, true}, {2, 1, 4, 0.1, true}, {3, 4, 3, 0.1, true}});
}
Genome second() {
  return sample_genome(
      2, 1, {hidden_5},
      {{0, 0, 3, 0.9, true}, {1, 1, 3, 0.9, true}, {4, 2, 5, 0.9, true}, {5, 5, 3, 0.9, true}});
}

std::vector<std::uint32_t> numbers(const Genome& genome) {
  std::vector<std::uint32_t> result;
  for (const LinkGene& link : genome.links) result.push_back(link.innovation);
  return result;
}

TEST(Crossover, GivesTheStructureOfTheFitterIfTheWeakersGenesAreLeftOut) {
  Stream stream(101, Purpose::test);
  CrossoverSettings settings;
  settings.weaker_genes_probability = 0.0;
  int from_first = 0;
  const int count = 10000;
  for (int i = 0; i < count; ++i) {
    const Genome child = crossover(first(), second(), settings, true, stream);
    ASSERT_EQ(numbers(child), (std::vector<std::uint32_t>{0, 1, 2, 3}));
    ASSERT_EQ(child.nodes, first().nodes) << "node 5 came with links that were not inherited";
    ASSERT_EQ(child.links[2], first().links[2]);
    ASSERT_EQ(child.links[3], first().links[3]);
    for (std::size_t g = 0; g < 2; ++g) {
      ASSERT_TRUE(child.links[g].weight == 0.1 || child.links[g].weight == 0.9);
      from_first += child.links[g].weight == 0.1;
    }
  }
  EXPECT_NEAR(from_first, count, 5 * std::sqrt(count / 2.0)) << "half of two matching genes each";
}

TEST(Crossover, InheritsTheWeakersGenesAllOrNone) {
  Stream stream(102, Purpose::test);
  int all = 0;
  const int count = 20000;
  for (int i = 0; i < count; ++i) {
    const Genome child = crossover(first(), second(), {}, true, stream);
    if (child.links.size() == 4) continue;
    ASSERT_EQ(numbers(child), (std::vector<std::uint32_t>{0, 1, 2, 3, 4, 5}));
    ASSERT_EQ(child.nodes, sample_genome(2, 1, {hidden_4, hidden_5}, {}).nodes);
    ASSERT_EQ(child.links[4], second().links[2]);
    ++all;
  }
  EXPECT_NEAR(all, 0.1 * count, 5 * std::sqrt(0.09 * count));
}

TEST(Crossover, InheritsTheWeakersGenesOneByOne) {
  Stream stream(103, Purpose::test);
  CrossoverSettings settings;
  settings.weaker_genes = WeakerGenes::one_by_one;
  settings.weaker_genes_probability = 0.3;
  int four = 0, five = 0, both = 0;
  const int count = 20000;
  for (int i = 0; i < count; ++i) {
    const Genome child = crossover(first(), second(), settings, true, stream);
    bool has_4 = false, has_5 = false;
    for (const LinkGene& link : child.links) {
      has_4 = has_4 || link.innovation == 4;
      has_5 = has_5 || link.innovation == 5;
    }
    ASSERT_EQ(child.index_of(5) >= 0, has_4 || has_5);
    four += has_4;
    five += has_5;
    both += has_4 && has_5;
  }
  EXPECT_NEAR(four, 0.3 * count, 5 * std::sqrt(0.21 * count));
  EXPECT_NEAR(five, 0.3 * count, 5 * std::sqrt(0.21 * count));
  EXPECT_NEAR(both, 0.09 * count, 5 * std::sqrt(0.09 * 0.91 * count));
}

TEST(Crossover, EnablesALinkDisabledInEitherParentAQuarterOfTheTime) {
  Stream stream(104, Purpose::test);
  Genome one = first(), two = second();
  one.links[0].enabled = false;  // disabled in the fitter
  two.links[1].enabled = false;  // disabled in the weaker
  one.links[2].enabled = false;  // the fitter's alone
  std::array<int, 4> enabled{};
  const int count = 20000;
  for (int i = 0; i < count; ++i) {
    const Genome child = crossover(one, two, {}, true, stream);
    for (std::size_t g = 0; g < 4; ++g) enabled[g] += child.links[g].enabled;
  }
  for (std::size_t g = 0; g < 3; ++g)
    EXPECT_NEAR(enabled[g], 0.25 * count, 5 * std::sqrt(0.1875 * count)) << g;
  EXPECT_EQ(enabled[3], count);
}

TEST(Crossover, LeavesOutTheWeakersLinkThatWouldCloseACycle) {
  // Outputs 2 and 3. The fitter has 2 → 3, the weaker 3 → 2: each acyclic, together not.
  const Genome fitter = sample_genome(1, 2, {}, {{0, 0, 2, 0.1, true}, {5, 2, 3, 0.1, true}});
  const Genome weaker =
      sample_genome(1, 2, {}, {{0, 0, 2, 0.9, true}, {6, 3, 2, 0.9, true}, {7, 1, 3, 0.9, true}});
  CrossoverSettings settings;
  settings.weaker_genes_probability = 1.0;
  Stream stream(105, Purpose::test);
  EXPECT_EQ(numbers(crossover(fitter, weaker, settings, false, stream)),
            (std::vector<std::uint32_t>{0, 5, 7}));
  EXPECT_EQ(numbers(crossover(weaker, fitter, settings, false, stream)),
            (std::vector<std::uint32_t>{0, 6, 7}))
      << "the fitter's link stays, although the other is older";
  EXPECT_EQ(numbers(crossover(fitter, weaker, settings, true, stream)),
            (std::vector<std::uint32_t>{0, 5, 6, 7}));
}

TEST(Crossover, LeavesOutALinkThatClosesACycleThroughOtherLinksOfTheWeaker) {
  // The fitter's 2 → 4 and the weaker's 4 → 3 and 3 → 2: the second of the two, in order of innovation, is
  // left out.
  const Genome fitter = sample_genome(1, 2, {hidden_4}, {{0, 2, 4, 0.1, true}, {1, 1, 4, 0.1, true}});
  const Genome weaker = sample_genome(1, 2, {hidden_4}, {{2, 4, 3, 0.9, true}, {3, 3, 2, 0.9, true}});
  CrossoverSettings settings;
  settings.weaker_genes_probability = 1.0;
  Stream stream(106, Purpose::test);
  const Genome child = crossover(fitter, weaker, settings, false, stream);
  EXPECT_EQ(numbers(child), (std::vector<std::uint32_t>{0, 1, 2}));
  EXPECT_NO_THROW(validate(child, 1, 2, false));
}

TEST(Crossover, OfAGenomeWithItselfIsItself) {
  Stream stream(107, Purpose::test);
  Innovations innovations(3, 2);
  for (int i = 0; i < 100; ++i) {
    const Genome genome = grown_genome(3, 2, i, true, innovations, stream);
    ASSERT_EQ(crossover(genome, genome, {}, true, stream), genome);
  }
}

TEST(Crossover, InheritsALinkOfTwoNumbersOnceWithTheSmallerNumberAndTheFittersWeight) {
  const Genome older = sample_genome(1, 1, {}, {{0, 0, 2, 0.1, true}, {1, 1, 2, 0.2, true}});
  const Genome newer = sample_genome(1, 1, {}, {{0, 0, 2, 0.1, true}, {7, 1, 2, 0.7, true}});
  CrossoverSettings settings;
  settings.weaker_genes_probability = 1.0;
  Stream stream(104, Purpose::test);
  EXPECT_EQ(crossover(older, newer, settings, true, stream).links[1], (LinkGene{1, 1, 2, 0.2, true}));
  EXPECT_EQ(crossover(older, newer, settings, true, stream).links.size(), 2u);
  EXPECT_EQ(crossover(newer, older, settings, true, stream).links[1], (LinkGene{1, 1, 2, 0.7, true}));
  EXPECT_EQ(crossover(newer, older, settings, true, stream).links.size(), 2u);
  settings.weaker_genes_probability = 0.0;
  EXPECT_EQ(crossover(newer, older, settings, true, stream).links[1], (LinkGene{7, 1, 2, 0.7, true}));
}

TEST(Crossover, TakesFromTheFitterWhetherALinkOfTwoNumbersIsEnabled) {
  Stream stream(108, Purpose::test);
  CrossoverSettings settings;
  settings.weaker_genes_probability = 1.0;
  settings.enable_probability = 0.0;
  for (const bool enabled : {true, false}) {
    const Genome older = sample_genome(1, 1, {}, {{0, 0, 2, 0.1, true}, {1, 1, 2, 0.2, !enabled}});
    const Genome newer = sample_genome(1, 1, {}, {{0, 0, 2, 0.1, true}, {7, 1, 2, 0.7, enabled}});
    EXPECT_EQ(crossover(newer, older, settings, true, stream).links[1], (LinkGene{1, 1, 2, 0.7, enabled}));
    EXPECT_EQ(crossover(older, newer, settings, true, stream).links[1], (LinkGene{1, 1, 2, 0.2, !enabled}));
  }
}

}  // namespace
}  // namespace amble::neat
