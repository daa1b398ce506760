#include "amble/io/json_file.hpp"

#include <algorithm>

#include "amble/core/check.hpp"
#include "amble/core/error.hpp"
#include "amble/core/hash.hpp"
#include "amble/io/printable.hpp"

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

}  // namespace amble::io
