#include "amble/cli/cppn_graph.hpp"

#include <array>
#include <string>
#include <string_view>

namespace amble::cli {
namespace {

/// By neat::NodeKind.
constexpr std::array<analysis::CppnRole, 4> roles{analysis::CppnRole::bias, analysis::CppnRole::input,
                                                  analysis::CppnRole::output, analysis::CppnRole::hidden};

/// What a node computes: "linear" may mean |x|.
std::string_view function_name(neat::Activation activation, const cppn::Settings& settings) {
  if (activation == neat::Activation::linear && settings.linear == cppn::Linear::absolute) return "|x|";
  return neat::activation_names[static_cast<std::size_t>(activation)];
}

}  // namespace

analysis::CppnGraph cppn_graph(const experiment::Champion& champion) {
  const neat::Genome& genome = champion.genome;
  const controllers::Architecture& architecture = *champion.problem.architecture;
  analysis::CppnGraph graph;
  std::size_t inputs = 0, outputs = 0;
  for (const neat::NodeGene& node : genome.nodes) {
    const analysis::CppnRole role = roles[static_cast<std::size_t>(node.kind)];
    std::string name;
    if (role == analysis::CppnRole::bias) name = "bias";
    if (role == analysis::CppnRole::input) name = architecture.cppn_inputs()[inputs++];
    if (role == analysis::CppnRole::output) name = architecture.cppn_outputs()[outputs++];
    graph.nodes.push_back(
        {node.id, role, std::string(function_name(node.activation, champion.problem.cppn)), std::move(name)});
  }
  for (const neat::LinkGene& link : genome.links)
    graph.links.push_back({static_cast<std::size_t>(genome.index_of(link.from)),
                           static_cast<std::size_t>(genome.index_of(link.to)), link.weight, link.enabled});
  return graph;
}

}  // namespace amble::cli
