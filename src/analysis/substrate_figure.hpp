#pragma once

#include <string>
#include <vector>

#include "amble/analysis/layout.hpp"

namespace amble::analysis {

enum class NodeRole { sensor, hidden, joint };

struct SubstrateNode {
  std::string name;
  std::vector<double> at;  ///< one number per coordinate
  NodeRole role = NodeRole::hidden;
};

struct SubstrateLink {
  int source = 0, target = 0;
  int kind = 0;           ///< index into Substrate::link_kinds; decides the colour
  double strength = 0.5;  ///< 0 … 1; decides the width
};

/// What a picture of a substrate needs to know.
struct Substrate {
  std::vector<std::string> coordinates;
  std::vector<SubstrateNode> nodes;
  std::vector<SubstrateLink> links;
  std::vector<std::string> link_kinds;  ///< for the legend
};

/// Whether there are few enough coordinates for a picture: four at most.
bool can_be_drawn(const Substrate& substrate);

/// Nodes at their places, and links between them. Two coordinates make a plane; with three, the first stacks
/// planes upon each other; with four, the last two place modules. Distances are stretched so that each
/// coordinate fills the picture. An <svg> element. Throws UserError if it cannot be drawn.
std::string substrate_figure(const Substrate& substrate, Layout layout);

/// The same as a file of its own, with its style sheet.
std::string substrate_svg(const Substrate& substrate);

}  // namespace amble::analysis
