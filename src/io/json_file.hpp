#pragma once

#include <cstdint>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <utility>

#include "amble/io/settings.hpp"

namespace amble::io {

using Json = nlohmann::ordered_json;

/// The text of a JSON document that amble writes: {"format": NAME, "version": V, …document…, "checksum": "…"}. Numbers are written so
/// that they read back to the same bits. The checksum is the XXH3 of the compact text of all that stands before it.
std::string sealed_json(std::string_view format, int version, const Json& document);

/// What to do when only the checksum is wrong.
enum class Altered { refuse, accept };

struct SealedJson {
  Json document;
  bool altered = false;  ///< the checksum did not fit (only with Altered::accept)
};

/// Parses and checks. Throws UserError(ExitCode::bad_file) naming `what`: not JSON (with line and column), another format, another
/// version, a number that is not finite, altered (checksum).
SealedJson unseal_json(std::string_view format, int version, const std::string& text, const std::string& what,
                       Altered altered = Altered::refuse);

/// Access with messages: each throws UserError(ExitCode::bad_file) "WHAT: key 'a.b' is missing / must be a number".
class JsonView {
 public:
  JsonView(const Json& json, std::string what, std::string path = {})
      : json_(&json), what_(std::move(what)), path_(std::move(path)) {}

  JsonView at(std::string_view key) const;
  JsonView at(std::size_t index) const;
  bool has(std::string_view key) const;
  std::size_t size() const;  ///< of an array
  double number() const;     ///< finite; the text "inf" reads as infinity where the writer put it
  std::int64_t integer() const;
  bool flag() const;
  std::string text() const;
  [[noreturn]] void bad(std::string_view expected) const;
  const Json& raw() const { return *json_; }

 private:
  const Json* json_;
  std::string what_;
  std::string path_;
};

/// A visitor that writes the fields it visits into a JSON object, and one that reads them. The reader demands every
/// key and refuses unknown ones, with the messages of JsonView.
std::unique_ptr<SettingsVisitor> json_writer(Json& object);
std::unique_ptr<SettingsVisitor> json_reader(const JsonView& object);

template <typename Settings>
Json settings_to_json(Settings settings) {
  Json object = Json::object();
  settings.describe(*json_writer(object));
  return object;
}

template <typename Settings>
Settings settings_from_json(const JsonView& object) {
  Settings settings;
  settings.describe(*json_reader(object));
  return settings;
}

}  // namespace amble::io
