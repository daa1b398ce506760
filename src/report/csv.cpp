#include "amble/report/csv.hpp"

#include <fmt/format.h>

#include <span>

namespace amble::report {
namespace {

std::string quoted(const std::string& text) {
  if (text.find_first_of(",\"\n\r") == std::string::npos) return text;
  std::string out = "\"";
  for (const char c : text) out += c == '"' ? std::string("\"\"") : std::string(1, c);
  return out + '"';
}

std::string csv_text(const Cell& cell) {
  if (const auto* text = std::get_if<std::string>(&cell)) return quoted(*text);
  if (const auto* number = std::get_if<double>(&cell)) return fmt::format("{}", *number);
  if (const auto* whole = std::get_if<std::int64_t>(&cell)) return fmt::format("{}", *whole);
  return {};
}

}  // namespace

std::string to_csv(const Table& table) {
  std::string out = fmt::format("{}\n", fmt::join(table.header, ","));
  for (const auto& row : table.rows) {
    for (std::size_t i = 0; i < row.size(); ++i) out += (i > 0 ? "," : "") + csv_text(row[i]);
    out += '\n';
  }
  return out;
}

std::string csv_beginning(const Table& table) {
  if (table.fixed_columns == 0) return fmt::format("{}\n", fmt::join(table.header, ","));
  return fmt::format("{},", fmt::join(std::span(table.header).first(table.fixed_columns), ","));
}

}  // namespace amble::report
