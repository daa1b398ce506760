#include "amble/statistics/distributions.hpp"

#include <boost/math/distributions/beta.hpp>
#include <boost/math/distributions/chi_squared.hpp>
#include <boost/math/distributions/fisher_f.hpp>
#include <boost/math/distributions/normal.hpp>
#include <boost/math/distributions/students_t.hpp>

#include "amble/core/check.hpp"

namespace amble::statistics {
namespace {

namespace math = boost::math;

}  // namespace

double normal_cdf(double z) {
  return math::cdf(math::normal_distribution<>(), z);
}

double normal_upper_tail(double z) {
  return math::cdf(math::complement(math::normal_distribution<>(), z));
}

double normal_quantile(double probability) {
  return math::quantile(math::normal_distribution<>(), probability);
}

double student_upper_tail(double t, double degrees_of_freedom) {
  return math::cdf(math::complement(math::students_t_distribution<>(degrees_of_freedom), t));
}

double student_quantile(double probability, double degrees_of_freedom) {
  return math::quantile(math::students_t_distribution<>(degrees_of_freedom), probability);
}

double chi_square_upper_tail(double x, double degrees_of_freedom) {
  return math::cdf(math::complement(math::chi_squared_distribution<>(degrees_of_freedom), x));
}

double f_upper_tail(double f, double first_degrees_of_freedom, double second_degrees_of_freedom) {
  return math::cdf(math::complement(
      math::fisher_f_distribution<>(first_degrees_of_freedom, second_degrees_of_freedom), f));
}

double beta_quantile(double probability, double a, double b) {
  return math::quantile(math::beta_distribution<>(a, b), probability);
}

double two_sided_z(double confidence) {
  AMBLE_CHECK(confidence > 0.0 && confidence < 1.0, "confidence is between 0 and 1");
  return normal_quantile(0.5 + 0.5 * confidence);
}

}  // namespace amble::statistics
