// Without Boost, which wants threads: to the last bits but one, so that nothing that must be the same bits as
// elsewhere may use it.
#include <cmath>
#include <numbers>

#include "amble/statistics/distributions.hpp"

namespace amble::statistics {

double normal_cdf(double z) {
  return 0.5 * std::erfc(-z / std::numbers::sqrt2);
}

}  // namespace amble::statistics
