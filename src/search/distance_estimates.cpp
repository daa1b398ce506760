#include "amble/search/distance_estimates.hpp"

#ifdef AMBLE_OPENBLAS
#include <cblas.h>
#endif

#include <array>
#include <cmath>
#include <limits>

#include "amble/core/check.hpp"

namespace amble::search {
namespace {

#ifdef AMBLE_OPENBLAS
class OneBlasThread {
 public:
  OneBlasThread() : before_(openblas_get_num_threads()) { openblas_set_num_threads(1); }
  ~OneBlasThread() { openblas_set_num_threads(before_); }
  OneBlasThread(const OneBlasThread&) = delete;
  OneBlasThread& operator=(const OneBlasThread&) = delete;

 private:
  int before_;
};

/// a × bᵀ
std::vector<float> multiply(const Behaviours& a, const Behaviours& b) {
  std::vector<float> products(a.rows() * b.rows());
  if (products.empty()) return products;
  const OneBlasThread one_thread;
  const auto rows_a = static_cast<int>(a.rows()), rows_b = static_cast<int>(b.rows()),
             length = static_cast<int>(a.length());
  cblas_sgemm(CblasRowMajor, CblasNoTrans, CblasTrans, rows_a, rows_b, length, 1.0f, a.data(), length,
              b.data(), length, 0.0f, products.data(), rows_b);
  return products;
}

#else
/// The same, by loops, in eight sums at a time.
float dot(std::span<const float> a, std::span<const float> b) {
  std::array<float, 8> sums{};
  std::size_t i = 0;
  for (; i + sums.size() <= a.size(); i += sums.size())
    for (std::size_t k = 0; k < sums.size(); ++k) sums[k] += a[i + k] * b[i + k];
  for (std::size_t k = 0; i < a.size(); ++i, ++k) sums[k] += a[i] * b[i];
  float sum = 0.0f;
  for (const float part : sums) sum += part;
  return sum;
}

std::vector<float> multiply(const Behaviours& a, const Behaviours& b) {
  std::vector<float> products;
  products.reserve(a.rows() * b.rows());
  for (std::size_t i = 0; i < a.rows(); ++i)
    for (std::size_t j = 0; j < b.rows(); ++j) products.push_back(dot(a.row(i), b.row(j)));
  return products;
}
#endif

template <typename T>
constexpr double unit_roundoff = static_cast<double>(std::numeric_limits<T>::epsilon()) / 2.0;

}  // namespace

DistanceEstimates::DistanceEstimates(const Behaviours& a, const Behaviours& b)
    : squared_norms_a_(a.squared_norms().begin(), a.squared_norms().end()),
      squared_norms_b_(b.squared_norms().begin(), b.squared_norms().end()),
      products_(multiply(a, b)) {
  AMBLE_CHECK(a.length() == b.length() && a.length() <= longest_behaviour, "behaviours have one length");
  const double n = static_cast<double>(a.length());
  // A float32 dot product of n terms, summed in any order and fused or not, has an error of at most
  // γ_n |a| |b|, γ_n = n u / (1 − n u) (Higham, Accuracy and Stability of Numerical Algorithms, 2002,
  // sec. 3.1), plus underflow. It enters the distance with a factor of 2; 1 % more covers the rounding of the
  // norms.
  const double nu = n * unit_roundoff<float>;
  float_error_ = 2.02 * nu / (1.0 - nu);
  underflow_ = 2.0 * n * static_cast<double>(std::numeric_limits<float>::min());
  // The same bound in double precision, in units of u (|a|² + |b|²): n for the norms, 2 n for the exact
  // distance, which is at most 2 (|a|² + |b|²), and a few for the sum of the three terms.
  double_error_ = 4.0 * (n + 4.0) * unit_roundoff<double>;
}

Bounds DistanceEstimates::between(std::size_t row_a, std::size_t row_b) const {
  const double norm_a = squared_norms_a_[row_a], norm_b = squared_norms_b_[row_b];
  const auto product = static_cast<double>(products_[row_a * squared_norms_b_.size() + row_b]);
  // After an overflow the product is infinite or NaN and bounds nothing.
  if (!std::isfinite(product)) return {0.0, std::numeric_limits<double>::infinity()};
  // |a − b|² = |a|² + |b|² − 2 a·b, ± the error bounds of the constructor.
  const double estimate = norm_a + norm_b - 2.0 * product;
  const double slack =
      float_error_ * std::sqrt(norm_a * norm_b) + double_error_ * (norm_a + norm_b) + underflow_;
  return {estimate - slack, estimate + slack};
}

}  // namespace amble::search
