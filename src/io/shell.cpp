#include "amble/io/shell.hpp"

#include <algorithm>

namespace amble::io {
namespace {

bool is_plain(char c) {
  // Bytes of UTF-8 beyond ASCII are letters to every shell.
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') ||
         std::string_view("/._-+,:@%").find(c) != std::string_view::npos ||
         (static_cast<unsigned char>(c) & 0x80) != 0;
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
  return !word.empty() && std::ranges::all_of(word, is_plain) ? word : shell_quoted(word);
}

}  // namespace amble::io
