#include "amble/neat/speciation.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <map>

#include "tests/neat/samples.hpp"

namespace amble::neat {
namespace {

/// The definition word by word, with look-ups instead of a merge.
double naive_distance(const Genome& a, const Genome& b, const DistanceSettings& settings) {
  std::map<std::uint32_t, double> of_a, of_b;
  for (const LinkGene& link : a.links) of_a[link.innovation] = link.weight;
  for (const LinkGene& link : b.links) of_b[link.innovation] = link.weight;
  const auto newest = [](const auto& links) {
    return links.empty() ? -1.0 : static_cast<double>(links.rbegin()->first);
  };
  double excess = 0, disjoint = 0, difference = 0, matching = 0;
  for (const auto& [innovation, weight] : of_a) {
    if (of_b.contains(innovation)) {
      ++matching;
      difference += std::abs(weight - of_b[innovation]);
    } else {
      (innovation > newest(of_b) ? excess : disjoint) += 1;
    }
  }
  for (const auto& [innovation, weight] : of_b)
    if (!of_a.contains(innovation)) (innovation > newest(of_a) ? excess : disjoint) += 1;
  const auto genes = static_cast<double>(std::max(of_a.size(), of_b.size()));
  if (settings.normalised) {
    if (genes > 0) excess /= genes, disjoint /= genes;
    if (matching > 0) difference /= matching;
  }
  return settings.excess * excess + settings.disjoint * disjoint + settings.weight * difference;
}

/// The parents of figure 4 of Stanley & Miikkulainen 2002: innovations 1, 2, 3, 4, 5, 8 and 1, 2, 3, 4, 5, 6,
/// 7, 9, 10.
Genome with_innovations(const std::vector<std::uint32_t>& innovations, double weight) {
  std::vector<LinkGene> links;
  for (const auto innovation : innovations) links.push_back({innovation, 1, 2, weight, true});
  return sample_genome(1, 1, {}, links);
}

TEST(Distance, CountsTheGenesOfThePublishedExample) {
  const Genome one = with_innovations({1, 2, 3, 4, 5, 8}, 1.0);
  const Genome two = with_innovations({1, 2, 3, 4, 5, 6, 7, 9, 10}, 0.5);
  // Disjoint 6, 7, 8; excess 9, 10; five matching genes that differ by 0.5 each.
  EXPECT_DOUBLE_EQ(compatibility_distance(one, two, {1, 0, 0, false}), 2.0);
  EXPECT_DOUBLE_EQ(compatibility_distance(one, two, {0, 1, 0, false}), 3.0);
  EXPECT_DOUBLE_EQ(compatibility_distance(one, two, {0, 0, 1, false}), 2.5);
  EXPECT_DOUBLE_EQ(compatibility_distance(one, two, {1, 1, 3, false}), 12.5);
  // Normalised: counts over the larger genome's nine links, mean weight difference.
  EXPECT_DOUBLE_EQ(compatibility_distance(one, two, {1, 1, 3, true}), 5.0 / 9.0 + 1.5);
}

TEST(Distance, KnowsGenomesWithoutLinks) {
  const Genome none = sample_genome(1, 1, {}, {}), some = with_innovations({3, 4}, 1.0);
  EXPECT_EQ(compatibility_distance(none, none, {1, 1, 3, true}), 0.0);
  EXPECT_EQ(compatibility_distance(none, some, {1, 0, 0, false}), 2.0);
  EXPECT_EQ(compatibility_distance(some, none, {1, 0, 0, true}), 1.0);
}

TEST(Distance, EqualsItsNaiveTwinAndIsSymmetric) {
  Stream stream(21, Purpose::test);
  Innovations innovations(3, 2);
  std::vector<Genome> genomes;
  for (int i = 0; i < 60; ++i)
    genomes.push_back(grown_genome(3, 2, static_cast<int>(stream.below(60)), true, innovations, stream));
  for (const bool normalised : {false, true}) {
    const DistanceSettings settings{1.25, 0.5, 3.0, normalised};
    for (const Genome& a : genomes)
      for (const Genome& b : genomes) {
        const double distance = compatibility_distance(a, b, settings);
        ASSERT_NEAR(distance, naive_distance(a, b, settings), 1e-12 * (1.0 + distance));
        ASSERT_EQ(distance, compatibility_distance(b, a, settings));
        if (&a == &b) {
          ASSERT_EQ(distance, 0.0);
        }
      }
  }
}

}  // namespace
}  // namespace amble::neat
