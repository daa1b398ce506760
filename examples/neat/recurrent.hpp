#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "amble/neat/genome.hpp"

/// A genome as a network that remembers: each step updates all nodes at once from the values before it.
/// Nodes are sigmoid, from −1 to 1.
class Recurrent {
 public:
  explicit Recurrent(const amble::neat::Genome& genome);

  void forget();
  /// The first output.
  double step(std::span<const double> inputs);

 private:
  struct Link {
    std::size_t from, to;
    double weight;
  };
  std::size_t inputs_;  // without the bias
  std::vector<Link> links_;
  std::vector<double> values_, sums_;
};
