#pragma once

#include <cstdint>
#include <vector>

#include "amble/controllers/lane_rows.hpp"

namespace amble::controllers {

/// Weighted sums of many neurons, Σ weight × value over the links that at least one lane expresses, laid out
/// so that a kernel reads them from front to back without a loop of unknown length.
struct SumTable {
  /// Neurons that follow each other and have equally many links.
  struct Group {
    int links, neurons;
  };
  std::vector<Group> groups;
  std::vector<std::uint32_t> neurons;  ///< in the order of the groups: where a neuron's rows begin, in floats
  std::vector<std::uint32_t> sources;  ///< of all links of the first neuron, of the second, …: the same
  /// Link by link for the first 16 lanes, then for the next 16.
  LaneRows weights;

  /// Begins a table of `links` links at most.
  void clear(int links, int lanes) {
    groups.clear();
    neurons.clear();
    sources.clear();
    const int blocks = (lanes + LaneRows::line_lanes - 1) / LaneRows::line_lanes;
    weights = LaneRows(links * blocks, LaneRows::line_lanes);
    capacity = links;
  }
  /// The next neuron.
  void add_neuron(std::uint32_t row) {
    neurons.push_back(row);
    groups.push_back({0, 1});
  }
  /// The next link of the last neuron; `row`: its weights in all lanes.
  void add_link(std::uint32_t source, const float* row, int lanes) {
    const int link = static_cast<int>(sources.size());
    for (int lane = 0; lane < lanes; ++lane)
      weights.at(lane / LaneRows::line_lanes * capacity + link, lane % LaneRows::line_lanes) = row[lane];
    sources.push_back(source);
    ++groups.back().links;
  }
  /// Ends the table.
  void join_groups() {
    std::size_t last = 0;
    for (std::size_t g = 1; g < groups.size(); ++g) {
      if (groups[g].links == groups[last].links)
        ++groups[last].neurons;
      else
        groups[++last] = groups[g];
    }
    if (!groups.empty()) groups.resize(last + 1);
  }

  int capacity = 0;
};

}  // namespace amble::controllers
