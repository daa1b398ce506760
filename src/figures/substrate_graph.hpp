#pragma once

#include <string>
#include <vector>

#include "amble/motion/neural_network.hpp"

namespace amble::figures {

struct SubstrateLink {
  int source = 0, target = 0;  ///< indices into Substrate::nodes
  int kind = 0;                ///< index into Substrate::link_kinds; decides the colour
  double strength = 0.5;       ///< in [0, 1]; decides the width
};

/// A substrate as figures draw it.
struct Substrate {
  std::vector<std::string> coordinates;  ///< names
  std::vector<motion::NetworkNode> nodes;
  std::vector<SubstrateLink> links;
  std::vector<std::string> link_kinds;  ///< for the legend
};

/// Links of positive weight are of kind 0 ("excites"), those of negative weight of kind 1 ("inhibits"); their
/// strength is |weight| divided by the largest one.
Substrate substrate_of(const motion::NeuralNetwork& network);

/// Whether there are few enough coordinates for a figure: four at most.
bool can_be_drawn(const Substrate& substrate);

}  // namespace amble::figures
