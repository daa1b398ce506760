#include <cmath>

#include "amble/core/check.hpp"
#include "amble/io/json_file.hpp"

namespace amble::io {
namespace {

constexpr std::size_t line_width = 110;

std::string scalar_text(const Json& value) {
  AMBLE_CHECK(!value.is_number_float() || std::isfinite(value.get<double>()),
              "JSON has no NaN and no infinity");
  return value.dump(-1, ' ', false, Json::error_handler_t::replace);
}

/// `value` on one line, with a space after commas and colons.
std::string one_line(const Json& value) {
  if (!value.is_structured()) return scalar_text(value);
  std::string text(1, value.is_object() ? '{' : '[');
  for (auto item = value.begin(); item != value.end(); ++item) {
    if (item != value.begin()) text += ", ";
    if (value.is_object()) text += scalar_text(item.key()) + ": ";
    text += one_line(*item);
  }
  return text += value.is_object() ? '}' : ']';
}

bool is_list_of_plain_values(const Json& value) {
  if (!value.is_array()) return false;
  for (const Json& item : value) {
    if (item.is_structured()) return false;
  }
  return true;
}

/// `column`: where on its line the value starts; `indent`: that of the line.
void append(std::string& text, const Json& value, std::size_t column, std::size_t indent) {
  const std::string line = one_line(value);
  if (!value.is_structured() || is_list_of_plain_values(value) ||
      (indent > 0 && column + line.size() < line_width)) {
    text += line;
    return;
  }
  text += value.is_object() ? "{" : "[";
  for (auto item = value.begin(); item != value.end(); ++item) {
    text += item == value.begin() ? "\n" : ",\n";
    text.append(indent + 2, ' ');
    const std::string key = value.is_object() ? scalar_text(item.key()) + ": " : std::string();
    text += key;
    append(text, *item, indent + 2 + key.size(), indent + 2);
  }
  text += '\n';
  text.append(indent, ' ');
  text += value.is_object() ? '}' : ']';
}

}  // namespace

std::string json_text(const Json& json) {
  std::string text;
  append(text, json, 0, 0);
  return text += '\n';
}

Json json_number(double value) {
  AMBLE_CHECK(!std::isnan(value), "NaN is not stored in files");
  if (std::isinf(value)) return value > 0.0 ? "inf" : "-inf";
  return value;
}

}  // namespace amble::io
