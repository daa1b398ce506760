#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "amble/io/settings.hpp"

namespace amble::io {

/// A value of a TOML document, and where it came from.
struct TomlNode {
  enum class Kind { table, list, text, integer, number, flag, date };

  Kind kind = Kind::table;
  std::string text;  ///< of a text or a date
  std::int64_t integer = 0;
  double number = 0.0;
  bool flag = false;
  std::vector<TomlNode> items;    ///< of a list or a table, in the order of the file
  std::vector<std::string> keys;  ///< of a table, or beside a text that is short for one: the keys of `items`

  std::string where;  ///< "FILE:LINE", or "--set KEY=VALUE"
  bool from_command_line = false;
  std::filesystem::path folder;  ///< of the file; empty: the current one

  const TomlNode* find(std::string_view key) const;
  /// The value at a path of keys ("neat.population", "nodes[2].sensor", "names.\"a.b\".hip"), or null. Keys
  /// that are not bare are in it as toml_key() writes them.
  const TomlNode* find_path(std::string_view path) const;
  /// Adds or replaces a value of a table.
  void put(std::string_view key, TomlNode value);
  void drop(std::string_view key);
  /// Takes over all values of another table: tables are merged key by key, anything else is replaced. Where
  /// one of both is a text and the new one is from the command line, the text may be short for a table
  /// (Doc::short_for) and has the table's values beside it; of a table that it replaces, all but lists.
  void merge(TomlNode table);
  /// Takes over those values of a table that are no lists.
  void take_single_values(const TomlNode& table);

 private:
  /// Which key stands in quotes where the path begins; keys.size(): none.
  std::size_t quoted_key_at(std::string_view path) const;
};

/// The value as TOML on one line, shortened where it is long; tables as {...}.
std::string toml_text(const TomlNode& node);

/// Parses TOML. Throws UserError: "NAME:LINE:COLUMN: TOML syntax error: …", or nested too deeply.
TomlNode parse_toml(std::string_view text, const std::string& name, const std::filesystem::path& folder);

/// A visitor that reads from a table, which must outlive it.
std::unique_ptr<SettingsReader> make_toml_reader(const TomlNode& root);

}  // namespace amble::io
