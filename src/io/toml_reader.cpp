#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "amble/core/error.hpp"
#include "amble/io/quoting.hpp"
#include "amble/io/settings_text.hpp"
#include "amble/io/text.hpp"
#include "amble/io/toml_node.hpp"

namespace amble::io {
namespace {

using Kind = TomlNode::Kind;

std::string_view last_part(std::string_view path) {
  const std::size_t dot = path.rfind('.');
  return dot == std::string_view::npos ? path : path.substr(dot + 1);
}

std::string_view table_of(std::string_view path) {
  return path.substr(0, path.size() - last_part(path).size());
}

/// The known key that the user may have meant, or nothing: a path in quotes, one of the same table that is
/// spelt much like it, or one of another table that is spelt alike.
std::string nearest(std::string_view key, const std::vector<std::string>& known) {
  if (key.size() > 2 && key.front() == '"' && key.back() == '"') {
    const auto path = std::ranges::find(known, key.substr(1, key.size() - 2));
    return path == known.end() ? std::string() : *path;
  }
  const auto elsewhere = std::ranges::find(known, last_part(key), last_part);
  // Two letters of a short word may have changed places; the same word in another table comes before that.
  const std::size_t of_short = std::min<std::size_t>(last_part(key).size() / 2, 2);
  std::size_t fewest = elsewhere != known.end() ? 2 : 1 + std::max(most_misspelt(last_part(key)), of_short);
  std::string best = elsewhere != known.end() ? *elsewhere : std::string();
  for (const std::string& candidate : known) {
    if (table_of(candidate) != table_of(key)) continue;
    const std::size_t edits = edit_distance(last_part(key), last_part(candidate));
    if (edits < fewest) {
      fewest = edits;
      best = candidate;
    }
  }
  return best;
}

/// " (did you mean 'X'?)", or the keys of its table, if they are few; of the root's none.
std::string what_is_known(std::string_view key, const std::vector<std::string>& known) {
  constexpr std::size_t few = 8;
  if (const std::string meant = nearest(key, known); !meant.empty())
    return fmt::format(" (did you mean '{}'?)", meant);
  std::vector<std::string_view> keys;
  for (const std::string& candidate : known)
    if (table_of(candidate) == table_of(key) && std::ranges::find(keys, last_part(candidate)) == keys.end())
      keys.push_back(last_part(candidate));
  if (table_of(key).empty() || keys.empty() || keys.size() > few) return {};
  return fmt::format("; expected {}", fmt::join(keys, ", "));
}

/// The number of a node, if it has one within the range: a whole number will do, and is compared exactly.
bool read_number(const TomlNode& node, Range range, double& value) {
  if (node.kind == Kind::integer) value = static_cast<double>(node.integer);
  if (node.kind == Kind::number) value = node.number;
  return node.kind == Kind::integer ? in_range(range, node.integer)
                                    : node.kind == Kind::number && in_range(range, value);
}

class TomlReader final : public SettingsReader {
 public:
  explicit TomlReader(const TomlNode& root) : root_(root), tables_{{"", &root, {}}} {}

  using SettingsVisitor::integer;

  void begin(std::string_view key, Doc doc) override {
    const TomlNode* node = get(key);
    const bool is_short = node != nullptr && node->kind == Kind::text && !doc.short_for.empty();
    if (node != nullptr && node->kind != Kind::table && !is_short)
      refuse(key, *node, fmt::format("a table [{}]", path_of(key)));
    tables_.push_back({path_of(key), node, is_short ? doc.short_for : std::string_view()});
  }
  void end() override { tables_.pop_back(); }

