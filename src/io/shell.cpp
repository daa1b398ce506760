#include "amble/io/shell.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace amble::io {
namespace {

bool is_plain(char c) {
  // Bytes of UTF-8 beyond ASCII are letters to every shell.
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') ||
         std::string_view("/._-+,:@%").find(c) != std::string_view::npos ||
         (static_cast<unsigned char>(c) & 0x80) != 0;
}

bool is_control(char c) {
  return static_cast<unsigned char>(c) < 0x20 || c == 0x7f;
}

/// As $'…', in which a backslash begins a code: the word stays on one line.
std::string with_codes(std::string_view text) {
  std::string quoted = "$'";
  for (const char c : text) {
    if (c == '\'' || c == '\\')
      quoted += {'\\', c};
    else if (c == '\n')
      quoted += "\\n";
    else if (c == '\t')
      quoted += "\\t";
    else if (is_control(c))
      quoted += fmt::format("\\{:03o}", static_cast<unsigned char>(c));
    else
      quoted += c;
  }
  return quoted + "'";
}

}  // namespace

std::string shell_quoted(std::string_view text) {
  std::string quoted = "'";
  for (const char c : text) {
    if (c == '\'')
      quoted += "'\\''";
    else
      quoted += c;
  }
  return quoted + "'";
}

std::string shell_word(std::string_view text) {
  // A name that begins with a hyphen would be taken for an option.
  const std::string word = (text.starts_with('-') ? "./" : "") + std::string(text);
  if (std::ranges::any_of(word, is_control)) return with_codes(word);
  return !word.empty() && std::ranges::all_of(word, is_plain) ? word : shell_quoted(word);
}

}  // namespace amble::io
