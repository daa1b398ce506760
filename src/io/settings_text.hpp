#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "amble/io/settings.hpp"

namespace amble::io {

// Texts for the allowed values of a setting, shared by error messages, comments in written configs and the
// table of settings.

inline constexpr std::string_view expected_flag = "true or false";
inline constexpr std::string_view expected_text = "text in quotes";
inline constexpr std::string_view expected_texts = "a list of texts in quotes";
inline constexpr std::string_view expected_table = "a table in braces";
inline constexpr std::string_view expected_tables = "a list of tables in braces";

/// "a number from 0 to 1"; "from 0 to inf" where infinity is a value; "a number" if there are no bounds.
std::string expected_number(Range range);
/// "a whole number from 2 to 9", "a whole number of at least 2", …
std::string expected_integer(Range range);
std::string expected_numbers(Range range);
/// "one of "absolute", "identity"".
std::string expected_choice(std::span<const std::string_view> names);

/// False for NaN.
bool in_range(Range range, double value);
bool in_range(Range range, std::int64_t value);

/// Formats every field as TOML and passes it, with the text for its allowed values, to put().
class SettingsPrinter : public SettingsVisitor {
 public:
  using SettingsVisitor::integer;

  void number(std::string_view key, double& value, Range range, Doc doc) final;
  void integer(std::string_view key, std::int64_t& value, Range range, Doc doc) final;
  void flag(std::string_view key, bool& value, Doc doc) final;
  void text(std::string_view key, std::string& value, Doc doc) final;
  void texts(std::string_view key, std::vector<std::string>& values, Doc doc) final;
  void numbers(std::string_view key, std::vector<double>& values, Range range, Doc doc) final;
  void choice_index(std::string_view key, int& index, std::span<const std::string_view> names, Doc doc) final;

 private:
  virtual void put(std::string_view key, std::string value, std::string_view expected, Doc doc) = 0;
};

}  // namespace amble::io
