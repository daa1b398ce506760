#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <tuple>

#include "amble/neat/crossover.hpp"
#include "amble/neat/initial_genome.hpp"
#include "amble/neat/mutation.hpp"
#include "tests/neat/samples.hpp"

namespace amble::neat {
namespace {

constexpr int inputs = 3, outputs = 2;

/// Recurrent or not, what becomes of a split link, how the weaker parent's genes are inherited, how long
/// numbers hold, and for which nodes.
class RandomStructure : public testing::TestWithParam<
                            std::tuple<bool, SplitLink, WeakerGenes, InnovationScope, InnovationKey>> {};

bool joins(const Genome& genome, const LinkGene& like) {
  return std::ranges::any_of(
      genome.links, [&](const LinkGene& link) { return link.from == like.from && link.to == like.to; });
}

TEST_P(RandomStructure, StaysValidThroughThousandsOfMutationsAndCrossovers) {
  const bool recurrent = std::get<0>(GetParam());
  const SplitLink split_link = std::get<1>(GetParam());
  const WeakerGenes weaker_genes = std::get<2>(GetParam());
  Settings settings = lively_settings();
  settings.mutation.split_link = split_link;
  settings.crossover.weaker_genes = weaker_genes;
  settings.crossover.weaker_genes_probability = 0.5;

  Stream stream(111, Purpose::test);
  const InnovationSettings numbers{std::get<3>(GetParam()), std::get<4>(GetParam())};
  Innovations innovations(inputs, outputs, numbers);
  std::vector<Genome> pool;
  for (int i = 0; i < 12; ++i)
    pool.push_back(initial_genome(settings.genome, inputs, outputs, innovations, stream));

  int crossed = 0, largest = 0;
  for (int round = 0; round < 4000; ++round) {
    if (round % 20 == 19) innovations.begin_generation();
    Genome& place = pool[stream.below(12)];
    const Genome& mother = pool[stream.below(12)];
    const Genome& father = pool[stream.below(12)];
    Genome child;
    if (stream.chance(0.3)) {
      child = crossover(mother, father, settings.crossover, recurrent, stream);
      ++crossed;
      for (const LinkGene& link : mother.links) {
        ASSERT_TRUE(joins(child, link)) << "the fitter parent's links are all inherited";
        ASSERT_TRUE(numbers.scope == InnovationScope::generation ||
                    std::ranges::binary_search(child.links, link.innovation, {}, &LinkGene::innovation));
      }
    } else {
      child = mother;
      ASSERT_NE(mutate(child, settings, recurrent, innovations, stream), Mutation::none);
    }
    ASSERT_EQ(error_of([&] { validate(child, inputs, outputs, recurrent); }), "");
    ASSERT_TRUE(innovations.knows(child)) << "the same numbers for the same genes";
    ASSERT_TRUE(all_hidden_nodes_are_linked(child));
    ASSERT_TRUE(std::ranges::all_of(child.links, [&](const LinkGene& link) {
      return std::abs(link.weight) <= settings.genome.weight_limit;
    }));
    largest = std::max(largest, static_cast<int>(child.links.size()));
    place = child.links.size() < 80 ? child
                                    : initial_genome(settings.genome, inputs, outputs, innovations, stream);
  }
  EXPECT_GT(crossed, 1000);
  EXPECT_GE(largest, 40) << "the sample holds large genomes";
}

INSTANTIATE_TEST_SUITE_P(
    AllRules, RandomStructure,
    testing::Combine(testing::Bool(), testing::Values(SplitLink::remove, SplitLink::disable),
                     testing::Values(WeakerGenes::all_or_none, WeakerGenes::one_by_one),
                     testing::Values(InnovationScope::generation, InnovationScope::run),
                     testing::Values(InnovationKey::link, InnovationKey::link_and_function)));

}  // namespace
}  // namespace amble::neat
