#include <fmt/format.h>

#include <cmath>
#include <limits>

#include "amble/core/error.hpp"
#include "amble/io/json_file.hpp"
#include "amble/io/printable.hpp"

namespace amble::io {

std::string JsonView::path_of(std::string_view key) const {
  return path_.empty() ? std::string(key) : fmt::format("{}.{}", path_, key);
}

JsonView JsonView::at(std::string_view key) const {
  if (!json_->is_object()) bad("an object");
  const auto found = json_->find(key);
  if (found == json_->end())
    fail(ExitCode::bad_file, "{}: key '{}' is missing", what_, printable(path_of(key)));
  return JsonView(*found, what_, path_of(key));
}

JsonView JsonView::at(std::size_t index) const {
  const std::string path = fmt::format("{}[{}]", path_, index);
  if (index >= size()) fail(ExitCode::bad_file, "{}: key '{}' is missing", what_, path);
  return JsonView((*json_)[index], what_, path);
}

bool JsonView::has(std::string_view key) const {
  return json_->is_object() && json_->find(key) != json_->end();
}

std::size_t JsonView::size() const {
  if (!json_->is_array()) bad("a list");
  return json_->size();
}

double JsonView::number() const {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  if (json_->is_string() && json_->get_ref<const std::string&>() == "inf") return infinity;
  if (json_->is_string() && json_->get_ref<const std::string&>() == "-inf") return -infinity;
  if (!json_->is_number()) bad("a number");
  const auto value = json_->get<double>();
  if (!std::isfinite(value)) bad("a finite number");
  return value;
}

double JsonView::finite_number() const {
  const double value = number();
  if (!std::isfinite(value)) bad("a finite number");
  return value;
}

std::int64_t JsonView::integer() const {
  if (!json_->is_number_integer()) bad("a whole number");
  constexpr auto highest = static_cast<std::uint64_t>(std::numeric_limits<std::int64_t>::max());
  if (json_->is_number_unsigned() && json_->get<std::uint64_t>() > highest) bad("a whole number below 2^63");
  return json_->get<std::int64_t>();
}

bool JsonView::flag() const {
  if (!json_->is_boolean()) bad("true or false");
  return json_->get<bool>();
}

std::string JsonView::text() const {
  if (!json_->is_string()) bad("text");
  return json_->get<std::string>();
}

void JsonView::bad(std::string_view expected) const {
  refuse(fmt::format("must be {}", expected));
}

void JsonView::refuse(std::string_view problem) const {
  if (path_.empty()) fail(ExitCode::bad_file, "{}: the document {}", what_, problem);
  fail(ExitCode::bad_file, "{}: key '{}' {}", what_, printable(path_), problem);
}

}  // namespace amble::io
