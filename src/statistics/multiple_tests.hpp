#pragma once

#include <span>
#include <vector>

namespace amble::statistics {

/// Holm's step-down adjustment (1979) of the p values of one family of tests, in their order. Rejecting where
/// the adjusted value is at most α keeps the probability of any false rejection at most α, however the tests
/// depend on each other. Values are in [0, 1]; tests that could not be made are not part of the family. An
/// empty family stays empty.
std::vector<double> holm(std::span<const double> p);

}  // namespace amble::statistics
