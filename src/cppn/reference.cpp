#include "amble/cppn/reference.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "amble/core/check.hpp"
#include "amble/core/index.hpp"
#include "amble/cppn/activation.hpp"

namespace amble::cppn {
namespace {

double activated(neat::Activation function, Linear linear, double x) {
  switch (function) {
    case neat::Activation::bipolar_sigmoid:
      return 2.0 / (1.0 + std::exp(-x)) - 1.0;
    case neat::Activation::gaussian:
      return 2.0 * std::exp(-(2.5 * x) * (2.5 * x)) - 1.0;
    case neat::Activation::sine:
      return std::sin(2.0 * x);
    case neat::Activation::linear:
      break;
  }
  const double limit = largest_linear;
  return std::clamp(linear == Linear::absolute ? std::fabs(x) : x, -limit, limit);
}

}  // namespace

Reference::Reference(const neat::Genome& genome, const Settings& settings)
    : node_count_(genome.nodes.size()), linear_(settings.linear) {
  std::vector<bool> ready(node_count_, false);
  for (std::size_t i = 0; i < node_count_; ++i) {
    const neat::NodeGene& gene = genome.nodes[i];
    input_count_ += gene.kind == neat::NodeKind::input;
    output_count_ += gene.kind == neat::NodeKind::output;
    ready[i] = gene.kind == neat::NodeKind::bias || gene.kind == neat::NodeKind::input;
    if (!ready[i]) nodes_.push_back({i, gene.activation, {}});
  }
  passes_ = settings.passes_with(static_cast<int>(nodes_.size() - output_count_));
  for (Node& node : nodes_)
    for (const neat::LinkGene& link : genome.links)
      if (link.enabled && link.to == genome.nodes[node.index].id)
        node.sources.push_back({to_index(genome.index_of(link.from)), link.weight});

  feed_forward_ = !settings.recurrent;
  if (feed_forward_) AMBLE_CHECK(put_sources_first(std::move(ready)), "a feed-forward CPPN has a cycle");
}

bool Reference::put_sources_first(std::vector<bool> ready) {
  // Topological order: each round moves the first node whose sources all precede it; where there is none, the
  // rest depends on a cycle.
  for (auto position = nodes_.begin(); position != nodes_.end(); ++position) {
    const auto next = std::find_if(position, nodes_.end(), [&](const Node& node) {
      return std::all_of(node.sources.begin(), node.sources.end(),
                         [&](const Source& s) { return ready[s.node]; });
    });
    if (next == nodes_.end()) return false;
    ready[next->index] = true;
    std::rotate(position, next, next + 1);
  }
  return true;
}

double Reference::next_value(const Node& node, const std::vector<double>& values) const {
  double sum = 0.0;
  for (const Source& source : node.sources) sum += source.weight * values[source.node];
  return activated(node.activation, linear_, sum);
}

void Reference::evaluate(std::span<const double> inputs, std::span<double> outputs) const {
  AMBLE_CHECK(inputs.size() == input_count_ && outputs.size() == output_count_,
              "wrong number of inputs or outputs");
  std::vector<double> values(node_count_, 0.0);
  values[0] = 1.0;
  std::copy(inputs.begin(), inputs.end(), values.begin() + 1);
  if (feed_forward_) {
    for (const Node& node : nodes_) values[node.index] = next_value(node, values);
  } else {
    // v_i(t) = f_i(Σ_j w_ij v_j(t − 1)).
    std::vector<double> next = values;
    for (int pass = 0; pass < passes_; ++pass) {
      for (const Node& node : nodes_) next[node.index] = next_value(node, values);
      values.swap(next);
    }
  }
  std::copy_n(values.begin() + 1 + static_cast<std::ptrdiff_t>(input_count_), output_count_, outputs.begin());
}

double precision_sensitivity(const neat::Genome& genome, const Settings& settings, const Points& points) {
  const Network single(genome, settings);
  const Reference reference(genome, settings);
  std::vector<float> results(to_index(single.outputs()) * to_index(points.capacity()));
  single.evaluate(points, results);
  std::vector<double> inputs(to_index(points.inputs())), outputs(to_index(single.outputs()));
  double largest = 0.0;
  for (int point = 0; point < points.count(); ++point) {
    for (int i = 0; i < points.inputs(); ++i) inputs[to_index(i)] = points.get(point, i);
    reference.evaluate(inputs, outputs);
    for (std::size_t output = 0; output < outputs.size(); ++output) {
      const double value = results[output * to_index(points.capacity()) + to_index(point)];
      largest =
          std::max(largest, std::abs(std::clamp(value, -1.0, 1.0) - std::clamp(outputs[output], -1.0, 1.0)));
    }
  }
  return largest;
}

}  // namespace amble::cppn
