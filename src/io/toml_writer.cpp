#include <fmt/format.h>

#include "amble/core/check.hpp"
#include "amble/io/settings_text.hpp"
#include "amble/io/toml_settings.hpp"

namespace amble::io {
namespace {

/// The fields of an item as TOML, key by key.
class ItemPrinter final : public SettingsPrinter {
 public:
  struct Field {
    std::string key, value;
  };
  const std::vector<Field>& fields() const { return fields_; }

  void begin(std::string_view, Doc) override { AMBLE_CHECK(false, "an item of a list holds no tables"); }
  void end() override {}
  void list(std::string_view, SettingsList&, Doc) override {
    AMBLE_CHECK(false, "an item of a list holds no lists of tables");
  }

 private:
  void put(std::string_view key, std::string value, std::string_view, Doc) override {
    fields_.push_back({std::string(key), std::move(value)});
  }

  std::vector<Field> fields_;
};

/// Item by item on a line of its own; what has its default value is left out.
std::string list_text(SettingsList& items) {
  if (items.size() == 0) return "[]";
  ItemPrinter defaults;
  items.describe_default(defaults);
  std::string text = "[\n";
  for (std::size_t i = 0; i < items.size(); ++i) {
    ItemPrinter item;
    items.describe(i, item);
    AMBLE_CHECK(item.fields().size() == defaults.fields().size(), "the items of a list have the same keys");
    std::string fields;
    for (std::size_t k = 0; k < item.fields().size(); ++k) {
      const auto& [key, value] = item.fields()[k];
      if (value != defaults.fields()[k].value)
        fields += fmt::format("{} {} = {}", fields.empty() ? "" : ",", key, value);
    }
    text += fields.empty() ? "  {},\n" : fmt::format("  {{{} }},\n", fields);
  }
  return text + "]";
}

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

  void list(std::string_view key, SettingsList& items, Doc doc) override {
    put(key, list_text(items), expected_tables, doc);
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