  void number(std::string_view key, double& value, Range range, Doc) override {
    const TomlNode* node = get(key);
    if (node == nullptr) return;
    double found = 0.0;
    if (!read_number(*node, range, found)) refuse(key, *node, expected_number(range));
    value = found;
  }
  void integer(std::string_view key, std::int64_t& value, Range range, Doc) override {
    const TomlNode* node = get(key);
    if (node == nullptr) return;
    if (node->kind != Kind::integer || !in_range(range, node->integer))
      refuse(key, *node, expected_integer(range));
    value = node->integer;
  }
  void flag(std::string_view key, bool& value, Doc) override {
    const TomlNode* node = get(key);
    if (node == nullptr) return;
    if (node->kind != Kind::flag) refuse(key, *node, expected_flag);
    value = node->flag;
  }
  void text(std::string_view key, std::string& value, Doc) override {
    const TomlNode* node = get(key);
    if (node == nullptr) return;
    if (node->kind != Kind::text) refuse(key, *node, expected_text);
    value = node->text;
  }
  void texts(std::string_view key, std::vector<std::string>& values, Doc) override {
    const TomlNode* node = get(key);
    if (node == nullptr) return;
    const auto is_text = [](const TomlNode& item) { return item.kind == Kind::text; };
    if (node->kind != Kind::list || !std::all_of(node->items.begin(), node->items.end(), is_text)) {
      refuse(key, *node, expected_texts);
    }
    values.clear();
    for (const TomlNode& item : node->items) values.push_back(item.text);
  }
  void numbers(std::string_view key, std::vector<double>& values, Range range, Doc) override {
    const TomlNode* node = get(key);
    if (node == nullptr) return;
    if (node->kind != Kind::list) refuse(key, *node, expected_numbers(range));
    std::vector<double> found(node->items.size());
    for (std::size_t i = 0; i < found.size(); ++i) {
      if (!read_number(node->items[i], range, found[i])) refuse(key, *node, expected_numbers(range));
    }
    values = std::move(found);
  }
  void choice_index(std::string_view key, int& index, std::span<const std::string_view> names, Doc) override {
    const TomlNode* node = get(key);
    if (node == nullptr) return;
    const auto found =
        node->kind == Kind::text ? std::find(names.begin(), names.end(), node->text) : names.end();
    if (found == names.end()) refuse(key, *node, expected_choice(names));
    index = static_cast<int>(found - names.begin());
  }

  void list(std::string_view key, SettingsList& items, Doc) override {
    const TomlNode* node = get(key);
    if (node == nullptr) return;
    if (node->kind != Kind::list) refuse(key, *node, expected_tables);
    items.renew(node->items.size());
    for (std::size_t i = 0; i < node->items.size(); ++i) {
      const std::string item = numbered(path_of(key), i);
      if (node->items[i].kind != Kind::table) refuse_at(item, node->items[i], expected_table);
      tables_.push_back({item, &node->items[i], {}});
      items.describe(i, *this);
      tables_.pop_back();
    }
  }

  void finish() override { refuse_unknown_keys(root_, ""); }

 private:
  struct Table {
    std::string path;
    const TomlNode* node;             ///< null where the document has no such table
    std::string_view short_for = {};  ///< the key whose value `node` itself is, in place of a table
  };

  static std::string join(const std::string& table, std::string_view key) {
    return table.empty() ? toml_key(key) : fmt::format("{}.{}", table, toml_key(key));
  }
  static std::string numbered(const std::string& path, std::size_t index) {
    return fmt::format("{}[{}]", path, index);
  }
  std::string path_of(std::string_view key) const { return join(tables_.back().path, key); }

  const TomlNode* get(std::string_view key) {
    known_.push_back(path_of(key));
    const TomlNode* table = tables_.back().node;
    if (!tables_.back().short_for.empty() && key == tables_.back().short_for) return table;
    return table == nullptr ? nullptr : table->find(key);
  }

  [[noreturn]] void refuse(std::string_view key, const TomlNode& node, std::string_view expected) const {
    // A value in place of a table is named by the table's key.
    refuse_at(tables_.back().short_for.empty() ? path_of(key) : tables_.back().path, node, expected);
  }

  [[noreturn]] static void refuse_at(const std::string& path, const TomlNode& node,
                                     std::string_view expected) {
    // The text from the command line already names key and value, unless they are within a list or table.
    if (node.from_command_line && node.where.starts_with(fmt::format("--set {}=", path)))
      fail(ExitCode::bad_input, "{}: expected {}", node.where, expected);
    fail(ExitCode::bad_input, "{}: '{}' = {}: expected {}", node.where, path, toml_text(node), expected);
  }

  void refuse_unknown_keys(const TomlNode& table, const std::string& table_path) const {
    for (std::size_t i = 0; i < table.keys.size(); ++i) {
      const std::string path = join(table_path, table.keys[i]);
      const TomlNode& node = table.items[i];
      if (std::find(known_.begin(), known_.end(), path) != known_.end()) {
        if (node.kind != Kind::list) refuse_unknown_keys(node, path);
        for (std::size_t item = 0; node.kind == Kind::list && item < node.items.size(); ++item)
          if (node.items[item].kind == Kind::table)
            refuse_unknown_keys(node.items[item], numbered(path, item));
        continue;
      }
      fail(ExitCode::bad_input, "{}: unknown key '{}'{}", node.where, path, what_is_known(path, known_));
    }
  }

  const TomlNode& root_;
  std::vector<Table> tables_;
  std::vector<std::string> known_;
};

}  // namespace

std::unique_ptr<SettingsReader> make_toml_reader(const TomlNode& root) {
  return std::make_unique<TomlReader>(root);
}

}  // namespace amble::io
