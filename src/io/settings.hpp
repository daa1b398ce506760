#pragma once

#include <algorithm>
#include <array>
#include <concepts>
#include <cstdint>
#include <limits>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

/// Settings that describe themselves, and what is saved as bytes.
namespace amble::io {

/// Documentation of one setting.
struct Doc {
  std::string_view what;         ///< one sentence, with the unit
  std::string_view source = {};  ///< where the number comes from, e.g. "Morse et al. 2013, sec. 4"
  /// For a choice, a text or texts that files of earlier versions lack: JSON leaves it out while it is the
  /// first name, or empty.
  bool first_is_implied = false;
  /// For a table that files of earlier versions lack: JSON leaves it out while all of it is at its defaults.
  bool defaults_are_implied = false;
  /// For a table: TOML may have a text in its place, which is that of this key; all others are at their
  /// defaults. A text from the command line leaves those values of the table in the file that are no lists.
  std::string_view short_for = {};
};

/// Closed range of a number: both bounds belong to it. So infinity is allowed where a bound is infinite,
/// and only there. NaN is in no range.
struct Range {
  double lowest = -std::numeric_limits<double>::infinity();  ///< by default none
  double highest = std::numeric_limits<double>::infinity();  ///< by default none
};

class SettingsVisitor;

/// A list of settings structs of one kind, as visitors see it.
class SettingsList {
 public:
  virtual ~SettingsList() = default;
  /// Items that are in it.
  virtual std::size_t size() const = 0;
  /// Replaces all items by `count` items with default values.
  virtual void renew(std::size_t count) = 0;
  /// Describes item `index` < size().
  virtual void describe(std::size_t index, SettingsVisitor& visitor) = 0;
  /// Describes an item with default values that is not in the list.
  virtual void describe_default(SettingsVisitor& visitor) const = 0;
};

/// Walks over the fields of a settings struct. One `describe(SettingsVisitor&)` member per struct serves
/// reading TOML, writing TOML, reading and writing JSON, and the table of settings in the docs, so that these
/// cannot drift apart. Readers change the values, writers leave them as they are.
///
/// A reader throws UserError for a value of another type or out of its range, in a line that names file, key,
/// value and what is allowed. Where TOML lacks a key its value stays as it was; JSON must have all keys but
/// those that Doc lets it leave out. Who fills a struct in without a reader is held to no range.
///
/// A `key` is the name in its table, not a path; no table has it twice.
class SettingsVisitor {
 public:
  virtual ~SettingsVisitor() = default;

  /// A table [key]; what is visited until end() belongs to it.
  virtual void begin(std::string_view key, Doc doc) = 0;
  /// Ends the table that was begun last.
  virtual void end() = 0;

  /// A number within `range`; TOML may have a whole one.
  virtual void number(std::string_view key, double& value, Range range, Doc doc) = 0;
  /// A whole number within `range`.
  virtual void integer(std::string_view key, std::int64_t& value, Range range, Doc doc) = 0;
  /// True or false.
  virtual void flag(std::string_view key, bool& value, Doc doc) = 0;
  /// Any text.
  virtual void text(std::string_view key, std::string& value, Doc doc) = 0;
  /// A list of any texts; a reader replaces all of it.
  virtual void texts(std::string_view key, std::vector<std::string>& value, Doc doc) = 0;
  /// A list of numbers, each within `range`; a reader replaces all of it.
  virtual void numbers(std::string_view key, std::vector<double>& value, Range range, Doc doc) = 0;
  /// One of `names`; `index` is its place therein, from 0. See choice().
  virtual void choice_index(std::string_view key, int& index, std::span<const std::string_view> names,
                            Doc doc) = 0;

  /// A list of tables without tables of their own. A reader that finds the key renews the list.
  virtual void list(std::string_view key, SettingsList& items, Doc doc) = 0;

  /// The same for an int; the range is narrowed to what an int can hold.
  void integer(std::string_view key, int& value, Range range, Doc doc) {
    constexpr std::numeric_limits<int> limits;
    std::int64_t wide = value;
    integer(key, wide,
            {std::max(range.lowest, 1.0 * limits.min()), std::min(range.highest, 1.0 * limits.max())}, doc);
    value = static_cast<int>(wide);
  }

  /// A value of an enum whose enumerators are numbered 0, 1, … in the order of `names`.
  template <typename Enum, std::size_t N>
  void choice(std::string_view key, Enum& value, const std::array<std::string_view, N>& names, Doc doc) {
    int index = static_cast<int>(value);
    choice_index(key, index, names, doc);
    value = static_cast<Enum>(index);
  }

  /// The name of one of `rows`, each of which has a `name`: for tables to which rows may be added
  /// (controllers, searches). `value` must be one of them already.
  template <typename Rows>
  void row_name(std::string_view key, std::string& value, const Rows& rows, Doc doc) {
    std::vector<std::string_view> names;
    names.reserve(rows.size());
    for (const auto& row : rows) names.push_back(row.name);
    auto index = static_cast<int>(std::ranges::find(names, value) - names.begin());
    choice_index(key, index, names, doc);
    value = names[static_cast<std::size_t>(index)];
  }

  /// A nested settings struct, by its own describe(), as a table of its own.
  template <typename Settings>
  void table(std::string_view key, Settings& settings, Doc doc) {
    if constexpr (std::equality_comparable<Settings>) {
      if (doc.defaults_are_implied && leaves_out(key, settings == Settings())) {
        settings = Settings();
        return;
      }
    }
    begin(key, doc);
    settings.describe(*this);
    end();
  }

  /// A list of settings structs, each written as a table.
  template <typename Settings>
  void tables(std::string_view key, std::vector<Settings>& items, Doc doc);

 private:
  /// Whether a table with Doc::defaults_are_implied is not there: not to be written, or not in what is read.
  virtual bool leaves_out(std::string_view /*key*/, bool /*at_defaults*/) { return false; }
};

template <typename Settings>
void SettingsVisitor::tables(std::string_view key, std::vector<Settings>& items, Doc doc) {
  class List final : public SettingsList {
   public:
    explicit List(std::vector<Settings>& settings) : settings_(settings) {}
    std::size_t size() const override { return settings_.size(); }
    void renew(std::size_t count) override { settings_.assign(count, Settings()); }
    void describe(std::size_t index, SettingsVisitor& visitor) override {
      settings_[index].describe(visitor);
    }
    void describe_default(SettingsVisitor& visitor) const override { Settings().describe(visitor); }

   private:
    std::vector<Settings>& settings_;
  };
  List settings(items);
  list(key, settings, doc);
}

/// A visitor that reads. finish() must be called after the last field.
class SettingsReader : public SettingsVisitor {
 public:
  /// Throws UserError for a key that was not visited.
  virtual void finish() = 0;
};

}  // namespace amble::io
