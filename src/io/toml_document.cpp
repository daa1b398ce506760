#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "amble/core/error.hpp"
#include "amble/io/file.hpp"
#include "amble/io/quoting.hpp"
#include "amble/io/text.hpp"
#include "amble/io/toml_node.hpp"
#include "amble/io/toml_settings.hpp"

namespace amble::io {
namespace {

constexpr std::uint64_t size_limit_bytes = std::uint64_t{1} << 20;
constexpr int include_limit = 100;

/// Reads a file and what it includes; one loader per document.
class Loader {
 public:
  TomlNode load(const std::filesystem::path& path) {
    open_.push_back(path);
    TomlNode result =
        resolve(parse_toml(read_file(path, size_limit_bytes), path.string(), path.parent_path()));
    open_.pop_back();
    return result;
  }

  /// The included documents, in order, overridden by the document itself.
  TomlNode resolve(TomlNode document) {
    const TomlNode* include = document.find("include");
    if (include == nullptr) return document;
    TomlNode merged;
    merged.where = document.where;
    merged.folder = document.folder;
    if (include->kind != TomlNode::Kind::list) bad(*include, "expected a list of file names in quotes");
    for (const TomlNode& name : include->items) merged.merge(load_included(*include, name));
    document.drop("include");
    merged.merge(std::move(document));
    return merged;
  }

 private:
  [[noreturn]] static void bad(const TomlNode& include, const std::string& why) {
    fail(ExitCode::bad_input, "{}: 'include' = {}: {}", include.where, toml_text(include), why);
  }

  TomlNode load_included(const TomlNode& include, const TomlNode& name) {
    if (name.kind != TomlNode::Kind::text) bad(include, "expected a list of file names in quotes");
    const auto path = (include.folder / name.text).lexically_normal();
    if (++included_ > include_limit)
      bad(include, fmt::format("more than {} files are included", include_limit));
    for (const auto& open : open_) {
      std::error_code none;
      if (std::filesystem::equivalent(open, path, none)) bad(include, circle(path));
    }
    std::error_code error;
    const auto status = std::filesystem::status(path, error);
    if (!std::filesystem::exists(status)) {
      const bool preset = std::ranges::find(path, "configs") != path.end();
      fail(ExitCode::io, "{}: 'include' = {}: {}: No such file or directory{}", include.where,
           toml_text(include), printable(path.string()),
           preset
               ? "; the presets are in amble's folder configs/, of its sources or of where it is installed "
                 "(share/amble): correct the path"
               : "");
    }
    if (!std::filesystem::is_regular_file(status))
      bad(include, printable(path.string()) + " is not a regular file");
    return load(path);
  }

  std::string circle(const std::filesystem::path& path) const {
    std::string text = "the files include each other in a circle: ";
    for (const auto& open : open_) text += printable(open.string()) + " -> ";
    return text + printable(path.string());
  }

