#pragma once

#include <algorithm>
#include <deque>
#include <initializer_list>
#include <string>
#include <string_view>
#include <utility>

#include "amble/core/error.hpp"

namespace amble {

/// The kinds of something that configs choose by name: amble's own, and those that a program or a plugin
/// adds. `Row` has a `name`. Rows stay where they are. Not thread safe: add before the first config is read.
template <typename Row>
class Registry {
 public:
  /// `what`: "controller", for messages.
  Registry(std::string what, std::initializer_list<Row> own) : what_(std::move(what)), rows_(own) {}

  /// Throws UserError: a name that is empty, has other characters than a–z, 0–9, "-" and "_", or is taken.
  void add(Row row) {
    const std::string_view name = row.name;
    const auto usual = [](char c) {
      return (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || c == '-' || c == '_';
    };
    if (name.empty() || !std::ranges::all_of(name, usual))
      fail(ExitCode::bad_input, "{} '{}': a name has a to z, 0 to 9, '-' and '_', and nothing else", what_,
           name);
    if (find(name) != nullptr)
      fail(ExitCode::bad_input, "{} '{}' exists already: give yours another name", what_, name);
    rows_.push_back(std::move(row));
  }

  /// Null if there is none.
  const Row* find(std::string_view name) const {
    const auto row =
        std::ranges::find(rows_, name, [](const Row& each) { return std::string_view(each.name); });
    return row == rows_.end() ? nullptr : &*row;
  }

  /// In the order in which they are listed to users.
  const std::deque<Row>& rows() const { return rows_; }

 private:
  std::string what_;
  std::deque<Row> rows_;
};

}  // namespace amble
