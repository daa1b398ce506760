#include "amble/io/json_file.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include <limits>

#include "amble/core/check.hpp"
#include "amble/core/error.hpp"
#include "amble/core/hash.hpp"
#include "amble/io/text.hpp"

namespace amble::io {
namespace {

/// Deepest nesting of brackets outside strings. Counted before parsing, because printing and comparing
/// recurse.
int depth_of(std::string_view text) {
  int depth = 0, deepest = 0;
  bool in_string = false;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    if (in_string) {
      if (c == '\\') ++i;
      if (c == '"') in_string = false;
    } else if (c == '"') {
      in_string = true;
    } else if (c == '{' || c == '[') {
      deepest = std::max(deepest, ++depth);
    } else if (c == '}' || c == ']') {
      --depth;
    }
  }
  return deepest;
}

[[noreturn]] void fail_at(std::string_view text, std::size_t byte, const std::string& what) {
  // The parser names the last byte it read, counted from 1; one past the last byte is the end of the text.
  if (byte > text.size()) fail(ExitCode::bad_file, "{}: truncated: the JSON ends too early", what);
  const std::string_view before = text.substr(0, byte == 0 ? 0 : byte - 1);
  const auto line = 1 + std::count(before.begin(), before.end(), '\n');
  const std::size_t newline = before.rfind('\n');
  const std::size_t column = newline == std::string_view::npos ? before.size() + 1 : before.size() - newline;
  constexpr std::size_t longest_word = 20;
  const std::string_view rest = text.substr(before.size());
  const std::string_view word = rest.substr(0, std::max<std::size_t>(1, rest.find_first_of(",]} \t\r\n")));
  fail(ExitCode::bad_file, "{}:{}:{}: not valid JSON: '{}'", what, line, column,
       printable(word.substr(0, longest_word)));
}

std::string checksum_of(const Json& document) {
  return hex(hash_text(document.dump(-1, ' ', false, Json::error_handler_t::replace)));
}

constexpr std::size_t line_width = 110;

std::string scalar_text(const Json& value) {
  AMBLE_CHECK(!value.is_number_float() || std::isfinite(value.get<double>()),
              "JSON has no NaN and no infinity");
  return value.dump(-1, ' ', false, Json::error_handler_t::replace);
}

/// `value` on one line, with a space after commas and colons.
std::string one_line(const Json& value) {
  if (!value.is_structured()) return scalar_text(value);
  std::string text(1, value.is_object() ? '{' : '[');
  for (auto item = value.begin(); item != value.end(); ++item) {
    if (item != value.begin()) text += ", ";
    if (value.is_object()) text += scalar_text(item.key()) + ": ";
    text += one_line(*item);
  }
  return text += value.is_object() ? '}' : ']';
}

bool is_list_of_plain_values(const Json& value) {
  if (!value.is_array()) return false;
  for (const Json& item : value) {
    if (item.is_structured()) return false;
  }
  return true;
}

/// `column`: where on its line the value starts; `indent`: that of the line.
void append(std::string& text, const Json& value, std::size_t column, std::size_t indent) {
  const std::string line = one_line(value);
  if (!value.is_structured() || is_list_of_plain_values(value) ||
      (indent > 0 && column + line.size() < line_width)) {
    text += line;
    return;
  }
  text += value.is_object() ? "{" : "[";
  for (auto item = value.begin(); item != value.end(); ++item) {
    text += item == value.begin() ? "\n" : ",\n";
    text.append(indent + 2, ' ');
    const std::string key = value.is_object() ? scalar_text(item.key()) + ": " : std::string();
    text += key;
    append(text, *item, indent + 2 + key.size(), indent + 2);
  }
  text += '\n';
  text.append(indent, ' ');
  text += value.is_object() ? '}' : ']';
}

}  // namespace

Json parse_json(std::string_view text, const std::string& what) {
  if (depth_of(text) > json_depth_limit) {
    fail(ExitCode::bad_file, "{}: the JSON is nested more than {} levels deep", what, json_depth_limit);
  }
  try {
    return Json::parse(text);
  } catch (const Json::parse_error& error) {
    fail_at(text, error.byte, what);
  } catch (const Json::out_of_range&) {
    fail(ExitCode::bad_file, "{}: a number is not finite: it is beyond the range of double", what);
  }
}

