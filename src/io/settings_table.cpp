#include <fmt/format.h>

#include <algorithm>

#include "amble/io/settings_printer.hpp"
#include "amble/io/toml_settings.hpp"

namespace amble::io {
namespace {

struct Row {
  std::string key;
  std::string what;
  std::string expected;
  std::string source;
  std::vector<std::string> values;  ///< one per column; empty where a column lacks the key
};

/// Adds the values of one column to the rows, and rows for keys that are new.
class ColumnCollector final : public SettingsPrinter {
 public:
  ColumnCollector(std::vector<Row>& rows, std::size_t column, std::size_t columns)
      : rows_(rows), column_(column), columns_(columns) {}

  void begin(std::string_view key, Doc) override { tables_.push_back(path_of(key)); }
  void end() override { tables_.pop_back(); }

 private:
  std::string path_of(std::string_view key) const {
    return tables_.empty() ? std::string(key) : fmt::format("{}.{}", tables_.back(), key);
  }

  void put(std::string_view key, std::string value, std::string_view expected, Doc doc) override {
    const std::string path = path_of(key);
    auto row = std::find_if(rows_.begin(), rows_.end(), [&](const Row& other) { return other.key == path; });
    if (row == rows_.end()) {
      rows_.push_back({path, std::string(doc.what), std::string(expected), std::string(doc.source),
                       std::vector<std::string>(columns_)});
      row = rows_.end() - 1;
    }
    row->values[column_] = fmt::format("`{}`", value);
  }

  std::vector<Row>& rows_;
  std::size_t column_, columns_;
  std::vector<std::string> tables_;
};

/// A cell's text; a bar would end the cell.
std::string cell(std::string_view text) {
  std::string escaped;
  for (const char c : text) escaped += c == '|' ? std::string("\\|") : std::string(1, c);
  return escaped + " |";
}

}  // namespace

std::string settings_to_markdown(const std::vector<SettingsColumn>& columns) {
  std::vector<Row> rows;
  for (std::size_t i = 0; i < columns.size(); ++i) {
    ColumnCollector collector(rows, i, columns.size());
    columns[i].describe(collector);
  }

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
