#include "amble/io/settings_text.hpp"

#include <fmt/format.h>
#include <cmath>
#include <limits>

#include "amble/core/check.hpp"
#include "amble/core/index.hpp"
#include "amble/io/quoting.hpp"

namespace amble::io {
namespace {

constexpr double largest = std::numeric_limits<double>::max();

/// " from 0 to 1", or nothing if every value will do.
std::string bounds(Range range, bool infinity_is_a_value) {
  const bool below = std::abs(range.lowest) < largest, above = std::abs(range.highest) < largest;
  const bool infinity = std::isinf(range.lowest) || std::isinf(range.highest);
  if ((below && above) || (infinity_is_a_value && infinity && (below || above))) {
    return fmt::format(" from {} to {}", range.lowest, range.highest);
  }
  if (below) return fmt::format(" of at least {}", range.lowest);
  if (above) return fmt::format(" of at most {}", range.highest);
  return {};
}

}  // namespace

std::string expected_number(Range range) {
  const bool finite = range.lowest == -largest || range.highest == largest;
  return (finite ? "a finite number" : "a number") + bounds(range, true);
}
std::string expected_integer(Range range) {
  return "a whole number" + bounds(range, false);
}
std::string expected_numbers(Range range) {
  return "a list of numbers" + bounds(range, true);
}

std::string expected_choice(std::span<const std::string_view> names) {
  std::string text = "one of ";
  for (std::size_t i = 0; i < names.size(); ++i)
    text += fmt::format("{}\"{}\"", i == 0 ? "" : ", ", names[i]);
  return text;
}

bool in_range(Range range, double value) {
  return value >= range.lowest && value <= range.highest;
}

bool in_range(Range range, std::int64_t value) {
  // Bounds beyond ± 2^63 hold for every int64; the others compare exactly as long double.
  return static_cast<long double>(value) >= range.lowest && static_cast<long double>(value) <= range.highest;
}

void SettingsPrinter::number(std::string_view key, double& value, Range range, Doc doc) {
  put(key, toml_number(value), expected_number(range), doc);
}

void SettingsPrinter::integer(std::string_view key, std::int64_t& value, Range range, Doc doc) {
  put(key, std::to_string(value), expected_integer(range), doc);
}

void SettingsPrinter::flag(std::string_view key, bool& value, Doc doc) {
  put(key, value ? "true" : "false", expected_flag, doc);
}

void SettingsPrinter::text(std::string_view key, std::string& value, Doc doc) {
  put(key, toml_quoted(value), expected_text, doc);
}

void SettingsPrinter::texts(std::string_view key, std::vector<std::string>& values, Doc doc) {
  std::string list;
  for (const std::string& value : values) list += (list.empty() ? "" : ", ") + toml_quoted(value);
  put(key, fmt::format("[{}]", list), expected_texts, doc);
}

void SettingsPrinter::numbers(std::string_view key, std::vector<double>& values, Range range, Doc doc) {
  std::string list;
  for (const double value : values) list += (list.empty() ? "" : ", ") + toml_number(value);
  put(key, fmt::format("[{}]", list), expected_numbers(range), doc);
}

void SettingsPrinter::choice_index(std::string_view key, int& index, std::span<const std::string_view> names,
                                   Doc doc) {
  AMBLE_CHECK(index >= 0 && to_index(index) < names.size(), "an enum value without a name");
  put(key, toml_quoted(names[to_index(index)]), expected_choice(names), doc);
}

}  // namespace amble::io
