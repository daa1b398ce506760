#pragma once

#include <string>

#include "amble/analysis/cppn_graph.hpp"

namespace amble::analysis {

/// A CPPN from its inputs, left, to its outputs, right: in each node the curve of its function, each link as
/// wide as its weight is large and in the colour of its sign, disabled ones dashed; those that lead back or
/// stay in their layer go round the others and end in an arrowhead. An <svg> element of class
/// "cppn", as wide as it needs to be, with a legend; a pointer that rests on a part is told its name.
std::string cppn_figure(const CppnGraph& graph);

/// The same as a file of its own, with its style sheet.
std::string cppn_svg(const CppnGraph& graph);

}  // namespace amble::analysis
