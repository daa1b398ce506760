#pragma once

#include <string>
#include <utility>
#include <vector>

#include "amble/figures/substrate_graph.hpp"
#include "amble/figures/svg.hpp"

namespace amble::figures {

/// Positions of a substrate's nodes in a figure, px.
struct SubstratePlaces {
  double width_px = 0.0, height_px = 0.0;
  std::vector<Point> nodes;                           ///< by node
  std::vector<std::vector<Point>> frames;             ///< outlines of planes or modules
  std::vector<std::pair<Point, std::string>> titles;  ///< of frames: left ends
  std::vector<std::pair<Point, std::string>> marks;   ///< along axes: centres
};

/// Leaves `top_px` free above. Throws UserError unless can_be_drawn().
SubstratePlaces substrate_places(const Substrate& substrate, double width_px, double top_px);

}  // namespace amble::figures
