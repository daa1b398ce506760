#include "tests/neat/samples.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <set>

#include "amble/core/error.hpp"
#include "amble/neat/initial_genome.hpp"
#include "amble/neat/mutation.hpp"

namespace amble::neat {

Genome sample_genome(int inputs, int outputs, const std::vector<NodeGene>& hidden,
                     const std::vector<LinkGene>& links) {
  Genome genome;
  for (int i = 0; i < 1 + inputs + outputs; ++i) {
    const NodeKind kind = i == 0 ? NodeKind::bias : i <= inputs ? NodeKind::input : NodeKind::output;
    genome.nodes.push_back(
        {.id = static_cast<std::uint32_t>(i),
         .kind = kind,
         .activation = kind == NodeKind::output ? Activation::bipolar_sigmoid : Activation::linear});
  }
  genome.nodes.insert(genome.nodes.end(), hidden.begin(), hidden.end());
  genome.links = links;
  return genome;
}

Genome grown_genome(int inputs, int outputs, int mutations, bool recurrent, Innovations& innovations,
                    Stream& stream) {
  const Settings settings = lively_settings();
  Genome genome = initial_genome(settings.genome, inputs, outputs, innovations, stream);
  for (int i = 0; i < mutations; ++i) mutate(genome, settings, recurrent, innovations, stream);
  return genome;
}

Settings lively_settings() {
  Settings settings;
  settings.mutation.weights_share = 0.3;
  settings.mutation.add_link_share = 0.3;
  settings.mutation.add_node_share = 0.2;
  settings.mutation.delete_link_share = 0.2;
  return settings;
}

bool all_hidden_nodes_are_linked(const Genome& genome) {
  std::set<std::uint32_t> linked;
  for (const LinkGene& link : genome.links) linked.insert({link.from, link.to});
  return std::ranges::all_of(genome.nodes, [&](const NodeGene& node) {
    return node.kind != NodeKind::hidden || linked.contains(node.id);
  });
}

std::vector<Fitness> evaluate(const Population& population,
                              const std::function<double(const Genome&)>& objective) {
  std::vector<Fitness> fitness;
  for (const Genome& genome : population.genomes()) {
    const double value = objective(genome);
    fitness.push_back({.selection = value, .objective = value});
  }
  return fitness;
}

double weights_near_one_half(const Genome& genome) {
  double error = 0.0;
  for (const LinkGene& link : genome.links) error += (link.weight - 0.5) * (link.weight - 0.5);
  const auto links = static_cast<double>(genome.links.size());
  return 1.0 / (1.0 + error) + 0.01 * links;
}

double weights_in_steps(const Genome& genome) {
  return std::floor(20.0 * weights_near_one_half(genome)) / 20.0;
}

namespace {

double activated(Activation activation, double x) {
  switch (activation) {
    case Activation::bipolar_sigmoid:
      return 2.0 / (1.0 + std::exp(-x)) - 1.0;
    case Activation::gaussian:
      return 2.0 * std::exp(-6.25 * x * x) - 1.0;
    case Activation::sine:
      return std::sin(2.0 * x);
    case Activation::linear:
      break;
  }
  return std::abs(x);
}

/// Values of the nodes as far as they are known; node by node, each when it is first asked for.
class Values {
 public:
  Values(const Genome& genome, std::span<const double> inputs)
      : genome_(genome), known_(genome.nodes.size()) {
    known_[0] = 1.0;
    for (std::size_t i = 0; i < inputs.size(); ++i) known_[1 + i] = inputs[i];
  }

  double of(std::size_t node) {
    if (known_[node]) return *known_[node];
    double sum = 0.0;
    for (const LinkGene& link : genome_.links)
      if (link.enabled && link.to == genome_.nodes[node].id)
        sum += link.weight * of(static_cast<std::size_t>(genome_.index_of(link.from)));
    known_[node] = activated(genome_.nodes[node].activation, sum);
    return *known_[node];
  }

 private:
  const Genome& genome_;
  std::vector<std::optional<double>> known_;
};

}  // namespace

std::vector<double> feed_forward(const Genome& genome, std::span<const double> inputs) {
  Values values(genome, inputs);
  std::vector<double> outputs;
  for (std::size_t i = 0; i < genome.nodes.size(); ++i)
    if (genome.nodes[i].kind == NodeKind::output) outputs.push_back(values.of(i));
  return outputs;
}

std::string error_of(const std::function<void()>& action) {
  try {
    action();
  } catch (const UserError& error) {
    return error.what();
  }
  return "";
}

}  // namespace amble::neat
