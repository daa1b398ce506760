#pragma once

#include <vector>

#include "amble/neat/genome.hpp"

namespace amble::neat {

/// The directed graph of a genome's links, enabled or not: a feed-forward genome may not hold a cycle even of
/// disabled links, because crossover may enable them. Vertices are indices into `nodes`.
class Graph {
 public:
  /// Every link's ends must be nodes of the genome.
  explicit Graph(const Genome& genome);
  /// The nodes of the genome without its links.
  static Graph without_links(const Genome& genome);

  void add(int from, int to);
  /// For each node whether a path leads to it from `node`; true for `node` itself.
  std::vector<bool> reachable_from(int node) const;
  /// Whether a link from → to would close a cycle; a link from a node to itself is one.
  bool would_close_cycle(int from, int to) const;
  bool has_cycle() const;

 private:
  Graph() = default;

  std::vector<std::vector<int>> targets_;
};

}  // namespace amble::neat
