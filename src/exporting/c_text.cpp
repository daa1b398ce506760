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

/// U+00C0 … U+017F, Latin letters with marks, without them; "_" is no letter.
constexpr char32_t first_latin = 0xc0;
constexpr std::string_view plain_latin =
    "A A A A Ae Aa Ae C E E E E I I I I D N O O O O Oe _ Oe U U U Ue Y Th ss a a a a ae aa ae c e e "
    "e e i i i i d n o o o o oe _ oe u u u ue y th y A a A a A a C c C c C c C c D d D d E e E e E e "
    "E e E e G g G g G g G g H h H h I i I i I i I i I i IJ ij J j K k k L l L l L l L l L l N n N n "
    "N n n N n O o O o O o Oe oe R r R r R r S s S s S s S s T t T t T t U u U u U u U u U u U u W w "
    "Y y Y Z z Z z Z z s ";

/// Takes a character from the front of UTF-8; a byte that is none comes back as U+FFFD.
char32_t take_character(std::string_view& text) {
  const auto first = static_cast<unsigned char>(text[0]);
  const std::size_t bytes = first < 0x80 ? 1 : first < 0xc2 ? 0 : first < 0xe0 ? 2 : first < 0xf0 ? 3 : 4;
  char32_t character = bytes < 2 ? first : first & (0x7fU >> bytes);
  bool whole = bytes > 0 && first < 0xf5 && bytes <= text.size();
  for (std::size_t i = 1; whole && i < bytes; ++i) {
    whole = (static_cast<unsigned char>(text[i]) & 0xc0U) == 0x80;
    character = character << 6U | (static_cast<unsigned char>(text[i]) & 0x3fU);
  }
  text.remove_prefix(whole ? bytes : 1);
  return whole ? character : U'\ufffd';
}

/// A character that is not ASCII in letters and digits: without its marks, of another alphabet its number, so
/// that names stay apart. Empty: it is no letter. `before` is what stands before a mark of its own.
std::string in_ascii(char32_t character, char before) {
  constexpr char32_t first_mark = 0x300, last_mark = 0x36f, diaeresis = 0x308;
  if (character == diaeresis && std::string_view("aouAOU").find(before) != std::string_view::npos) return "e";
  if (character >= first_latin && character < 0x180) {
    std::string_view letters = plain_latin;
    for (char32_t c = first_latin; c < character; ++c) letters.remove_prefix(letters.find(' ') + 1);
    const std::string_view plain = letters.substr(0, letters.find(' '));
    return plain == "_" ? "" : std::string(plain);
  }
  const bool is_sign = character < first_latin || (character >= 0x2000 && character < 0x2e80) ||
                       (character >= 0x3000 && character < 0x3005) || character >= 0xfffd;
  if (is_sign || (character >= first_mark && character <= last_mark)) return "";
  return fmt::format("u{:04X}", static_cast<std::uint32_t>(character));
}

/// The text with each character that is not ASCII by in_ascii(), and `sign` for those that are no letters.
std::string transcribed(std::string_view text, char sign) {
  std::string ascii;
  while (!text.empty()) {
    const char32_t character = take_character(text);
    if (character < 0x80) {
      ascii += static_cast<char>(character);
      continue;
    }
    const std::string letters = in_ascii(character, ascii.empty() ? ' ' : ascii.back());
    const bool is_mark = character >= 0x300 && character <= 0x36f;
    ascii += letters.empty() && !is_mark ? std::string(1, sign) : letters;
  }
  return ascii;
}

std::string with_point(std::string text) {
  return text.find_first_of(".e") == std::string::npos ? text + ".0" : text;
}

}  // namespace

std::string c_identifier(std::string_view text) {
  std::string name;
  for (const char c : transcribed(text, '_')) name += is_ascii_alnum(c) ? c : '_';
  const bool begins_with_letter = !name.empty() && name[0] != '_' && (name[0] < '0' || name[0] > '9');
  return begins_with_letter ? name : "amble_" + name;
}

std::string upper_case(std::string text) {
  text = transcribed(text, '_');
  for (char& c : text)
    if (c >= 'a' && c <= 'z') c = static_cast<char>(c - 'a' + 'A');
  return text;
}

std::string in_comment(std::string_view text) {
  std::string safe;
  for (const char c : transcribed(text, '?')) {
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
