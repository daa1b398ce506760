#pragma once

#include <cstdint>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <utility>

#include "amble/io/file.hpp"
#include "amble/io/settings.hpp"

namespace amble::io {

using Json = nlohmann::ordered_json;

/// The deepest nesting of objects and lists that amble reads or writes.
inline constexpr int json_depth_limit = 64;

/// Parses JSON. Throws UserError(ExitCode::bad_file): syntax error ("WHAT:LINE:COLUMN: not valid JSON"),
/// truncated, nested too deeply, a number beyond the range of double.
Json parse_json(std::string_view text, const std::string& what);

/// A number as JSON: finite ones as such, infinite ones as the texts "inf" and "-inf". NaN is a programming
/// error (checked).
Json json_number(double value);

/// JSON laid out for people: indented by two spaces; lists of plain values, and everything else that is
/// short, on one line. Numbers read back to the same bits. Numbers that are not finite are a programming
/// error (see json_number); invalid UTF-8 becomes U+FFFD.
std::string json_text(const Json& json);

/// The text of a JSON document that amble writes: {"format": NAME, "version": V, …document…, "checksum":
/// "…"}, laid out by json_text. The checksum is the XXH3 of the compact text of everything before it, so that
/// it does not depend on the layout.
std::string sealed_json(std::string_view format, int version, const Json& document);

struct SealedJson {
  Json document;         ///< without "format", "version" and "checksum"
  bool altered = false;  ///< the checksum is missing or did not fit (only with Altered::accept)
};

/// Parses and checks. Throws UserError(ExitCode::bad_file) naming `what`: not JSON (with line and column),
/// another format, another version, a number that is not finite, altered (checksum).
SealedJson unseal_json(std::string_view format, int version, const std::string& text, const std::string& what,
                       Altered altered = Altered::refuse);

/// Checked access: each function throws UserError(ExitCode::bad_file) "WHAT: key 'a.b' is missing / must be a
/// number". Refers to the document, which must outlive it.
class JsonView {
 public:
  JsonView(const Json& json, std::string what, std::string path = {})
      : json_(&json), what_(std::move(what)), path_(std::move(path)) {}

  JsonView at(std::string_view key) const;
  JsonView at(std::size_t index) const;
  bool has(std::string_view key) const;
  std::size_t size() const;      ///< of an array
  double number() const;         ///< never NaN; infinite only where json_number wrote it so
  double finite_number() const;  ///< the same, but never infinite
  std::int64_t integer() const;
  bool flag() const;
  std::string text() const;
  /// "WHAT: key 'a.b' must be EXPECTED".
  [[noreturn]] void bad(std::string_view expected) const;
  /// "WHAT: key 'a.b' PROBLEM" ("the document" for the outermost level).
  [[noreturn]] void refuse(std::string_view problem) const;
  const Json& raw() const { return *json_; }

 private:
  std::string path_of(std::string_view key) const;

  const Json* json_;
  std::string what_;
  std::string path_;
};

/// A visitor that writes the fields it visits into a JSON object, and one that reads them. The reader demands
/// every key and, with finish(), refuses unknown ones, with the messages of JsonView; ranges are checked too.
std::unique_ptr<SettingsVisitor> json_writer(Json& object);
std::unique_ptr<SettingsReader> json_reader(const JsonView& object);

template <typename Settings>
Json settings_to_json(Settings settings) {
  Json object = Json::object();
  settings.describe(*json_writer(object));
  return object;
}

template <typename Settings>
Settings settings_from_json(const JsonView& object) {
  Settings settings;
  const auto reader = json_reader(object);
  settings.describe(*reader);
  reader->finish();
  return settings;
}

}  // namespace amble::io
