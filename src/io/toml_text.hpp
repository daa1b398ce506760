#pragma once

#include <string>
#include <string_view>

namespace amble::io {

/// `text` in quotes, escaped where TOML asks for it.
std::string toml_quoted(std::string_view text);

/// Whether a key may stand in TOML without quotes.
bool is_bare_key(std::string_view key);

/// The shortest TOML number that reads back to the same bits; always with a point, an exponent, or "inf".
/// Never NaN.
std::string toml_number(double value);

}  // namespace amble::io
