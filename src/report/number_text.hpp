#pragma once

#include <cstddef>
#include <initializer_list>
#include <optional>
#include <string>
#include <string_view>

#include "amble/statistics/descriptive.hpp"

namespace amble::report {

/// Decimals with which the largest of some numbers has three significant digits: 0 from 100 on, at most 3.
int decimals_for(std::initializer_list<double> values);

/// Three significant digits, a true minus sign, no exponent: "12.3", "0.045", "10800".
std::string number_text(double value);
/// The same with a given number of decimals; whole numbers stay whole with 0.
std::string number_text(double value, int decimals);
/// "[1.20, 3.40]".
std::string interval_text(const statistics::Interval& interval, int decimals);
/// "2.05 m [1.20, 2.90]"; without an interval "2.05 m".
std::string estimate_text(double value, const std::optional<statistics::Interval>& interval,
                          std::string_view unit);

/// "< 0.001", "0.003", "0.21". Never rounded onto 0.05 or 0.01 from one side.
std::string p_number(double p);
/// "p = 0.003", "p < 0.001".
std::string p_text(double p);

/// "45 %".
std::string percent_text(double share);

/// "45 % [23, 68]"; without an interval "45 %".
std::string share_text(double share, const std::optional<statistics::Interval>& interval);

/// "3 runs", "1 run".
std::string counted(std::size_t count, std::string_view noun);

}  // namespace amble::report
