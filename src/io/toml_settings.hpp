#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "amble/io/settings.hpp"

namespace amble::io {

/// A TOML document with its origin, so that every error message names "FILE:LINE: key 'a.b' …".
///
/// A document may name others: `include = ["../parts/neat.toml"]` (paths relative to the file). They are read
/// first, in order; later ones, and last the document itself, override key by key. Circles are refused.
class TomlDocument {
 public:
  /// Throws UserError: missing file, syntax error ("FILE:LINE:COLUMN: …"), a bad include.
  static TomlDocument read(const std::filesystem::path& path);
  static TomlDocument parse(std::string_view text, const std::string& name);

  ~TomlDocument();
  TomlDocument(const TomlDocument& other);
  TomlDocument(TomlDocument&&) noexcept;
  TomlDocument& operator=(TomlDocument&&) noexcept;

  /// Applies "key.path=value" from the command line; the value is TOML, or a bare word, which is a string.
  /// Later error messages about the key name "--set KEY=VALUE".
  void set(std::string_view assignment);

  /// What the document and those that it includes say together, as TOML: a line for each key of the top
  /// table. To be called before set().
  std::string text() const;

  /// A visitor that reads from the top table. Missing keys keep their values. Types and ranges are checked:
  /// an error message names file, line, key, the value and what was expected. finish() names the nearest
  /// known key beside an unknown one.
  using Reader = SettingsReader;
  /// The document must outlive the reader.
  std::unique_ptr<Reader> reader() const;

  /// Keys of a table whose keys are names that the caller knows later, in the file's order; none if it is not
  /// there.
  std::vector<std::string> keys_of(std::string_view key_path) const;

  bool has(std::string_view key_path) const;

  /// Whether the document has that key with a list, for values that may be one or several.
  bool is_list(std::string_view key_path) const;

  /// For text settings that name files: the folder of the file that has the key. Empty for the current
  /// folder, and for keys from the command line.
  std::filesystem::path folder_of(std::string_view key_path) const;
  /// "FILE:LINE" of a key ("--set KEY=VALUE" if it came from there; the document's name if the key is
  /// absent), for later error messages. For a key that an item of a list lacks, that of the item.
  std::string where(std::string_view key_path) const;
  /// The same of the first of these keys that came from the command line, else of the first in the
  /// document itself, else of the first in a document that it includes.
  std::string where(const std::vector<std::string>& key_paths) const;

 private:
  struct Impl;
  explicit TomlDocument(std::unique_ptr<Impl> impl);
  std::unique_ptr<Impl> impl_;
};

/// All visited fields as TOML text with their units and sources as comments; reads back to the same values.
std::string settings_to_toml(const std::function<void(SettingsVisitor&)>& describe);

/// One column of the table of settings in the docs.
struct SettingsColumn {
  std::string title;
  std::function<void(SettingsVisitor&)> describe;
};
enum class SettingsRows {
  all,
  differing,  ///< only those in which the columns after the first differ from each other
};
/// The paths of all settings that `--set` takes, in their order: not those of items in lists.
std::vector<std::string> setting_keys(const SettingsColumn& column);
/// A Markdown table: key, what it means, allowed values, the value in each column, source. The first column
/// has the defaults; for a list of tables it also has those of an item's keys, and the others only the
/// number of items.
std::string settings_to_markdown(const std::vector<SettingsColumn>& columns,
                                 SettingsRows rows = SettingsRows::all);
/// The same without values and sources.
std::string keys_to_markdown(const std::function<void(SettingsVisitor&)>& describe);

}  // namespace amble::io