std::string sealed_json(std::string_view format, int version, const Json& document) {
  AMBLE_CHECK(document.is_object(), "a sealed document is an object");
  Json sealed = Json::object();
  sealed["format"] = format;
  sealed["version"] = version;
  for (const auto& [key, value] : document.items()) {
    AMBLE_CHECK(key != "format" && key != "version" && key != "checksum", "this key belongs to the seal");
    sealed[key] = value;
  }
  sealed["checksum"] = checksum_of(sealed);
  return json_text(sealed);
}

SealedJson unseal_json(std::string_view format, int version, const std::string& text, const std::string& what,
                       Altered altered) {
  Json json = parse_json(text, what);
  if (!json.is_object() || !json.contains("format") || !json["format"].is_string()) {
    fail(ExitCode::bad_file, "{}: not a file of amble: it has no \"format\"", what);
  }
  const auto found_format = json["format"].get<std::string>();
  if (found_format != format) {
    fail(ExitCode::bad_file, "{}: its format is \"{}\", \"{}\" was expected", what, printable(found_format),
         format);
  }
  const std::int64_t found_version = JsonView(json, what).at("version").integer();
  if (found_version != version) {
    fail(ExitCode::bad_file, "{}: version {} of the file format; this program reads version {}", what,
         found_version, version);
  }

  std::string stored;
  if (json.contains("checksum") && json["checksum"].is_string()) stored = json["checksum"].get<std::string>();
  json.erase("checksum");
  SealedJson result;
  result.altered = stored != checksum_of(json);
  if (result.altered && altered == Altered::refuse) {
    fail(ExitCode::bad_file, "{}: altered: its checksum does not fit", what);
  }
  json.erase("format");
  json.erase("version");
  result.document = std::move(json);
  return result;
}

std::string json_text(const Json& json) {
  std::string text;
  append(text, json, 0, 0);
  return text += '\n';
}

Json json_number(double value) {
  AMBLE_CHECK(!std::isnan(value), "NaN is not stored in files");
  if (std::isinf(value)) return value > 0.0 ? "inf" : "-inf";
  return value;
}

std::string JsonView::path_of(std::string_view key) const {
  return path_.empty() ? std::string(key) : fmt::format("{}.{}", path_, key);
}

JsonView JsonView::at(std::string_view key) const {
  if (!json_->is_object()) bad("an object");
  const auto found = json_->find(key);
  if (found == json_->end())
    fail(ExitCode::bad_file, "{}: key '{}' is missing", what_, printable(path_of(key)));
  return JsonView(*found, what_, path_of(key));
}

JsonView JsonView::at(std::size_t index) const {
  const std::string path = fmt::format("{}[{}]", path_, index);
  if (index >= size()) fail(ExitCode::bad_file, "{}: key '{}' is missing", what_, path);
  return JsonView((*json_)[index], what_, path);
}

bool JsonView::has(std::string_view key) const {
  return json_->is_object() && json_->find(key) != json_->end();
}

std::size_t JsonView::size() const {
  if (!json_->is_array()) bad("a list");
  return json_->size();
}

double JsonView::number() const {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  if (json_->is_string() && json_->get_ref<const std::string&>() == "inf") return infinity;
  if (json_->is_string() && json_->get_ref<const std::string&>() == "-inf") return -infinity;
  if (!json_->is_number()) bad("a number");
  const auto value = json_->get<double>();
  if (!std::isfinite(value)) bad("a finite number");
  return value;
}

double JsonView::finite_number() const {
  const double value = number();
  if (!std::isfinite(value)) bad("a finite number");
  return value;
}

std::int64_t JsonView::integer() const {
  if (!json_->is_number_integer()) bad("a whole number");
  constexpr auto highest = static_cast<std::uint64_t>(std::numeric_limits<std::int64_t>::max());
  if (json_->is_number_unsigned() && json_->get<std::uint64_t>() > highest) bad("a whole number below 2^63");
  return json_->get<std::int64_t>();
}

bool JsonView::flag() const {
  if (!json_->is_boolean()) bad("true or false");
  return json_->get<bool>();
}

std::string JsonView::text() const {
  if (!json_->is_string()) bad("text");
  return json_->get<std::string>();
}

void JsonView::bad(std::string_view expected) const {
  refuse(fmt::format("must be {}", expected));
}

void JsonView::refuse(std::string_view problem) const {
  if (path_.empty()) fail(ExitCode::bad_file, "{}: the document {}", what_, problem);
  fail(ExitCode::bad_file, "{}: key '{}' {}", what_, printable(path_), problem);
}

}  // namespace amble::io
