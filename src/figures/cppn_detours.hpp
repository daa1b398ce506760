#pragma once

#include <span>
#include <vector>

#include "amble/figures/cppn_graph.hpp"
#include "amble/figures/svg.hpp"

namespace amble::figures {

/// The route of a link that does not lead to a later layer, with an arrowhead at its end.
struct Detour {
  std::vector<Point> curve;  ///< for Svg::bezier(); empty for links that lead to a later layer
  Point tip;                 ///< of the arrowhead, whose base is at the end of the curve
};

/// By link. Links within a layer run on its right, links to an earlier layer above or below all nodes,
/// whichever is nearer, links from a node to itself in a loop above it. Each has a lane of its own.
std::vector<Detour> detours(const CppnGraph& graph, const CppnPlaces& places, std::span<const Point> centres,
                            std::span<const double> radii_px);

}  // namespace amble::figures
