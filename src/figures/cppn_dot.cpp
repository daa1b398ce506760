#include "amble/figures/cppn_dot.hpp"

#include <fmt/format.h>

#include <cmath>
#include <string_view>

#include "amble/figures/svg.hpp"

namespace amble::figures {
namespace {

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
