#include "recurrent.hpp"

#include <algorithm>
#include <cmath>

using namespace amble;

Recurrent::Recurrent(const neat::Genome& genome)
    : inputs_(static_cast<std::size_t>(genome.count(neat::NodeKind::input))),
      values_(genome.nodes.size()),
      sums_(genome.nodes.size()) {
  for (const neat::LinkGene& link : genome.links)
    if (link.enabled)
      links_.push_back({static_cast<std::size_t>(genome.index_of(link.from)),
                        static_cast<std::size_t>(genome.index_of(link.to)), link.weight});
  forget();
}

void Recurrent::forget() {
  std::ranges::fill(values_, 0.0);
  values_[0] = 1.0;  // the bias
}

double Recurrent::step(std::span<const double> inputs) {
  std::ranges::copy(inputs, values_.begin() + 1);
  std::ranges::fill(sums_, 0.0);
  for (const Link& link : links_) sums_[link.to] += link.weight * values_[link.from];
  for (std::size_t node = 1 + inputs_; node < values_.size(); ++node)
    values_[node] = std::tanh(0.5 * sums_[node]);
  return values_[1 + inputs_];
}
