#pragma once

#include <functional>
#include <span>
#include <string>
#include <vector>

#include "amble/core/random.hpp"
#include "amble/neat/innovations.hpp"
#include "amble/neat/population.hpp"

namespace amble::neat {

/// Bias 0, inputs, outputs (bipolar sigmoid), then the given hidden nodes and links.
Genome sample_genome(int inputs, int outputs, const std::vector<NodeGene>& hidden,
                     const std::vector<LinkGene>& links);

/// A genome grown by `mutations` random structural mutations, numbered by `innovations`.
Genome grown_genome(int inputs, int outputs, int mutations, bool recurrent, Innovations& innovations,
                    Stream& stream);

/// Settings under which structure changes often.
Settings lively_settings();

/// Whether every hidden node is touched by a link.
bool all_hidden_nodes_are_linked(const Genome& genome);

/// Fitness of a genome, as fitness of the whole population, objective and selection alike.
std::vector<Fitness> evaluate(const Population& population,
                              const std::function<double(const Genome&)>& objective);

/// A smooth objective without transcendental functions: > 0, larger for weights near 0.5 and for more links.
double weights_near_one_half(const Genome& genome);

/// The same rounded down to whole twentieths, so that species stagnate before they improve.
double weights_in_steps(const Genome& genome);

/// Outputs of a feed-forward genome, in double precision.
std::vector<double> feed_forward(const Genome& genome, std::span<const double> inputs);

/// What the UserError says that `action` throws, or "" if it throws none.
std::string error_of(const std::function<void()>& action);

}  // namespace amble::neat
