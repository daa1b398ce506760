#include "amble/figures/substrate_graph.hpp"

#include <algorithm>
#include <cmath>

namespace amble::figures {

Substrate substrate_of(const motion::NeuralNetwork& network) {
  Substrate substrate{.coordinates = network.coordinates,
                      .nodes = network.nodes,
                      .links = {},
                      .link_kinds = {"excites", "inhibits"}};
  double largest = 0.0;
  for (const motion::NetworkLink& link : network.links) largest = std::max(largest, std::fabs(link.weight));
  for (const motion::NetworkLink& link : network.links)
    substrate.links.push_back({link.source, link.target, link.weight < 0.0 ? 1 : 0,
                               largest > 0.0 ? std::fabs(link.weight) / largest : 0.0});
  return substrate;
}

bool can_be_drawn(const Substrate& substrate) {
  return substrate.coordinates.size() <= 4;
}

}  // namespace amble::figures
