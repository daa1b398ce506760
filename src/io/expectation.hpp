#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>

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

}  // namespace amble::io
