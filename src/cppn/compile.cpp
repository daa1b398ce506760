#include <algorithm>
#include <cmath>
#include <numeric>

#include "amble/core/check.hpp"
#include "amble/core/index.hpp"
#include "amble/cppn/network.hpp"

namespace amble::cppn {
namespace {

/// For each node, by its index in the genome, the nodes at the other end of its links.
using Neighbours = std::vector<std::vector<int>>;

struct Graph {
  Neighbours sources, targets;
};

bool is_computed(const neat::NodeGene& node) {
  return node.kind == neat::NodeKind::output || node.kind == neat::NodeKind::hidden;
}

Graph graph_of(const neat::Genome& genome, const std::vector<bool>& kept) {
  Graph graph{Neighbours(genome.nodes.size()), Neighbours(genome.nodes.size())};
  for (const neat::LinkGene& link : genome.links) {
    const int from = genome.index_of(link.from), to = genome.index_of(link.to);
    AMBLE_CHECK(from >= 0 && to >= 0, "a link names a node that is not in the genome");
    if (!link.enabled || !kept[to_index(to)]) continue;
    graph.sources[to_index(to)].push_back(from);
    graph.targets[to_index(from)].push_back(to);
  }
  return graph;
}

/// Number of links on the shortest path from each node to an output, by breadth-first search from the
/// outputs; −1 where there is none.
std::vector<int> distances_to_outputs(const neat::Genome& genome, const Graph& graph) {
  std::vector<int> distances(genome.nodes.size(), -1), queue;
  for (std::size_t i = 0; i < genome.nodes.size(); ++i) {
    if (genome.nodes[i].kind != neat::NodeKind::output) continue;
    distances[i] = 0;
    queue.push_back(static_cast<int>(i));
  }
  for (std::size_t next = 0; next < queue.size(); ++next) {
    const int node = queue[next];
    for (const int source : graph.sources[to_index(node)]) {
      if (distances[to_index(source)] >= 0) continue;
      distances[to_index(source)] = distances[to_index(node)] + 1;
      queue.push_back(source);
    }
  }
  return distances;
}

/// The greatest lengths[start] + number of links over all paths that end at each node, in topological order
/// (Kahn 1962); −1 where a cycle makes them unbounded.
std::vector<int> longest_paths(const Neighbours& before, const Neighbours& after, std::vector<int> lengths) {
  std::vector<std::size_t> open_sources(before.size());
  std::vector<int> queue;
  for (std::size_t i = 0; i < before.size(); ++i) {
    open_sources[i] = before[i].size();
    if (open_sources[i] == 0) queue.push_back(static_cast<int>(i));
  }
  for (std::size_t next = 0; next < queue.size(); ++next) {
    const int node = queue[next];
    for (const int follower : after[to_index(node)]) {
      lengths[to_index(follower)] = std::max(lengths[to_index(follower)], lengths[to_index(node)] + 1);
      if (--open_sources[to_index(follower)] == 0) queue.push_back(follower);
    }
  }
  for (std::size_t i = 0; i < before.size(); ++i)
    if (open_sources[i] != 0) lengths[i] = -1;
  return lengths;
}

/// In which passes each node must be computed. Pass t of P sets v_i(t) = f_i(Σ_j w_ij v_j(t − 1)) with v(0) =
/// 0, and the results are v(P). So a node whose longest path from inputs has `depth` links keeps its value
/// from pass `depth` on; and v_i(t) reaches an output by a path of P − t links or not at all.
struct Schedule {
  std::vector<bool> kept;
  std::vector<int> distance;  ///< links of the shortest path to an output; −1: none
  std::vector<int> height;    ///< links of the longest path to an output; −1: unbounded (a cycle)
  std::vector<int> depth;     ///< links of the longest path that ends here; −1: unbounded

