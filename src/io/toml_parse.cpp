// The only file that includes the TOML library.
#include <fmt/format.h>
#include <toml++/toml.h>

#include <algorithm>
#include <sstream>

#include "amble/core/error.hpp"
#include "amble/io/text.hpp"
#include "amble/io/toml_node.hpp"

namespace amble::io {
namespace {

constexpr int depth_limit = 16;

/// Where a document is read from; each of its nodes remembers it.
struct Origin {
  const std::string& name;
  const std::filesystem::path& folder;
};

TomlNode convert(const toml::node& node, toml::source_index line, const Origin& origin);

void convert_table(const toml::table& table, TomlNode& result, const Origin& origin) {
  struct Entry {
    toml::source_position position;
    std::string key;
    const toml::node* value;
  };
  std::vector<Entry> entries;
  for (const auto& [key, value] : table)
    entries.push_back({key.source().begin, std::string(key.str()), &value});
  // The library sorts by key; error messages and merging need the order of the file.
  std::stable_sort(entries.begin(), entries.end(),
                   [](const Entry& a, const Entry& b) { return a.position < b.position; });
  for (const Entry& entry : entries) {
    result.keys.push_back(entry.key);
    result.items.push_back(convert(*entry.value, entry.position.line, origin));
  }
}

template <typename Date>
std::string date_text(const Date& date) {
  std::ostringstream stream;
  stream << date;
  return stream.str();
}

TomlNode convert(const toml::node& node, toml::source_index line, const Origin& origin) {
  using Kind = TomlNode::Kind;
  TomlNode result;
  result.where = fmt::format("{}:{}", origin.name, line);
  result.folder = origin.folder;
  if (const auto* table = node.as_table()) {
    convert_table(*table, result, origin);
  } else if (const auto* list = node.as_array()) {
    result.kind = Kind::list;
    for (const toml::node& item : *list)
      result.items.push_back(convert(item, item.source().begin.line, origin));
  } else if (const auto* text = node.as_string()) {
    result.kind = Kind::text;
    result.text = text->get();
  } else if (const auto* integer = node.as_integer()) {
    result.kind = Kind::integer;
    result.integer = integer->get();
  } else if (const auto* number = node.as_floating_point()) {
    result.kind = Kind::number;
    result.number = number->get();
  } else if (const auto* flag = node.as_boolean()) {
    result.kind = Kind::flag;
    result.flag = flag->get();
  } else {
    result.kind = Kind::date;
    if (const auto* date = node.as_date()) result.text = date_text(date->get());
    if (const auto* time = node.as_time()) result.text = date_text(time->get());
    if (const auto* both = node.as_date_time()) result.text = date_text(both->get());
  }
  return result;
}

/// Walks over the characters that are neither in strings nor in comments.
class PlainCharacters {
 public:
  explicit PlainCharacters(std::string_view text) : text_(text) {}

  /// The next of them, or '\0' at the end. A string counts as one quote character.
  char next() {
    if (at_ >= text_.size()) return '\0';
    const char c = text_[at_++];
    if (c == '#') at_ = std::min(text_.find('\n', at_), text_.size());
    if (c == '"' || c == '\'') skip_string(c);
    return c == '\0' ? ' ' : c;
  }
  auto line() const {
    return 1 + std::count(text_.begin(), text_.begin() + static_cast<std::ptrdiff_t>(at_), '\n');
  }

 private:
  void skip_string(char quote) {
    const std::string three(3, quote);
    const bool multi_line = text_.substr(at_ - 1, 3) == three;
    if (multi_line) at_ += 2;
    for (; at_ < text_.size(); ++at_) {
      if (text_[at_] == '\\' && quote == '"') {
        ++at_;
      } else if (multi_line ? text_.substr(at_, 3) == three : text_[at_] == quote || text_[at_] == '\n') {
        at_ += multi_line ? 3 : 1;
        // Up to two quotes may precede the closing three.
        for (int i = 0; multi_line && i < 2 && text_.substr(at_, 1) == three.substr(2); ++i) ++at_;
        return;
      }
    }
  }

  std::string_view text_;
  std::size_t at_ = 0;
};

/// Keys like a.a.a.a… and brackets in brackets become nodes in nodes, which the library destroys by
/// recursion.
void refuse_deep_nesting(std::string_view text, const std::string& name) {
  PlainCharacters characters(text);
  int brackets = 0, dots = 0;
  for (char c = characters.next(); c != '\0'; c = characters.next()) {
    if (c == '[' || c == '{') ++brackets;
    if (c == ']' || c == '}') --brackets;
    if (std::string_view("=,[]{}\n").find(c) != std::string_view::npos) dots = 0;
    if (c == '.') ++dots;
    if (brackets > depth_limit || dots > depth_limit) {
      fail(ExitCode::bad_input, "{}:{}: nested more than {} levels deep", name, characters.line(),
           depth_limit);
    }
  }
}

}  // namespace

TomlNode parse_toml(std::string_view text, const std::string& name, const std::filesystem::path& folder) {
  refuse_deep_nesting(text, name);
  try {
    TomlNode root;
    convert_table(toml::parse(text, name), root, {name, folder});
    root.where = name;
    root.folder = folder;
    return root;
  } catch (const toml::parse_error& error) {
    const auto position = error.source().begin;
    if (const auto first = text.find_first_not_of(" \t\r\n");
        first != std::string_view::npos && text[first] == '<')
      fail(ExitCode::bad_input,
           "{}: XML, perhaps a robot's model; expected TOML: `amble robot --init MODEL` makes a config for a "
           "model",
           name);
    fail(ExitCode::bad_input, "{}:{}:{}: TOML syntax error: {}", name, position.line, position.column,
         printable(error.description()));
  }
}

}  // namespace amble::io
