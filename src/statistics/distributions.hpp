#pragma once

namespace amble::statistics {

/// Quantiles and tails of the distributions that tests and intervals need, by Boost.Math. Probabilities are
/// in (0, 1), degrees of freedom positive (and not necessarily whole), arguments finite.

double normal_cdf(double z);
double normal_upper_tail(double z);
double normal_quantile(double probability);

/// P(T > t).
double student_upper_tail(double t, double degrees_of_freedom);
double student_quantile(double probability, double degrees_of_freedom);

/// P(X > x), x ≥ 0.
double chi_square_upper_tail(double x, double degrees_of_freedom);

/// P(F > f), f ≥ 0.
double f_upper_tail(double f, double first_degrees_of_freedom, double second_degrees_of_freedom);

double beta_quantile(double probability, double a, double b);

/// z such that a standard normal variable is in [−z, z] with probability `confidence`, which is in (0, 1).
double two_sided_z(double confidence);

}  // namespace amble::statistics
