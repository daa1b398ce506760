#pragma once

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <optional>
#include <vector>

#include "amble/statistics/descriptive.hpp"

namespace amble::statistics::tests {

using Json = nlohmann::ordered_json;
using Sample = std::vector<double>;

/// tests/statistics/oracles.json, as make_oracles wrote it from SciPy and R.
const Json& oracles();

/// "near" to a relative error of 1e-9, or to an absolute one where an expected 0 has none.
testing::AssertionResult is_near(double value, const Json& expected, double absolute = 0.0);
testing::AssertionResult is_near(const Interval& value, const Json& lower, const Json& upper,
                                 double absolute = 0.0);

/// Both have a value, which are near; or neither has.
testing::AssertionResult agrees(const std::optional<double>& value, const Json& expected);

}  // namespace amble::statistics::tests
