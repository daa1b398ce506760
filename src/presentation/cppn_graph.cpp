#include "amble/presentation/cppn_graph.hpp"

#include <array>
#include <string>
#include <string_view>

#include "amble/core/index.hpp"

namespace amble::presentation {
namespace {

/// By neat::NodeKind.
constexpr std::array<figures::CppnRole, 4> roles{figures::CppnRole::bias, figures::CppnRole::input,
                                                 figures::CppnRole::output, figures::CppnRole::hidden};

/// What a node computes: "linear" may mean |x|.
std::string_view function_name(neat::Activation activation, const cppn::Settings& settings) {
  if (activation == neat::Activation::linear && settings.linear == cppn::Linear::absolute) return "|x|";
  return neat::activation_names[to_index(activation)];
}

}  // namespace

figures::CppnGraph cppn_graph(const experiment::Champion& champion) {
  const neat::Genome& genome = champion.genome;
  const controllers::Architecture& architecture = *champion.problem.architecture;
  figures::CppnGraph graph;
  std::size_t inputs = 0, outputs = 0;
  for (const neat::NodeGene& node : genome.nodes) {
    const figures::CppnRole role = roles[to_index(node.kind)];
    std::string name;
    if (role == figures::CppnRole::bias) name = "bias";
    if (role == figures::CppnRole::input) name = architecture.cppn_inputs()[inputs++];
    if (role == figures::CppnRole::output) name = architecture.cppn_outputs()[outputs++];
    graph.nodes.push_back(
        {node.id, role, std::string(function_name(node.activation, champion.problem.cppn)), std::move(name)});
  }
  for (const neat::LinkGene& link : genome.links)
    graph.links.push_back({to_index(genome.index_of(link.from)), to_index(genome.index_of(link.to)),
                           link.weight, link.enabled});
  return graph;
}

}  // namespace amble::presentation
