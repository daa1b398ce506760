#pragma once

#include "amble/core/random.hpp"
#include "amble/neat/genome.hpp"
#include "amble/neat/settings.hpp"

namespace amble::neat {

/// A child of two parents, their links aligned by innovation number (Stanley & Miikkulainen 2002, sec. 3.2).
///
/// - Links of both: the weight of one parent, each with probability 1/2.
/// - Links of the fitter alone: inherited. Links of the weaker alone: by CrossoverSettings::weaker_genes.
/// - A link that is disabled in a parent that has it is enabled with `enable_probability`, else disabled.
/// - Of two links of different numbers between the same nodes, which occur where each generation numbers
///   anew, the child gets one: the smaller number, with the fitter's weight (the authors' code).
/// - Nodes: those of bias, inputs and outputs, and the hidden ones at an end of a link of the child;
///   a node of both has the fitter's function.
///
/// The parents must be valid, with as many inputs and outputs each (neat::validate; not checked). With
/// InnovationKey::link they may differ in the function of a node that both have.
///
/// Without `recurrent` both parents must be free of cycles, and so is the child: its links of the fitter
/// parent are, and a link of the weaker that would close a cycle with those taken before it, in order of
/// innovation, is left out.
Genome crossover(const Genome& fitter, const Genome& weaker, const CrossoverSettings& settings,
                 bool recurrent, Stream& stream);

}  // namespace amble::neat
