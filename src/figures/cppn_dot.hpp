#pragma once

#include <string>

#include "amble/figures/cppn_graph.hpp"

namespace amble::figures {

/// A CPPN in the DOT language of Graphviz: functions in the nodes, weights as widths, signs as colours,
/// disabled links dashed. Graphviz places the nodes, with inputs at one end and outputs at the other.
std::string cppn_dot(const CppnGraph& graph);

}  // namespace amble::figures
