#include "amble/report/number_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "amble/figures/axis.hpp"

namespace amble::report {

int decimals_for(std::initializer_list<double> values) {
  double largest = 0.0;
  for (const double value : values) largest = std::max(largest, std::abs(value));
  // What rounds up to the next power of ten has its digits there.
  if (largest >= 99.95) return 0;
  if (largest >= 9.995) return 1;
  if (largest >= 0.9995) return 2;
  return 3;
}

std::string number_text(double value, int decimals) {
  return figures::label(value, decimals);
}

std::string number_text(double value) {
  return value == 0.0 ? "0" : number_text(value, decimals_for({value}));
}

std::string interval_text(const statistics::Interval& interval, int decimals) {
  return fmt::format("[{}, {}]", number_text(interval.lower, decimals),
                     number_text(interval.upper, decimals));
}

std::string estimate_text(double value, const std::optional<statistics::Interval>& interval,
                          std::string_view unit) {
  if (!interval) return number_text(value) + std::string(unit);
  const int decimals = decimals_for({value, interval->lower, interval->upper});
  return fmt::format("{}{} {}", number_text(value, decimals), unit, interval_text(*interval, decimals));
}

std::string p_number(double p) {
  if (p < 0.001) return "< 0.001";
  if (p > 0.99) return p == 1.0 ? "1" : "> 0.99";
  int decimals = p < 0.0995 ? 3 : 2;
  const auto on_a_level = [&](double level) {
    return p != level && number_text(p, decimals) == number_text(level, decimals);
  };
  while (decimals < 8 && (on_a_level(0.05) || on_a_level(0.01))) ++decimals;
  return number_text(p, decimals);
}

std::string p_text(double p) {
  const std::string number = p_number(p);
  return number.starts_with("<") || number.starts_with(">") ? "p " + number : "p = " + number;
}

std::string percent_text(double share) {
  return fmt::format("{:.0f} %", 100.0 * share);
}

std::string share_text(double share, const std::optional<statistics::Interval>& interval) {
  if (!interval) return percent_text(share);
  return fmt::format("{} {}", percent_text(share),
                     interval_text({100.0 * interval->lower, 100.0 * interval->upper}, 0));
}

std::string counted(std::size_t count, std::string_view noun) {
  return fmt::format("{} {}{}", count, noun, count == 1 ? "" : "s");
}

}  // namespace amble::report
