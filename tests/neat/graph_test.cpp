#include "amble/neat/graph.hpp"

#include <gtest/gtest.h>

#include "tests/neat/samples.hpp"

namespace amble::neat {
namespace {

using Matrix = std::vector<std::vector<bool>>;

/// Which node a path of at least one link leads to from which, by Warshall's algorithm.
Matrix paths(const Genome& genome) {
  const std::size_t n = genome.nodes.size();
  Matrix path(n, std::vector<bool>(n));
  for (const LinkGene& link : genome.links)
    path[static_cast<std::size_t>(genome.index_of(link.from))]
        [static_cast<std::size_t>(genome.index_of(link.to))] = true;
  for (std::size_t k = 0; k < n; ++k)
    for (std::size_t i = 0; i < n; ++i)
      for (std::size_t j = 0; j < n; ++j)
        if (path[i][k] && path[k][j]) path[i][j] = true;
  return path;
}

TEST(Graph, EqualsItsNaiveTwinOnRandomGenomes) {
  Stream stream(31, Purpose::test);
  int cyclic = 0;
  for (int round = 0; round < 400; ++round) {
    Innovations innovations(2, 2);
    const bool recurrent = round % 2 == 0;
    const Genome genome =
        grown_genome(2, 2, static_cast<int>(stream.below(25)), recurrent, innovations, stream);
    const Graph graph(genome);
    const Matrix path = paths(genome);
    bool cycle = false;
    for (std::size_t i = 0; i < path.size(); ++i) {
      cycle = cycle || path[i][i];
      const auto reached = graph.reachable_from(static_cast<int>(i));
      for (std::size_t j = 0; j < path.size(); ++j) {
        ASSERT_EQ(reached[j], i == j || path[i][j]);
        ASSERT_EQ(graph.would_close_cycle(static_cast<int>(j), static_cast<int>(i)), i == j || path[i][j]);
      }
    }
    ASSERT_EQ(graph.has_cycle(), cycle);
    if (!recurrent) {
      ASSERT_FALSE(cycle);
    }
    cyclic += cycle;
  }
  EXPECT_GT(cyclic, 50) << "the sample holds cycles";
}

TEST(Graph, SeesALoopOfOneNodeAndDisabledLinks) {
  const Genome loop = sample_genome(1, 1, {}, {{0, 2, 2, 1.0, true}});
  EXPECT_TRUE(Graph(loop).has_cycle());
  const Genome sleeping = sample_genome(1, 2, {}, {{0, 2, 3, 1.0, true}, {1, 3, 2, 1.0, false}});
  EXPECT_TRUE(Graph(sleeping).has_cycle());
}

TEST(Graph, GrowsLinkByLink) {
  const Genome genome = sample_genome(1, 2, {}, {{0, 2, 3, 1.0, true}});
  Graph graph = Graph::without_links(genome);
  EXPECT_FALSE(graph.would_close_cycle(3, 2));
  graph.add(2, 3);
  EXPECT_TRUE(graph.would_close_cycle(3, 2));
  EXPECT_FALSE(graph.would_close_cycle(2, 3)) << "a second link the same way closes none";
}

}  // namespace
}  // namespace amble::neat
