#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace amble::search {

/// Behaviour vectors of one length as a row-major float32 matrix, for BLAS.
class Behaviours {
 public:
  /// Address space for `capacity` rows is taken at once, so rows never move; memory is used as rows come in.
  Behaviours(std::size_t length, std::size_t capacity);

  std::size_t rows() const { return squared_norms_.size(); }
  std::size_t length() const { return length_; }
  /// AMBLE_CHECK: the length, finite numbers, at most `capacity` rows.
  void append(std::span<const float> row);

  std::span<const float> row(std::size_t r) const { return {values_.data() + r * length_, length_}; }
  const float* data() const { return values_.data(); }
  /// Σ x² of each row, in double precision.
  std::span<const double> squared_norms() const { return squared_norms_; }

 private:
  std::size_t length_;
  std::vector<float> values_;
  std::vector<double> squared_norms_;
};

/// Σ (a_i − b_i)² in double precision, summed in a fixed order: the same bits on every CPU.
double exact_squared_distance(std::span<const float> a, std::span<const float> b);

}  // namespace amble::search
