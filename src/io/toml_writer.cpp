#include <fmt/format.h>

#include "amble/core/check.hpp"
#include "amble/io/settings_printer.hpp"
#include "amble/io/toml_settings.hpp"

namespace amble::io {
namespace {

/// Collects each table's own keys before its nested tables, because TOML has them in that order.
class TomlWriter final : public SettingsPrinter {
 public:
  TomlWriter() { open_.push_back({}); }

  void begin(std::string_view key, Doc doc) override {
    const std::string& outer = open_.back().path;
    Table table;
    table.path = outer.empty() ? std::string(key) : fmt::format("{}.{}", outer, key);
    table.comment = comment(doc, {});
    open_.push_back(std::move(table));
  }
  void end() override {
    Table table = std::move(open_.back());
    open_.pop_back();
    std::string& nested = open_.back().nested;
    // A table without own keys is implied by the tables within it.
    if (!table.keys.empty()) nested += fmt::format("\n{}[{}]\n{}", table.comment, table.path, table.keys);
    nested += table.nested;
  }

  std::string result() const {
    AMBLE_CHECK(open_.size() == 1, "a table was begun but not ended");
    return open_.front().keys + open_.front().nested;
  }

 private:
  struct Table {
    std::string path;
    std::string comment;
    std::string keys;    ///< lines of its own settings
    std::string nested;  ///< its finished nested tables
  };

  static std::string comment(Doc doc, std::string_view expected) {
    std::string text = fmt::format("# {}\n", doc.what);
    if (!expected.empty() && !doc.source.empty())
      return text + fmt::format("# ({}; source: {})\n", expected, doc.source);
    if (!expected.empty()) return text + fmt::format("# ({})\n", expected);
    if (!doc.source.empty()) return text + fmt::format("# (source: {})\n", doc.source);
    return text;
  }

  void put(std::string_view key, std::string value, std::string_view expected, Doc doc) override {
    open_.back().keys += comment(doc, expected) + fmt::format("{} = {}\n", key, value);
  }

  std::vector<Table> open_;
};

}  // namespace

std::string settings_to_toml(const std::function<void(SettingsVisitor&)>& describe) {
  TomlWriter writer;
  describe(writer);
  return writer.result();
}

}  // namespace amble::io
