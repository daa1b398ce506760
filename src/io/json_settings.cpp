#include <algorithm>

#include "amble/core/check.hpp"
#include "amble/core/index.hpp"
#include "amble/io/json_file.hpp"
#include "amble/io/settings_text.hpp"

namespace amble::io {
namespace {

class Writer final : public SettingsVisitor {
 public:
  explicit Writer(Json& object) : tables_{&object} {}

  using SettingsVisitor::integer;
  void begin(std::string_view key, Doc) override { tables_.push_back(&put(key, Json::object())); }
  void end() override { tables_.pop_back(); }
  void number(std::string_view key, double& value, Range, Doc) override { put(key, json_number(value)); }
  void integer(std::string_view key, std::int64_t& value, Range, Doc) override { put(key, value); }
  void flag(std::string_view key, bool& value, Doc) override { put(key, value); }
  void text(std::string_view key, std::string& value, Doc doc) override {
    if (!doc.first_is_implied || !value.empty()) put(key, value);
  }
  void texts(std::string_view key, std::vector<std::string>& value, Doc doc) override {
    if (!doc.first_is_implied || !value.empty()) put(key, value);
  }
  void numbers(std::string_view key, std::vector<double>& values, Range, Doc) override {
    Json list = Json::array();
    for (const double value : values) list.push_back(json_number(value));
    put(key, std::move(list));
  }
  void list(std::string_view key, SettingsList& items, Doc) override {
    Json list = Json::array();
    for (std::size_t i = 0; i < items.size(); ++i) {
      tables_.push_back(&list.emplace_back(Json::object()));
      items.describe(i, *this);
      tables_.pop_back();
    }
    put(key, std::move(list));
  }
  void choice_index(std::string_view key, int& index, std::span<const std::string_view> names,
                    Doc doc) override {
    if (doc.first_is_implied && index == 0) return;
    AMBLE_CHECK(index >= 0 && to_index(index) < names.size(), "an enum value without a name");
    put(key, names[to_index(index)]);
  }

 private:
  bool leaves_out(std::string_view, bool at_defaults) override { return at_defaults; }
  Json& put(std::string_view key, Json value) {
    Json& table = *tables_.back();
    AMBLE_CHECK(!table.contains(key), "two settings with one key");
    return table[std::string(key)] = std::move(value);
  }

  std::vector<Json*> tables_;  ///< the open ones; nothing is added to one while a table within it is open
};

class Reader final : public SettingsReader {
 public:
  explicit Reader(const JsonView& object) : tables_{{object, {}}} {}

  using SettingsVisitor::integer;
  void begin(std::string_view key, Doc) override { tables_.push_back({get(key), {}}); }
  void end() override {
    refuse_unknown_keys();
    tables_.pop_back();
  }
  void finish() override { refuse_unknown_keys(); }

  void number(std::string_view key, double& value, Range range, Doc) override {
    value = checked_number(get(key), range, expected_number(range));
  }
  void integer(std::string_view key, std::int64_t& value, Range range, Doc) override {
    const JsonView view = get(key);
    if (!view.raw().is_number_integer() || !in_range(range, view.integer()))
      view.bad(expected_integer(range));
    value = view.integer();
  }
  void flag(std::string_view key, bool& value, Doc) override { value = get(key).flag(); }
  void text(std::string_view key, std::string& value, Doc doc) override {
    const bool implied = doc.first_is_implied && !tables_.back().view.has(key);
    value = implied ? std::string() : get(key).text();
  }
  void texts(std::string_view key, std::vector<std::string>& values, Doc doc) override {
    values.clear();
    if (doc.first_is_implied && !tables_.back().view.has(key)) return;
    const JsonView list = get(key);
    values.assign(list.size(), {});
    for (std::size_t i = 0; i < values.size(); ++i) values[i] = list.at(i).text();
  }
  void numbers(std::string_view key, std::vector<double>& values, Range range, Doc) override {
    const JsonView list = get(key);
    values.assign(list.size(), 0.0);
    for (std::size_t i = 0; i < values.size(); ++i)
      values[i] = checked_number(list.at(i), range, expected_number(range));
  }
  void list(std::string_view key, SettingsList& items, Doc) override {
    const JsonView list = get(key);
    items.renew(list.size());
    for (std::size_t i = 0; i < items.size(); ++i) {
      tables_.push_back({list.at(i), {}});
      items.describe(i, *this);
      end();
    }
  }
  void choice_index(std::string_view key, int& index, std::span<const std::string_view> names,
                    Doc doc) override {
    if (doc.first_is_implied && !tables_.back().view.has(key)) {
      index = 0;
      return;
    }
    const JsonView view = get(key);
    const auto found =
        view.raw().is_string() ? std::find(names.begin(), names.end(), view.text()) : names.end();
    if (found == names.end()) view.bad(expected_choice(names));
    index = static_cast<int>(found - names.begin());
  }

 private:
  bool leaves_out(std::string_view key, bool) override { return !tables_.back().view.has(key); }
  struct Table {
    JsonView view;
    std::vector<std::string> known;  ///< keys visited so far
  };

  JsonView get(std::string_view key) {
    tables_.back().known.emplace_back(key);
    return tables_.back().view.at(key);
  }

  static double checked_number(const JsonView& view, Range range, const std::string& expected) {
    const double value = view.number();
    if (!in_range(range, value)) view.bad(expected);
    return value;
  }

  void refuse_unknown_keys() const {
    const Table& table = tables_.back();
    if (!table.view.raw().is_object()) table.view.bad("an object");
    for (const auto& [key, value] : table.view.raw().items()) {
      if (std::find(table.known.begin(), table.known.end(), key) == table.known.end()) {
        table.view.at(key).refuse("is unknown");
      }
    }
  }

  std::vector<Table> tables_;
};

}  // namespace

std::unique_ptr<SettingsVisitor> json_writer(Json& object) {
  return std::make_unique<Writer>(object);
}
std::unique_ptr<SettingsReader> json_reader(const JsonView& object) {
  return std::make_unique<Reader>(object);
}

}  // namespace amble::io
