#include "amble/search/line.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

namespace amble::search {
namespace {

/// A genome of an input, a bias and an output whose links have these innovation numbers and weights.
neat::Genome genome_of(std::vector<std::pair<std::uint32_t, double>> links) {
  neat::Genome genome;
  for (const auto& [innovation, weight] : links)
    genome.links.push_back({.innovation = innovation, .from = 0, .to = 2, .weight = weight, .enabled = true});
  return genome;
}

TEST(Line, ChildrenWithoutAStepOfTheirOwnLieOnTheLineToTheMate) {
  const neat::Genome parent = genome_of({{0, 1.0}, {1, -2.0}, {2, 0.5}}),
                     mate = genome_of({{0, 2.0}, {1, 2.0}, {2, 0.5}});
  Stream stream(1, Purpose::test);
  for (int i = 0; i < 100; ++i) {
    const neat::Genome child = moved_along_line(parent, mate, {.iso_sigma = 0.0, .line_sigma = 0.2}, stream);
    const double way = child.links[0].weight - 1.0;
    EXPECT_NEAR(child.links[1].weight, -2.0 + 4.0 * way, 1e-12);
    EXPECT_EQ(child.links[2].weight, 0.5);
  }
}

TEST(Line, StepsHaveTheDeviationsOfTheSettings) {
  const neat::Genome parent = genome_of({{0, 1.0}, {1, 1.0}}), mate = genome_of({{0, 4.0}, {1, 1.0}});
  constexpr int children = 20'000;
  double along = 0.0, own = 0.0;
  Stream stream(2, Purpose::test);
  for (int i = 0; i < children; ++i) {
    const neat::Genome child = moved_along_line(parent, mate, {.iso_sigma = 0.1, .line_sigma = 0.2}, stream);
    along += std::pow(child.links[0].weight - 1.0, 2);
    own += std::pow(child.links[1].weight - 1.0, 2);
  }
  EXPECT_NEAR(std::sqrt(own / children), 0.1, 0.002);
  EXPECT_NEAR(std::sqrt(along / children), std::hypot(0.1, 0.2 * 3.0), 0.01);
}

TEST(Line, LinksThatTheMateLacksMoveByTheirOwnStepAlone) {
  const neat::Genome parent = genome_of({{1, 1.0}, {4, 1.0}, {7, 1.0}}),
                     mate = genome_of({{0, 9.0}, {4, 3.0}, {8, 9.0}});
  Stream stream(3, Purpose::test);
  const neat::Genome child = moved_along_line(parent, mate, {.iso_sigma = 0.0, .line_sigma = 0.5}, stream);
  EXPECT_EQ(child.links[0].weight, 1.0);
  EXPECT_NE(child.links[1].weight, 1.0);
  EXPECT_EQ(child.links[2].weight, 1.0);
  EXPECT_EQ(child.links.size(), 3u);
}

}  // namespace
}  // namespace amble::search
