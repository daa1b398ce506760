#pragma once

#include "amble/core/random.hpp"
#include "amble/neat/genome.hpp"
#include "amble/neat/innovations.hpp"
#include "amble/neat/settings.hpp"

namespace amble::neat {

/// The operators of mutate(), in the order of MutationSettings.
enum class Mutation {
  weights = 0,      ///< mutate_weights()
  add_link = 1,     ///< neat::add_link()
  add_node = 2,     ///< neat::add_node()
  delete_link = 3,  ///< neat::delete_link()
  none = 4          ///< no operator applied
};

/// Applies one operator, drawn by the shares of MutationSettings (HyperSharpNEAT). An operator that does not
/// apply is removed from the roulette and another is drawn; if none applies, the genome is unchanged. Returns
/// the operator that was applied.
Mutation mutate(Genome& genome, const Settings& settings, bool recurrent, Innovations& innovations,
                Stream& stream);

// The operators. Each returns false, and leaves the genome unchanged, if it does not apply.

/// Changes weights in one of the five ways of WeightMutationSettings, links disabled or not; they stay within
/// ±`weight_limit`, or where they lie beyond it already, grow no larger. Does not apply to a genome without
/// links.
bool mutate_weights(Genome& genome, const WeightMutationSettings& settings, double weight_limit,
                    Stream& stream);

/// Joins two nodes that no link joins in that direction, each such pair equally likely; the target is an
/// output or hidden node. Recurrent genomes may join any, also a node to itself; in feed-forward ones pairs
/// that would close a cycle do not count.
bool add_link(Genome& genome, double weight_limit, bool recurrent, Innovations& innovations, Stream& stream);

/// Splits an enabled link, each equally likely: a new node with a function drawn by
/// GenomeSettings::activation_shares, reached by a link of weight 1 (at most weight_limit) and left by one of
/// the old weight. The old link is removed or disabled.
bool add_node(Genome& genome, const Settings& settings, Innovations& innovations, Stream& stream);

/// Deletes a link, each equally likely, and the hidden nodes that have no link left.
bool delete_link(Genome& genome, Stream& stream);

}  // namespace amble::neat
