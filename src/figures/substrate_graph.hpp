#pragma once

#include <string>
#include <utility>
#include <vector>

#include "amble/figures/svg.hpp"
#include "amble/motion/recorded_trial.hpp"

namespace amble::figures {

struct SubstrateLink {
  int source = 0, target = 0;  ///< indices into Substrate::nodes
  int kind = 0;                ///< index into Substrate::link_kinds; decides the colour
  double strength = 0.5;       ///< in [0, 1]; decides the width
  bool negative = false;       ///< dashed: its weight is, and its kind does not say so
};

/// A substrate as figures draw it.
struct Substrate {
  std::vector<std::string> coordinates;  ///< names
  std::vector<motion::NetworkNode> nodes;
  std::vector<SubstrateLink> links;
  std::vector<std::string> link_kinds;  ///< for the legend
};

/// Links of positive weight are of kind 0 ("excites"), those of negative weight of kind 1 ("inhibits"); their
/// strength is |weight| divided by the largest one. Where links have ports, these are their kinds, and the
/// largest one is that of the port.
Substrate substrate_of(const motion::NeuralNetwork& network);

/// Whether there are few enough coordinates for a figure: four at most.
bool can_be_drawn(const Substrate& substrate);

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
