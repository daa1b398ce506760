#pragma once

#include <string>

#include "amble/figures/cppn_graph.hpp"

namespace amble::figures {

/// A CPPN from its inputs, left, to its outputs, right: each node shows the curve of its function, each link
/// its weight by width and colour, disabled links are dashed; links that lead back or stay in their layer are
/// routed around the others and end in an arrowhead. An <svg> element of class "cppn", as wide as necessary,
/// with a legend and tooltips.
std::string cppn_figure(const CppnGraph& graph);

/// The same as a file of its own, with its style sheet.
std::string cppn_svg(const CppnGraph& graph);

}  // namespace amble::figures
