#pragma once

#include <string>
#include <string_view>

namespace amble::io {

/// `text` for the content or an attribute's value of an XML, SVG or HTML element: <, >, &, " and ' become
/// entities; control characters, which XML forbids, become U+FFFD. Tabs and line feeds stay.
std::string escape_xml(std::string_view text);

/// `text` in quotes, escaped as TOML requires.
std::string toml_quoted(std::string_view text);

/// Whether a key needs no quotes in TOML.
bool is_bare_key(std::string_view key);
/// A key as a document and paths of keys have it: in quotes where it is not bare.
std::string toml_key(std::string_view key);

/// The shortest TOML number that reads back to the same bits; always with a point, an exponent, or "inf".
/// Never NaN.
std::string toml_number(double value);

/// `text` in single quotes, within which shells take everything literally.
std::string shell_quoted(std::string_view text);

/// `text` as one word of a command that a reader may paste into a shell (bash, zsh, dash, fish): as it is
/// where that works, else in quotes. With control characters it is $'…', which bash and zsh read, so that it
/// stays on one line. For all commands that are printed.
std::string shell_word(std::string_view text);

}  // namespace amble::io
