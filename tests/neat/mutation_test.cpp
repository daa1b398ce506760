#include "amble/neat/mutation.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "tests/neat/samples.hpp"

namespace amble::neat {
namespace {

TEST(Mutation, DrawsOperatorsByTheirNormalisedShares) {
  Innovations innovations(3, 2);
  Stream stream(91, Purpose::test);
  Settings settings;
  settings.mutation.delete_link_share = 0.02;
  const Genome before = grown_genome(3, 2, 20, true, innovations, stream);
  std::array<int, 5> hits{};
  const int count = 50000;
  for (int i = 0; i < count; ++i) {
    Genome genome = before;
    ++hits[static_cast<std::size_t>(mutate(genome, settings, true, innovations, stream))];
    ASSERT_NE(genome, before);
  }
  const std::array<double, 5> shares{0.96 / 1.05, 0.06 / 1.05, 0.01 / 1.05, 0.02 / 1.05, 0.0};
  for (std::size_t i = 0; i < hits.size(); ++i)
    EXPECT_NEAR(hits[i], count * shares[i], 5 * std::sqrt(count * shares[i] * (1 - shares[i]))) << i;
}

TEST(Mutation, DrawsAgainWhenAnOperatorFindsNothingToDo) {
  Innovations innovations(1, 1);
  Stream stream(92, Purpose::test);
  // Without links only add_link can work.
  for (int i = 0; i < 200; ++i) {
    Genome genome = sample_genome(1, 1, {}, {});
    ASSERT_EQ(mutate(genome, {}, false, innovations, stream), Mutation::add_link);
    ASSERT_EQ(genome.links.size(), 1u);
  }
}

TEST(Mutation, LeavesAGenomeAloneThatNoOperatorCanChange) {
  Innovations innovations(1, 1);
  Stream stream(93, Purpose::test);
  Settings settings;
  settings.mutation.add_link_share = 0;
  Genome genome = sample_genome(1, 1, {}, {});
  EXPECT_EQ(mutate(genome, settings, false, innovations, stream), Mutation::none);
  EXPECT_EQ(genome, sample_genome(1, 1, {}, {}));
}

}  // namespace
}  // namespace amble::neat
