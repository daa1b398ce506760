#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <span>

#include "amble/io/settings_text.hpp"
#include "amble/io/toml_settings.hpp"

namespace amble::io {
namespace {

struct Row {
  std::string key;
  std::string what;
  std::string expected;
  std::string source;
  std::vector<std::string> values;      ///< one per column; empty where a column lacks the key
  std::vector<std::string> items = {};  ///< of a list: all of each column's, as text
};

/// The fields of a list's items, one after the other.
class ItemsText final : public SettingsPrinter {
 public:
  static std::string of(SettingsList& list) {
    ItemsText printer;
    for (std::size_t i = 0; i < list.size(); ++i) {
      printer.text_ += printer.text_.empty() ? "{ " : ", { ";
      printer.first_ = true;
      list.describe(i, printer);
      printer.text_ += " }";
    }
    return printer.text_;
  }

  void begin(std::string_view key, Doc) override {
    name(key);
    text_ += "{ ";
    first_ = true;
  }
  void end() override { text_ += " }"; }
  void list(std::string_view key, SettingsList& items, Doc) override {
    name(key);
    text_ += "[" + of(items) + "]";
  }

 private:
  void put(std::string_view key, std::string value, std::string_view, Doc) override {
    name(key);
    text_ += value;
  }
  void name(std::string_view key) {
    text_ += fmt::format("{}{} = ", first_ ? "" : ", ", key);
    first_ = false;
  }

  std::string text_;
  bool first_ = true;
};

/// Adds the values of one column to the rows, and rows for keys that are new.
class ColumnCollector final : public SettingsPrinter {
 public:
  ColumnCollector(std::vector<Row>& rows, std::size_t column, std::size_t columns)
      : rows_(rows), column_(column), columns_(columns) {}

  void begin(std::string_view key, Doc) override { tables_.push_back(path_of(key)); }
  void end() override { tables_.pop_back(); }
  /// How many items there are, and the keys that each has.
  void list(std::string_view key, SettingsList& items, Doc doc) override {
    Row& target = row(key, expected_tables, doc);
    target.values[column_] = fmt::format("{} item{}", items.size(), items.size() == 1 ? "" : "s");
    target.items.resize(columns_);
    target.items[column_] = ItemsText::of(items);
    tables_.push_back(path_of(key) + "[]");
    in_list_ = true;
    items.describe_default(*this);
    in_list_ = false;
    tables_.pop_back();
  }

 private:
  std::string path_of(std::string_view key) const {
    return tables_.empty() ? std::string(key) : fmt::format("{}.{}", tables_.back(), key);
  }

  Row& row(std::string_view key, std::string_view expected, Doc doc) {
    const std::string path = path_of(key);
    const auto found =
        std::find_if(rows_.begin(), rows_.end(), [&](const Row& other) { return other.key == path; });
    if (found != rows_.end()) return *found;
    return rows_.emplace_back(Row{path, std::string(doc.what), std::string(expected), std::string(doc.source),
                                  std::vector<std::string>(columns_)});
  }
  void put(std::string_view key, std::string value, std::string_view expected, Doc doc) override {
    Row& target = row(key, expected, doc);
    // The items of a list differ; what is shown is the default of their fields, in the first column.
    if (!in_list_ || column_ == 0) target.values[column_] = fmt::format("`{}`", value);
  }

  std::vector<Row>& rows_;
  std::size_t column_, columns_;
  std::vector<std::string> tables_;
  bool in_list_ = false;
};

/// A cell's text; a bar would end the cell.
std::string cell(std::string_view text) {
  std::string escaped;
  for (const char c : text) escaped += c == '|' ? std::string("\\|") : std::string(1, c);
  return escaped + " |";
}

}  // namespace

std::vector<std::string> setting_keys(const SettingsColumn& column) {
  std::vector<Row> rows;
  ColumnCollector collector(rows, 0, 1);
  column.describe(collector);
  std::vector<std::string> keys;
  for (const Row& row : rows)
    if (row.key.find('[') == std::string::npos) keys.push_back(row.key);
  return keys;
}

std::string keys_to_markdown(const std::function<void(SettingsVisitor&)>& describe) {
  std::vector<Row> rows;
  ColumnCollector collector(rows, 0, 1);
  describe(collector);
  std::string table = "| key | what it means | allowed |\n|---|---|---|\n";
  for (const Row& row : rows)
    table += fmt::format("| {} {} {}\n", cell("`" + row.key + "`"), cell(row.what), cell(row.expected));
  return table;
}

std::string settings_to_markdown(const std::vector<SettingsColumn>& columns, SettingsRows wanted) {
  std::vector<Row> rows;
  for (std::size_t i = 0; i < columns.size(); ++i) {
    ColumnCollector collector(rows, i, columns.size());
    columns[i].describe(collector);
  }

  if (wanted == SettingsRows::differing)
    std::erase_if(rows, [](Row& row) {
      const auto differ = [](const std::vector<std::string>& values) {
        const auto others = std::span(values).subspan(1);
        return std::ranges::adjacent_find(others, std::ranges::not_equal_to()) != others.end();
      };
      if (differ(row.values)) return false;
      if (row.items.empty() || !differ(row.items)) return true;
      // Lists of the same length: what is in them.
      for (std::size_t i = 0; i < row.values.size(); ++i)
        row.values[i] = row.items[i].empty() ? row.values[i] : fmt::format("`{}`", row.items[i]);
      return false;
    });

  std::string table = "| key | what it means | allowed |";
  std::string rule = "|---|---|---|";
  for (const SettingsColumn& column : columns) {
    table += " " + cell(column.title);
    rule += "---|";
  }
  table += " source |\n" + rule + "---|\n";
  for (const Row& row : rows) {
    table += fmt::format("| {} {} {}", cell("`" + row.key + "`"), cell(row.what), cell(row.expected));
    for (const std::string& value : row.values) table += " " + cell(value);
    table += " " + cell(row.source) + "\n";
  }
  return table;
}

}  // namespace amble::io