  std::vector<std::filesystem::path> open_;
  int included_ = 0;
};

/// The value of --set: TOML if it is that, else a string, unless it began like a string, list or table.
TomlNode parse_value(std::string_view value, const std::string& where) {
  const auto parse = [&](std::string_view toml) {
    TomlNode table = parse_toml(fmt::format("value = {}", toml), where, {});
    if (table.items.size() != 1) fail(ExitCode::bad_input, "{}: not one value", where);
    return std::move(table.items.front());
  };
  try {
    return parse(value);
  } catch (const UserError&) {
    const bool quoted = std::string_view("\"'[{").find(value.front()) != std::string_view::npos;
    if (quoted) fail(ExitCode::bad_input, "{}: the value is not valid TOML", where);
  }
  try {
    return parse(toml_quoted(value));
  } catch (const UserError&) {
    fail(ExitCode::bad_input, "{}: the value is not valid UTF-8", where);
  }
}

/// A value on one line, not shortened as toml_text() is.
std::string whole_text(const TomlNode& node) {
  std::string items;
  for (std::size_t i = 0; i < node.items.size(); ++i) {
    if (i > 0) items += ", ";
    if (node.kind == TomlNode::Kind::table) items += toml_key(node.keys[i]) + " = ";
    items += whole_text(node.items[i]);
  }
  switch (node.kind) {
    case TomlNode::Kind::table:
      return fmt::format("{{{}}}", items);
    case TomlNode::Kind::list:
      return fmt::format("[{}]", items);
    case TomlNode::Kind::text:
      return toml_quoted(node.text);
    case TomlNode::Kind::integer:
      return fmt::format("{}", node.integer);
    case TomlNode::Kind::number:
      return std::isnan(node.number) ? "nan" : toml_number(node.number);
    case TomlNode::Kind::flag:
      return node.flag ? "true" : "false";
    case TomlNode::Kind::date:
      break;
  }
  return node.text;
}

void mark_as_from_command_line(TomlNode& node, const std::string& where) {
  node.where = where;
  node.from_command_line = true;
  for (TomlNode& item : node.items) mark_as_from_command_line(item, where);
}

}  // namespace

struct TomlDocument::Impl {
  TomlNode root;
};

TomlDocument::TomlDocument(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
TomlDocument::~TomlDocument() = default;
TomlDocument::TomlDocument(const TomlDocument& other) : impl_(std::make_unique<Impl>(*other.impl_)) {}
TomlDocument::TomlDocument(TomlDocument&&) noexcept = default;
TomlDocument& TomlDocument::operator=(TomlDocument&&) noexcept = default;

TomlDocument TomlDocument::read(const std::filesystem::path& path) {
  return TomlDocument(std::make_unique<Impl>(Impl{Loader().load(path)}));
}

TomlDocument TomlDocument::parse(std::string_view text, const std::string& name) {
  TomlNode document = parse_toml(text, name, std::filesystem::path(name).parent_path());
  return TomlDocument(std::make_unique<Impl>(Impl{Loader().resolve(std::move(document))}));
}

void TomlDocument::set(std::string_view assignment) {
  const std::string where = fmt::format("--set {}", printable(assignment));
  const std::size_t equals = assignment.find('=');
  if (equals == std::string_view::npos || equals + 1 == assignment.size()) {
    fail(ExitCode::bad_input, "{}: expected KEY.PATH=VALUE", where);
  }
  TomlNode node = parse_value(assignment.substr(equals + 1), where);

  // Wrap the value into its tables, the innermost first.
  std::string_view path = assignment.substr(0, equals);
  while (true) {
    const std::size_t dot = path.rfind('.');
    const std::string_view key = dot == std::string_view::npos ? path : path.substr(dot + 1);
    if (!is_bare_key(key)) fail(ExitCode::bad_input, "{}: expected KEY.PATH=VALUE", where);
    TomlNode table;
    table.put(key, std::move(node));
    node = std::move(table);
    if (dot == std::string_view::npos) break;
    path = path.substr(0, dot);
  }
  mark_as_from_command_line(node, where);
  impl_->root.merge(std::move(node));
}

std::string TomlDocument::text() const {
  std::string text;
  for (std::size_t i = 0; i < impl_->root.keys.size(); ++i)
    text += fmt::format("{} = {}\n", toml_key(impl_->root.keys[i]), whole_text(impl_->root.items[i]));
  return text;
}

std::unique_ptr<TomlDocument::Reader> TomlDocument::reader() const {
  return make_toml_reader(impl_->root);
}

bool TomlDocument::has(std::string_view key_path) const {
  return impl_->root.find_path(key_path) != nullptr;
}

bool TomlDocument::is_list(std::string_view key_path) const {
  const TomlNode* node = impl_->root.find_path(key_path);
  return node != nullptr && node->kind == TomlNode::Kind::list;
}

std::vector<std::string> TomlDocument::keys_of(std::string_view key_path) const {
  const TomlNode* node = impl_->root.find_path(key_path);
  return node != nullptr && node->kind == TomlNode::Kind::table ? node->keys : std::vector<std::string>();
}

std::filesystem::path TomlDocument::folder_of(std::string_view key_path) const {
  const TomlNode* node = impl_->root.find_path(key_path);
  return node == nullptr ? impl_->root.folder : node->folder;
}

std::string TomlDocument::where(std::string_view key_path) const {
  return where(std::vector<std::string>{std::string(key_path)});
}

std::string TomlDocument::where(const std::vector<std::string>& key_paths) const {
  const TomlNode& root = impl_->root;
  const auto rank = [&](const TomlNode& node) {
    return node.from_command_line ? 2 : node.where.starts_with(root.where + ":") ? 1 : 0;
  };
  const TomlNode* found = nullptr;
  for (std::string path : key_paths) {
    const TomlNode* node = root.find_path(path);
    // Where an item of a list lacks the key, the item; where a list lacks the item, the list.
    for (std::size_t end = path.size();
         node == nullptr && (end = path.find_last_of("[]", end - 1)) != std::string::npos;) {
      node = root.find_path(path.substr(0, path[end] == ']' ? end + 1 : end));
      if (end == 0) break;
    }
    if (node != nullptr && (found == nullptr || rank(*node) > rank(*found))) found = node;
  }
  return found == nullptr ? root.where : found->where;
}

}  // namespace amble::io
