#pragma once

#include <cstddef>
#include <vector>

#include "amble/search/behaviours.hpp"

namespace amble::search {

/// Numbers that a squared distance, as exact_squared_distance() computes it, is not below and not above.
struct Bounds {
  double lower = 0.0, upper = 0.0;
};

/// Longest behaviour for which the error of a float32 dot product can be bounded usefully.
inline constexpr std::size_t longest_behaviour = 1000000;

/// Bounds on the squared distances |a|² + |b|² − 2ab between every row of `a` and every row of `b`, from one
/// matrix product (OpenBLAS). Their last bits depend on CPU and library, so they may only say whose exact
/// distance need not be computed.
///
/// While the product is computed, OpenBLAS is held to one thread: it would otherwise take all cores of the
/// machine, whatever number of workers the user asked for. The number of threads belongs to the whole process
/// and is put back afterwards.
class DistanceEstimates {
 public:
  DistanceEstimates(const Behaviours& a, const Behaviours& b);

  Bounds between(std::size_t row_a, std::size_t row_b) const;

 private:
  std::vector<double> squared_norms_a_, squared_norms_b_;
  std::vector<float> products_;  ///< a × bᵀ, row after row
  double float_error_, double_error_, underflow_;
};

}  // namespace amble::search
