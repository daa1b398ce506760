#pragma once

#include <string>
#include <string_view>

namespace amble::io {

/// `text` in quotes, escaped as TOML requires.
std::string toml_quoted(std::string_view text);

/// Whether a key needs no quotes in TOML.
bool is_bare_key(std::string_view key);
/// A key as a document and paths of keys have it: in quotes where it is not bare.
std::string toml_key(std::string_view key);

/// The shortest TOML number that reads back to the same bits; always with a point, an exponent, or "inf".
/// Never NaN.
std::string toml_number(double value);

}  // namespace amble::io
