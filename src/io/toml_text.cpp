#include "amble/io/toml_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "amble/core/check.hpp"

namespace amble::io {

std::string toml_quoted(std::string_view text) {
  std::string quoted = "\"";
  for (const char c : text) {
    const auto byte = static_cast<unsigned char>(c);
    if (c == '"' || c == '\\') {
      quoted += {'\\', c};
    } else if (c == '\n') {
      quoted += "\\n";
    } else if (c == '\t') {
      quoted += "\\t";
    } else if (byte < 0x20 || byte == 0x7f) {
      quoted += fmt::format("\\u{:04X}", byte);
    } else {
      quoted += c;
    }
  }
  return quoted += '"';
}

bool is_bare_key(std::string_view key) {
  return !key.empty() && std::all_of(key.begin(), key.end(), [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' || c == '-';
  });
}

std::string toml_key(std::string_view key) {
  return is_bare_key(key) ? std::string(key) : toml_quoted(key);
}

std::string toml_number(double value) {
  AMBLE_CHECK(!std::isnan(value), "NaN is not a setting");
  std::string text = fmt::format("{}", value);
  if (text.find_first_of(".ei") == std::string::npos) text += ".0";
  return text;
}

}  // namespace amble::io
