#include "amble/exporting/c_text.hpp"

#include <algorithm>
#include <cmath>

#include "amble/core/check.hpp"

namespace amble::exporting {
namespace {

constexpr std::size_t line_length = 100;

bool is_ascii_alnum(char c) {
  return (c >= '0' && c <= '9') || (c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z');
}

std::string with_point(std::string text) {
  return text.find_first_of(".e") == std::string::npos ? text + ".0" : text;
}

}  // namespace

std::string c_identifier(std::string_view text) {
  std::string name;
  for (const char c : text) name += is_ascii_alnum(c) ? c : '_';
  const bool begins_with_letter = !name.empty() && name[0] != '_' && (name[0] < '0' || name[0] > '9');
  return begins_with_letter ? name : "amble_" + name;
}

std::string upper_case(std::string text) {
  for (char& c : text)
    if (c >= 'a' && c <= 'z') c = static_cast<char>(c - 'a' + 'A');
  return text;
}

std::string in_comment(std::string_view text) {
  std::string safe;
  for (const char c : text) {
    const char next = c >= ' ' && c <= '~' ? c : '?';
    const char before = safe.empty() ? ' ' : safe.back();
    if ((before == '*' && next == '/') || (before == '/' && next == '*') || (before == '?' && next == '?'))
      safe += ' ';
    safe += next;
  }
  return safe;
}

std::string c_string(std::string_view text) {
  std::string literal = "\"";
  for (const char c : in_comment(text)) {
    if (c == '"' || c == '\\') literal += '\\';
    literal += c;
  }
  return literal + '"';
}

std::string c_float(float value) {
  AMBLE_CHECK(std::isfinite(value), "C has no literals for numbers that are not finite");
  return with_point(fmt::format("{}", value)) + "f";
}

std::string c_double(double value) {
  AMBLE_CHECK(std::isfinite(value), "C has no literals for numbers that are not finite");
  return with_point(fmt::format("{}", value));
}

std::string UniqueNames::of(std::string_view text) {
  const std::string name = c_identifier(text);
  std::string unique = name;
  for (int k = 2; !used_.insert(unique).second; ++k) unique = fmt::format("{}_{}", name, k);
  return unique;
}

std::string unsigned_type(std::size_t largest) {
  return largest <= 0xff ? "uint8_t" : largest <= 0xffff ? "uint16_t" : "uint32_t";
}

std::string replaced(std::string_view text, std::string_view key, std::string_view value) {
  std::string result(text);
  for (std::size_t at = result.find(key); at != std::string::npos; at = result.find(key, at + value.size()))
    result.replace(at, key.size(), value);
  return result;
}

std::string with_prefix(std::string_view text, const std::string& prefix) {
  const std::string upper = upper_case(prefix);
  std::string filled;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const bool is_mark = text[i] == '$' && i + 1 < text.size();
    if (!is_mark)
      filled += text[i];
    else
      filled += text[++i] == 'P' ? upper : prefix;
  }
  return filled;
}

void CText::elements(const std::vector<std::string>& elements, std::string_view margin) {
  std::string line(margin);
  for (std::size_t i = 0; i < elements.size(); ++i) {
    const std::string piece = elements[i] + (i + 1 < elements.size() ? "," : "");
    if (line.size() + piece.size() + 1 > line_length && line.size() > margin.size()) {
      text_ += line + "\n";
      line = margin;
    }
    line += (line.size() > margin.size() ? " " : "") + piece;
  }
  text_ += line + "\n";
}

void CText::array(std::string_view declaration, const std::vector<std::string>& elements) {
  line("{} = {{", declaration);
  this->elements(elements.empty() ? std::vector<std::string>{"0"} : elements, "  ");
  line("}};");
}

void CText::array(std::string_view declaration, const std::vector<std::vector<std::string>>& rows) {
  line("{} = {{", declaration);
  for (std::size_t row = 0; row < rows.size(); ++row) {
    line("  {{");
    elements(rows[row], "    ");
    line("  }}{}", row + 1 < rows.size() ? "," : "");
  }
  line("}};");
}

void CText::comment_lines(const std::vector<std::string>& lines) {
  for (const std::string& text : lines) {
    std::string left = in_comment(text);
    const std::size_t margin = std::min(left.find_first_not_of(' '), left.size());
    // Longer lines go on indented, from the last space that is not too far.
    while (left.size() > line_length - 3) {
      const std::size_t space = left.rfind(' ', line_length - 3);
      if (space == std::string::npos || space <= margin + 2) break;
      text_ += " * " + left.substr(0, space) + "\n";
      left = std::string(margin + 2, ' ') + left.substr(space + 1);
    }
    text_ += left.empty() ? " *\n" : " * " + left + "\n";
  }
}

}  // namespace amble::exporting
