#pragma once

#include <map>
#include <vector>

#include "amble/core/index.hpp"
#include "amble/cppn/network.hpp"

namespace amble::substrate {

/// Collects the points at which a CPPN will be queried; equal points are one.
class QueryPoints {
 public:
  /// Index of the point with these inputs.
  int add(const std::vector<float>& inputs) {
    const auto [entry, is_new] = index_.try_emplace(inputs, static_cast<int>(in_order_.size()));
    if (is_new) in_order_.push_back(inputs);
    return entry->second;
  }

  cppn::Points points(int inputs) const {
    cppn::Points points(inputs, static_cast<int>(in_order_.size()));
    for (std::size_t i = 0; i < in_order_.size(); ++i)
      for (int k = 0; k < inputs; ++k) points.set(static_cast<int>(i), k, in_order_[i][to_index(k)]);
    return points;
  }

 private:
  std::map<std::vector<float>, int> index_;
  std::vector<std::vector<float>> in_order_;
};

}  // namespace amble::substrate
