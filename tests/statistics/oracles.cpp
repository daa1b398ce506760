#include "tests/statistics/oracles.hpp"

#include <cmath>
#include <fstream>
#include <string>

namespace amble::statistics::tests {

const Json& oracles() {
  static const Json all =
      Json::parse(std::ifstream(std::string(AMBLE_SOURCE_DIR) + "/tests/statistics/oracles.json"));
  return all;
}

testing::AssertionResult is_near(double value, const Json& expected, double absolute) {
  if (!expected.is_number()) return testing::AssertionFailure() << "no number expected: " << expected;
  const double wanted = expected.get<double>();
  // Written so that NaN fails.
  if (std::abs(value - wanted) <= 1e-9 * std::abs(wanted) + absolute) return testing::AssertionSuccess();
  return testing::AssertionFailure() << Json(value) << " instead of " << expected;
}

testing::AssertionResult is_near(const Interval& value, const Json& lower, const Json& upper,
                                 double absolute) {
  const auto first = is_near(value.lower, lower, absolute);
  return first ? is_near(value.upper, upper, absolute) : first;
}

testing::AssertionResult agrees(const std::optional<double>& value, const Json& expected) {
  if (value) return is_near(*value, expected);
  if (expected.is_null()) return testing::AssertionSuccess();
  return testing::AssertionFailure() << "nothing instead of " << expected;
}

}  // namespace amble::statistics::tests
