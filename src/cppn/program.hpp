#pragma once

#include <vector>

#include "amble/cppn/settings.hpp"
#include "amble/neat/genome.hpp"

namespace amble::cppn {

/// A genome compiled for evaluation by cppn::Network.
///
/// Values live in slots: slot 0 is the bias, 1 … inputs are the inputs, and each computed node has one. Each
/// pass computes nodes from the values of the pass before, v_i(t) = f_i(Σ_j w_ij v_j(t − 1)). A feed-forward
/// program needs one pass only, in place, because its nodes are in topological order.
struct Program {
  struct Link {
    int from_slot;
    float weight;
  };
  /// Sum of links [first_link, first_link + link_count), then the activation function. Computed in passes
  /// first_pass … last_pass: earlier values influence no output, and later ones are the same or influence
  /// none.
  struct Node {
    int slot;
    int first_link, link_count;
    neat::Activation activation;
    int first_pass, last_pass;
  };

  int inputs = 0;
  int slots = 0;
  int passes = 1;
  bool in_place = true;
  bool cyclic = false;
  Linear linear = Linear::absolute;
  std::vector<Node> nodes;
  std::vector<Link> links;        ///< of one node: by rising innovation
  std::vector<int> output_slots;  ///< output by output
};

/// Leaves out disabled links and nodes that no output depends on. A genome whose links form a cycle needs
/// settings.recurrent (checked).
Program compile(const neat::Genome& genome, const Settings& settings);

}  // namespace amble::cppn
