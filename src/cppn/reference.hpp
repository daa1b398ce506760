#pragma once

#include <span>
#include <vector>

#include "amble/cppn/network.hpp"
#include "amble/cppn/settings.hpp"
#include "amble/neat/genome.hpp"

namespace amble::cppn {

/// The reference implementation of Network: one point at a time, in double precision, with the functions of
/// <cmath>. It defines what a CPPN computes; tests, benchmarks and precision_sensitivity() use it.
class Reference {
 public:
  Reference(const neat::Genome& genome, const Settings& settings);

  /// `inputs` without the bias. With Settings::recurrent in Settings::passes_with(hidden nodes) synchronous
  /// passes, else in one, sources first.
  void evaluate(std::span<const double> inputs, std::span<double> outputs) const;

 private:
  struct Source {
    std::size_t node;
    double weight;
  };
  struct Node {
    std::size_t index;
    neat::Activation activation;
    std::vector<Source> sources;
  };
  bool put_sources_first(std::vector<bool> ready);
  double next_value(const Node& node, const std::vector<double>& values) const;

  std::size_t node_count_, input_count_ = 0, output_count_ = 0;
  int passes_ = 0;
  bool feed_forward_ = true;
  Linear linear_;
  std::vector<Node> nodes_;  ///< outputs and hidden; sources first if feed-forward
};

/// How far the outputs of a CPPN depend on the precision they are computed in: the largest change of any
/// output, as substrates use it (clamped to −1 … 1), at any of the points, when it is evaluated in double
/// precision (Reference) in place of single (Network). From 0 to 2. About 1e-6 where the CPPN has no cycle; a
/// CPPN with cycles can be chaotic, and then has no value beyond the precision it is computed in.
double precision_sensitivity(const neat::Genome& genome, const Settings& settings, const Points& points);

}  // namespace amble::cppn
