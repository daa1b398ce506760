#include "amble/neat/graph.hpp"

#include <cstddef>

#include "amble/core/index.hpp"

namespace amble::neat {

Graph::Graph(const Genome& genome) : targets_(genome.nodes.size()) {
  for (const LinkGene& link : genome.links) add(genome.index_of(link.from), genome.index_of(link.to));
}

Graph Graph::without_links(const Genome& genome) {
  Graph graph;
  graph.targets_.resize(genome.nodes.size());
  return graph;
}

void Graph::add(int from, int to) {
  targets_[to_index(from)].push_back(to);
}

std::vector<bool> Graph::reachable_from(int node) const {
  std::vector<bool> reached(targets_.size());
  std::vector<int> open{node};
  reached[to_index(node)] = true;
  while (!open.empty()) {
    const int current = open.back();
    open.pop_back();
    for (const int next : targets_[to_index(current)]) {
      if (reached[to_index(next)]) continue;
      reached[to_index(next)] = true;
      open.push_back(next);
    }
  }
  return reached;
}

bool Graph::would_close_cycle(int from, int to) const {
  return reachable_from(to)[to_index(from)];
}

bool Graph::has_cycle() const {
  // Remove nodes without incoming links until none is left; the rest are on a cycle or downstream of one.
  std::vector<int> incoming(targets_.size());
  for (const auto& targets : targets_)
    for (const int to : targets) ++incoming[to_index(to)];
  std::vector<int> open;
  for (std::size_t i = 0; i < incoming.size(); ++i)
    if (incoming[i] == 0) open.push_back(static_cast<int>(i));
  std::size_t removed = 0;
  while (!open.empty()) {
    const auto current = to_index(open.back());
    open.pop_back();
    ++removed;
    for (const int to : targets_[current])
      if (--incoming[to_index(to)] == 0) open.push_back(to);
  }
  return removed < targets_.size();
}

}  // namespace amble::neat
