#pragma once

#include <string>
#include <utility>
#include <vector>

#include "amble/analysis/substrate_figure.hpp"
#include "amble/analysis/svg.hpp"

namespace amble::analysis {

/// Where the nodes of a substrate stand in a picture.
struct SubstratePlaces {
  double width_px = 0.0, height_px = 0.0;
  std::vector<Point> nodes;                           ///< node by node
  std::vector<std::vector<Point>> frames;             ///< outlines of planes or modules
  std::vector<std::pair<Point, std::string>> titles;  ///< of frames: where they begin
  std::vector<std::pair<Point, std::string>> marks;   ///< along axes: where they are centred
};

/// Leaves `top_px` free above. Throws UserError for more than four coordinates.
SubstratePlaces substrate_places(const Substrate& substrate, double width_px, double top_px);

}  // namespace amble::analysis
