#include "amble/io/toml_node.hpp"

#include <algorithm>
#include <charconv>

#include "amble/core/index.hpp"
#include "amble/io/quoting.hpp"

namespace amble::io {

const TomlNode* TomlNode::find(std::string_view key) const {
  const auto found = std::find(keys.begin(), keys.end(), key);
  return found == keys.end() ? nullptr : &items[to_index(found - keys.begin())];
}

std::size_t TomlNode::quoted_key_at(std::string_view path) const {
  for (std::size_t i = 0; i < keys.size(); ++i) {
    const std::string quoted = toml_quoted(keys[i]);
    const std::string_view rest = path.substr(std::min(quoted.size(), path.size()));
    if (path.starts_with(quoted) && (rest.empty() || rest[0] == '.' || rest[0] == '[')) return i;
  }
  return keys.size();
}

const TomlNode* TomlNode::find_path(std::string_view path) const {
  const TomlNode* child = nullptr;
  if (path.starts_with('"')) {
    const std::size_t quoted = quoted_key_at(path);
    if (quoted == keys.size()) return nullptr;
    child = &items[quoted];
    path.remove_prefix(toml_quoted(keys[quoted]).size());
  } else {
    const std::size_t end = std::min(path.find_first_of(".["), path.size());
    child = find(path.substr(0, end));
    path.remove_prefix(end);
  }
  if (child != nullptr && path.starts_with('[')) {
    std::size_t index = child->items.size();
    std::from_chars(path.data() + 1, path.data() + path.size(), index);
    child = child->kind == Kind::list && index < child->items.size() ? &child->items[index] : nullptr;
    path.remove_prefix(std::min(path.find(']'), path.size() - 1) + 1);
  }
  return child == nullptr || !path.starts_with('.') ? child : child->find_path(path.substr(1));
}

void TomlNode::put(std::string_view key, TomlNode value) {
  const auto found = std::find(keys.begin(), keys.end(), key);
  if (found != keys.end()) {
    items[to_index(found - keys.begin())] = std::move(value);
  } else {
    keys.emplace_back(key);
    items.push_back(std::move(value));
  }
}

void TomlNode::drop(std::string_view key) {
  const auto found = std::find(keys.begin(), keys.end(), key);
  if (found == keys.end()) return;
  items.erase(items.begin() + (found - keys.begin()));
  keys.erase(found);
}

void TomlNode::merge(TomlNode table) {
  for (std::size_t i = 0; i < table.keys.size(); ++i) {
    TomlNode& theirs = table.items[i];
    const auto found = std::find(keys.begin(), keys.end(), table.keys[i]);
    TomlNode* ours = found == keys.end() ? nullptr : &items[to_index(found - keys.begin())];
    const bool is_table = ours != nullptr && ours->kind == Kind::table;
    const bool is_text = ours != nullptr && ours->kind == Kind::text;
    if (theirs.kind == Kind::table && (is_table || (is_text && theirs.from_command_line))) {
      ours->merge(std::move(theirs));
      continue;
    }
    if (is_table && theirs.kind == Kind::text && theirs.from_command_line) theirs.take_single_values(*ours);
    put(table.keys[i], std::move(theirs));
  }
}

void TomlNode::take_single_values(const TomlNode& table) {
  for (std::size_t i = 0; i < table.keys.size(); ++i)
    if (table.items[i].kind != Kind::list) put(table.keys[i], table.items[i]);
}

std::string toml_text(const TomlNode& node) {
  using Kind = TomlNode::Kind;
  switch (node.kind) {
    case Kind::table:
      return "{...}";
    case Kind::integer:
      return std::to_string(node.integer);
    case Kind::number:
      return node.number != node.number ? "nan" : toml_number(node.number);
    case Kind::flag:
      return node.flag ? "true" : "false";
    case Kind::date:
      return node.text;
    case Kind::text:
    case Kind::list:
      break;
  }
  constexpr std::size_t longest = 60;
  if (node.kind == Kind::text) {
    if (node.text.size() <= longest) return toml_quoted(node.text);
    std::size_t end = longest;
    while (end > 0 && (static_cast<unsigned char>(node.text[end]) & 0xc0) == 0x80)
      --end;  // not amid a UTF-8 character
    return toml_quoted(node.text.substr(0, end)) + "...";
  }
  std::string text = "[";
  for (const TomlNode& item : node.items) {
    if (text.size() > longest) return text + ", ...]";
    if (text.size() > 1) text += ", ";
    text += toml_text(item);
  }
  return text + "]";
}

}  // namespace amble::io
