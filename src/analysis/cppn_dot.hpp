#pragma once

#include <string>

#include "amble/analysis/cppn_graph.hpp"

namespace amble::analysis {

/// A CPPN in the DOT language of Graphviz: functions in the nodes, weights as widths, signs as colours,
/// disabled links dashed. Places are left to Graphviz, but for inputs at one end and outputs at the other.
std::string cppn_dot(const CppnGraph& graph);

}  // namespace amble::analysis
