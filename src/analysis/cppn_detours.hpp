#pragma once

#include <span>
#include <vector>

#include "amble/analysis/cppn_graph.hpp"
#include "amble/analysis/svg.hpp"

namespace amble::analysis {

/// The way of a link that does not lead to a later layer, with an arrowhead at its end.
struct Detour {
  std::vector<Point> curve;  ///< as Svg::bezier takes it; empty for links that lead to a later layer
  Point tip;                 ///< of the arrowhead, whose base is where the curve ends
};

/// By link. Within a layer they run on its right, to an earlier layer above or below all nodes, whichever is
/// nearer; from a node to itself in a loop above it. Each has a lane of its own.
std::vector<Detour> detours(const CppnGraph& graph, const CppnPlaces& places, std::span<const Point> centres,
                            std::span<const double> radii_px);

}  // namespace amble::analysis
