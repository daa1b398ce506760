#pragma once

#include <cstddef>
#include <vector>

#include "amble/search/behaviours.hpp"

namespace amble::search {

/// Lower and upper bound of a squared distance as exact_squared_distance() computes it.
struct Bounds {
  double lower = 0.0, upper = 0.0;
};

/// Longest behaviour for which the error of a float32 dot product can be bounded usefully.
inline constexpr std::size_t longest_behaviour = 1000000;

/// Bounds on the squared distances |a|² + |b|² − 2ab between every row of `a` and every row of `b`, from one
/// matrix product (OpenBLAS). Their last bits depend on CPU and library, so they may only exclude rows whose
/// exact distance is then not computed.
///
/// OpenBLAS is limited to one thread during the product; otherwise it would use all cores, whatever `--jobs`
/// says. The number of threads is global to the process and is restored afterwards.
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
