#pragma once

#include <fmt/format.h>

#include <cstdint>
#include <iterator>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

/// Pieces of C99 text.
namespace amble::exporting {

/// Letters, digits and underscores alone, and no digit or underscore in front: Latin letters with marks
/// become plain ones (ä: ae), those of other alphabets their number in Unicode (u5DE6), every other character
/// an underscore, and "amble_" is put in front where needed.
std::string c_identifier(std::string_view text);
/// The same of letters, and all of them capitals.
std::string upper_case(std::string text);

/// Text that can be anywhere in a block comment: one line of ASCII without "*/", "/*" and trigraphs; letters
/// as c_identifier() writes them, other characters that are not ASCII as question marks.
std::string in_comment(std::string_view text);

/// A string literal of in_comment(text).
std::string c_string(std::string_view text);

/// A float literal that reads back to the same bits, in decimal ("0.25f"); `value` is finite.
std::string c_float(float value);
/// The same of a double.
std::string c_double(double value);

/// Identifiers that differ from each other: one that is already taken gets a number behind it.
class UniqueNames {
 public:
  std::string of(std::string_view text);

 private:
  std::set<std::string> used_;
};

/// The smallest unsigned type for 0 … largest.
std::string unsigned_type(std::size_t largest);

/// `text` with `value` wherever it had `key`.
std::string replaced(std::string_view text, std::string_view key, std::string_view value);

/// `$p` becomes `prefix`, `$P` the same in upper case.
std::string with_prefix(std::string_view text, const std::string& prefix);

/// A text that grows line by line.
class CText {
 public:
  explicit CText(std::string prefix) : prefix_(std::move(prefix)) {}

  const std::string& prefix() const { return prefix_; }
  /// A formatted line.
  template <typename... Args>
  void line(fmt::format_string<Args...> text, Args&&... args) {
    fmt::format_to(std::back_inserter(text_), text, std::forward<Args>(args)...);
    text_ += '\n';
  }
  /// Text as it is, but for with_prefix().
  void block(std::string_view text) { text_ += with_prefix(text, prefix_); }
  /// "DECLARATION = {a, b, …};" in lines of at most 100 characters. Without elements it has one, 0: C has no
  /// empty arrays.
  void array(std::string_view declaration, const std::vector<std::string>& elements);
  /// The same in two dimensions.
  void array(std::string_view declaration, const std::vector<std::vector<std::string>>& rows);
  /// The inside of a block comment, line by line; long lines are broken.
  void comment_lines(const std::vector<std::string>& lines);

  /// Text as it is.
  void append(std::string_view text) { text_ += text; }
  std::string take() { return std::move(text_); }

 private:
  void elements(const std::vector<std::string>& elements, std::string_view margin);

  std::string prefix_, text_;
};

}  // namespace amble::exporting
