#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "amble/cppn/network.hpp"
#include "amble/neat/genome.hpp"

namespace amble::controllers {

/// Each output is the sum of its weights times the inputs, of which the first is the bias.
template <std::size_t inputs, std::size_t outputs>
cppn::Network linear_cppn(const std::array<std::array<double, inputs>, outputs>& weights) {
  neat::Genome genome;
  for (std::uint32_t id = 0; id < inputs + outputs; ++id)
    genome.nodes.push_back({id,
                            id == 0       ? neat::NodeKind::bias
                            : id < inputs ? neat::NodeKind::input
                                          : neat::NodeKind::output,
                            neat::Activation::linear});
  for (std::uint32_t out = 0; out < outputs; ++out)
    for (std::uint32_t in = 0; in < inputs; ++in)
      genome.links.push_back({static_cast<std::uint32_t>(out * inputs + in), in,
                              static_cast<std::uint32_t>(inputs + out), weights[out][in]});
  return {genome, {cppn::Linear::identity, true}};
}

}  // namespace amble::controllers
