#include "amble/figures/cppn_graph.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include <numeric>
#include <string_view>

#include "amble/core/check.hpp"
#include "amble/figures/svg.hpp"

namespace amble::figures {
namespace {

constexpr int order_rounds = 8;

bool comes_first(CppnRole role) {
  return role == CppnRole::bias || role == CppnRole::input;
}

/// The first node left whose sources are all done; in a cycle, where there is none, the first hidden one.
std::size_t next_node(const CppnGraph& graph, const std::vector<int>& waits_for,
                      const std::vector<bool>& done) {
  std::size_t left = 0, hidden = graph.nodes.size();
  for (std::size_t i = graph.nodes.size(); i-- > 0;) {
    if (done[i]) continue;
    left = i;
    if (graph.nodes[i].role == CppnRole::hidden) hidden = i;
  }
  for (std::size_t i = left; i < graph.nodes.size(); ++i)
    if (!done[i] && waits_for[i] == 0) return i;
  return hidden < graph.nodes.size() ? hidden : left;
}

/// The layer of each node; layers may be empty.
std::vector<std::size_t> find_layers(const CppnGraph& graph) {
  std::vector<int> waits_for(graph.nodes.size());
  for (const CppnLink& link : graph.links) waits_for[link.to] += link.from != link.to;
  std::vector<std::size_t> layer;
  for (const CppnNode& node : graph.nodes) layer.push_back(comes_first(node.role) ? 0 : 1);
  std::vector<bool> done(graph.nodes.size());
  for (std::size_t count = 0; count < graph.nodes.size(); ++count) {
    const std::size_t node = next_node(graph, waits_for, done);
    done[node] = true;
    for (const CppnLink& link : graph.links) {
      if (link.from != node || done[link.to]) continue;
      layer[link.to] = std::max(layer[link.to], layer[node] + 1);
      --waits_for[link.to];
    }
  }
  std::size_t last = 1;
  for (std::size_t i = 0; i < layer.size(); ++i)
    if (graph.nodes[i].role != CppnRole::output) last = std::max(last, layer[i] + 1);
  for (std::size_t i = 0; i < layer.size(); ++i)
    if (graph.nodes[i].role == CppnRole::output) layer[i] = last;
  return layer;
}

void spread_evenly(const std::vector<std::size_t>& nodes, std::vector<double>& place) {
  for (std::size_t i = 0; i < nodes.size(); ++i)
    place[nodes[i]] = (static_cast<double>(i) + 0.5) / static_cast<double>(nodes.size());
}

/// Sorts a layer by the barycentres of the neighbours on one side.
void sort_layer(const CppnGraph& graph, CppnPlaces& places, std::vector<std::size_t>& nodes,
                bool by_sources) {
  std::vector<double> sum(graph.nodes.size()), count(graph.nodes.size());
  for (const CppnLink& link : graph.links) {
    const std::size_t node = by_sources ? link.to : link.from, neighbour = by_sources ? link.from : link.to;
    sum[node] += places.place[neighbour];
    count[node] += 1.0;
  }
  for (const std::size_t node : nodes)
    sum[node] = count[node] > 0.0 ? sum[node] / count[node] : places.place[node];
  std::ranges::stable_sort(nodes, {}, [&](std::size_t node) { return sum[node]; });
  spread_evenly(nodes, places.place);
}

/// A string of the DOT language.
std::string in_quotes(std::string_view text) {
  std::string out = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') out += '\\';
    out += c == '\n' ? std::string_view("\\n") : std::string_view(&c, 1);
  }
  return out + '"';
}

}  // namespace

std::string CppnGraph::name_of(std::size_t node) const {
  return nodes[node].name.empty() ? "node " + std::to_string(nodes[node].id) : nodes[node].name;
}

double CppnGraph::heaviest_weight() const {
  double most = 0.0;
  for (const CppnLink& link : links) most = std::max(most, std::fabs(link.weight));
  return most > 0.0 ? most : 1.0;
}

CppnPlaces place_nodes(const CppnGraph& graph) {
  AMBLE_CHECK(!graph.nodes.empty(), "a CPPN has nodes");
  CppnPlaces places{.layers = {}, .layer = find_layers(graph), .place = {}};
  places.place.resize(graph.nodes.size());
  places.layers.resize(std::ranges::max(places.layer) + 1);
  for (std::size_t i = 0; i < graph.nodes.size(); ++i) places.layers[places.layer[i]].push_back(i);
  std::erase_if(places.layers, [](const auto& nodes) { return nodes.empty(); });
  for (std::size_t layer = 0; layer < places.layers.size(); ++layer) {
    for (const std::size_t node : places.layers[layer]) places.layer[node] = layer;
    spread_evenly(places.layers[layer], places.place);
  }

  // Sweeps forwards and backwards. Inputs and outputs keep their order.
  std::vector<std::size_t> way(places.layers.size());
  std::iota(way.begin(), way.end(), std::size_t{0});
  for (int round = 0; round < order_rounds; ++round) {
    for (const std::size_t layer : way)
      if (graph.nodes[places.layers[layer].front()].role == CppnRole::hidden)
        sort_layer(graph, places, places.layers[layer], round % 2 == 0);
    std::ranges::reverse(way);
  }
  return places;
}

std::string cppn_dot(const CppnGraph& graph) {
  std::string dot = "digraph cppn {\n  rankdir=LR;\n  node [fontname=\"sans-serif\", fontsize=11];\n";
  std::string first = "  { rank=source;", last = "  { rank=sink;";
  for (std::size_t i = 0; i < graph.nodes.size(); ++i) {
    const CppnNode& node = graph.nodes[i];
    const bool terminal = (node.role == CppnRole::bias || node.role == CppnRole::input);
    std::string text = node.name;
    if (!terminal) text += (text.empty() ? "" : "\n") + node.function;
    dot += fmt::format("  n{} [label={}, shape={}];\n", node.id, in_quotes(text),
                       terminal ? "plaintext" : "ellipse");
    if (terminal) first += fmt::format(" n{};", node.id);
    if (node.role == CppnRole::output) last += fmt::format(" n{};", node.id);
  }
  dot += first + " }\n" + last + " }\n";
  const double most = graph.heaviest_weight();
  for (const CppnLink& link : graph.links)
    dot += fmt::format(
        "  n{} -> n{} [penwidth={}, color=\"{}\", style={}, tooltip=\"{}\"];\n", graph.nodes[link.from].id,
        graph.nodes[link.to].id, number(0.8 + 5.2 * std::fabs(link.weight) / most),
        link.weight < 0.0 ? "#c2410c" : "#00796b", link.enabled ? "solid" : "dashed", number(link.weight, 6));
  return dot + "}\n";
}

}  // namespace amble::figures
