#pragma once

#include <string>

#include "amble/figures/figure_size.hpp"
#include "amble/figures/substrate_graph.hpp"

namespace amble::figures {

/// Nodes at their positions, and links between them. Two coordinates make a plane; with three, the first
/// stacks planes; with four, the last two arrange modules. Distances are scaled so that each coordinate fills
/// the figure. An <svg> element. Throws UserError unless can_be_drawn().
std::string substrate_figure(const Substrate& substrate, FigureSize layout);

/// The same as a file of its own, with its style sheet.
std::string substrate_svg(const Substrate& substrate);

}  // namespace amble::figures
