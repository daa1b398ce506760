#pragma once

#include <functional>
#include <vector>

namespace amble::morphology {

/// A local minimum of `cost` within bounds, from a point on, by pattern search (Hooke and Jeeves): steps of
/// each angle, which are halved where none pays, down to 1e-5 rad. `best` becomes its cost.
std::vector<double> lower_cost(const std::function<double(const std::vector<double>&)>& cost,
                               std::vector<double> at, const std::vector<double>& lower,
                               const std::vector<double>& upper, double& best);

/// The n-th number of a sequence that fills [0, 1) evenly (Halton), for a prime base.
double evenly(int n, int base);

}  // namespace amble::morphology