  /// First and last pass, of `passes`, in which a node must be computed.
  std::pair<int, int> window(std::size_t node, int passes) const {
    if (depth[node] >= 0) return {1, std::min(passes, depth[node] + 1)};  // once for each of the two buffers
    return {height[node] >= 0 ? std::max(1, passes - height[node]) : 1, passes - distance[node]};
  }
};

Schedule schedule_of(const neat::Genome& genome) {
  const std::size_t count = genome.nodes.size();
  Schedule schedule;
  schedule.distance = distances_to_outputs(genome, graph_of(genome, std::vector<bool>(count, true)));
  for (const int distance : schedule.distance) schedule.kept.push_back(distance >= 0);
  const Graph graph = graph_of(genome, schedule.kept);
  std::vector<int> start(count);
  for (std::size_t i = 0; i < count; ++i) start[i] = is_computed(genome.nodes[i]) ? 1 : 0;
  schedule.depth = longest_paths(graph.sources, graph.targets, start);
  schedule.height = longest_paths(graph.targets, graph.sources, std::vector<int>(count, 0));
  return schedule;
}

/// Computed nodes that are kept, by depth: sources before targets where there is no cycle.
std::vector<int> evaluation_order(const neat::Genome& genome, const Schedule& schedule) {
  std::vector<int> order;
  for (std::size_t i = 0; i < genome.nodes.size(); ++i)
    if (schedule.kept[i] && is_computed(genome.nodes[i])) order.push_back(static_cast<int>(i));
  std::stable_sort(order.begin(), order.end(),
                   [&](int a, int b) { return schedule.depth[to_index(a)] < schedule.depth[to_index(b)]; });
  return order;
}

float to_weight(double weight) {
  AMBLE_CHECK(std::isfinite(weight), "a CPPN weight is not finite");
  // With values up to 2^64 (activation.hpp) no sum can then overflow.
  return static_cast<float>(std::clamp(weight, -0x1p32, 0x1p32));
}

void decide_passes(Program& program, const neat::Genome& genome, const Schedule& schedule,
                   const Settings& settings) {
  program.passes = settings.passes_with(genome.count(neat::NodeKind::hidden));
  int deepest = 0;
  for (std::size_t i = 0; i < genome.nodes.size(); ++i) {
    if (!schedule.kept[i]) continue;
    deepest = std::max(deepest, schedule.depth[i]);
    program.cyclic |= schedule.depth[i] < 0;
  }
  AMBLE_CHECK(settings.recurrent || !program.cyclic, "a feed-forward CPPN has a cycle");
  // Without a cycle one pass in topological order gives v(P) if P ≥ the greatest depth. A chain of outputs
  // can be longer than that: its last nodes then see values that are not final.
  program.in_place = !program.cyclic && (!settings.recurrent || deepest <= program.passes);
  if (program.in_place) program.passes = 1;
}

/// Appends the nodes of `order` and their enabled links, which keep the order of innovation.
void add_nodes(Program& program, const neat::Genome& genome, const Schedule& schedule,
               const std::vector<int>& order, const std::vector<int>& slot_of) {
  for (const int index : order) {
    const neat::NodeGene& gene = genome.nodes[to_index(index)];
    const auto [first_pass, last_pass] = schedule.window(to_index(index), program.passes);
    Program::Node node{
        slot_of[to_index(index)], static_cast<int>(program.links.size()), 0,
        gene.activation,          program.in_place ? 1 : first_pass,      program.in_place ? 1 : last_pass};
    for (const neat::LinkGene& link : genome.links) {
      if (!link.enabled || link.to != gene.id) continue;
      program.links.push_back({slot_of[to_index(genome.index_of(link.from))], to_weight(link.weight)});
      ++node.link_count;
    }
    program.nodes.push_back(node);
  }
}

}  // namespace

Program compile(const neat::Genome& genome, const Settings& settings) {
  const Schedule schedule = schedule_of(genome);
  Program program;
  program.linear = settings.linear;
  program.inputs = genome.count(neat::NodeKind::input);
  decide_passes(program, genome, schedule, settings);

  // Bias and inputs are the genome's first nodes, so that their slot is their index.
  std::vector<int> slot_of(genome.nodes.size(), -1);
  std::iota(slot_of.begin(), slot_of.begin() + 1 + program.inputs, 0);
  program.slots = 1 + program.inputs;
  const std::vector<int> order = evaluation_order(genome, schedule);
  for (const int node : order) slot_of[to_index(node)] = program.slots++;

  add_nodes(program, genome, schedule, order, slot_of);
  for (std::size_t i = 0; i < genome.nodes.size(); ++i)
    if (genome.nodes[i].kind == neat::NodeKind::output) program.output_slots.push_back(slot_of[i]);
  return program;
}

}  // namespace amble::cppn
