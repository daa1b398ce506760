#include "amble/io/settings_printer.hpp"

#include <fmt/format.h>

#include "amble/core/check.hpp"
#include "amble/core/index.hpp"
#include "amble/io/expectation.hpp"
#include "amble/io/toml_text.hpp"

namespace amble::io {

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
