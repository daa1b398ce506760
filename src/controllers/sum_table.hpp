#pragma once

#include <cstdint>
#include <vector>

#include "amble/controllers/lane_rows.hpp"

namespace amble::controllers {

/// Weighted sums of many neurons, Σ weight × value over the links that at least one lane expresses, laid out
/// so that a kernel reads them from front to back without a loop of unknown length.
struct SumTable {
  /// Neurons that follow each other, do not feed each other, and have equally many links.
  struct Group {
    int links, neurons;
  };
  std::vector<Group> groups;
  std::vector<std::uint32_t> neurons;  ///< in the order of the groups: where a neuron's rows begin, in floats
  std::vector<std::uint32_t> sources;  ///< of all links of the first neuron, of the second, …: the same
  LaneRows weights;                    ///< link by link for the first 16 lanes, then for the next 16
  int capacity = 0;                    ///< links that `weights` has room for
};

/// Fills a table, neuron by neuron.
class SumTableBuilder {
 public:
  SumTableBuilder(SumTable& table, int capacity, int lanes);

  /// Neurons from here on may depend on those before.
  void begin_level() { level_ = table_.groups.size(); }
  void add_neuron(std::uint32_t row, int links);
  /// The next link of the neuron added last; `weights`: of all lanes.
  void add_link(std::uint32_t source, const float* weights);

 private:
  SumTable& table_;
  int lanes_;
  std::size_t level_ = 0;  ///< the level's first group
};

}  // namespace amble::controllers
