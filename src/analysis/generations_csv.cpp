#include "amble/analysis/generations_csv.hpp"

#include <array>
#include <charconv>
#include <cmath>
#include <utility>

#include "amble/core/error.hpp"
#include "amble/io/file.hpp"

namespace amble::analysis {
namespace {

using Column = std::vector<double> Generations::*;

constexpr std::array<std::pair<std::string_view, Column>, 10> columns{{
    {"generation", &Generations::generation},
    {"best_m", &Generations::best_m},
    {"mean_m", &Generations::mean_m},
    {"median_m", &Generations::median_m},
    {"species", &Generations::species},
    {"threshold", &Generations::threshold},
    {"mean_hidden", &Generations::mean_hidden},
    {"mean_links", &Generations::mean_links},
    {"evaluations", &Generations::evaluations},
    {"steps", &Generations::steps},
}};

std::vector<std::string_view> split(std::string_view line) {
  std::vector<std::string_view> cells;
  for (std::size_t comma; (comma = line.find(',')) != std::string_view::npos; line.remove_prefix(comma + 1))
    cells.push_back(line.substr(0, comma));
  cells.push_back(line);
  return cells;
}

/// Takes the first line off `text`, without its end.
std::string_view take_line(std::string_view& text) {
  const std::size_t end = text.find('\n');
  std::string_view line = text.substr(0, end);
  text.remove_prefix(end == std::string_view::npos ? text.size() : end + 1);
  if (line.ends_with('\r')) line.remove_suffix(1);
  return line;
}

double parse_cell(std::string_view cell, std::string_view column, const std::string& name, int line) {
  double value = 0.0;
  const auto [end, error] = std::from_chars(cell.data(), cell.data() + cell.size(), value);
  if (error != std::errc() || end != cell.data() + cell.size() || !std::isfinite(value))
    fail(ExitCode::bad_file, "{}:{}: column '{}': expected a number, found '{}'", name, line, column, cell);
  return value;
}

/// Where each of `columns` stands in the header row.
std::array<std::size_t, columns.size()> find_columns(const std::vector<std::string_view>& header,
                                                     const std::string& name) {
  std::array<std::size_t, columns.size()> places{};
  for (std::size_t c = 0; c < columns.size(); ++c) {
    while (places[c] < header.size() && header[places[c]] != columns[c].first) ++places[c];
    if (places[c] == header.size())
      fail(ExitCode::bad_file, "{}:1: column '{}' is missing", name, columns[c].first);
  }
  return places;
}

}  // namespace

Generations read_generations(const std::filesystem::path& path) {
  return parse_generations(io::read_file(path), path.string());
}

Generations parse_generations(std::string_view text, const std::string& name) {
  if (text.empty())
    fail(ExitCode::bad_file, "{}:1: expected a row of column names, found an empty file", name);
  const auto header = split(take_line(text));
  const auto places = find_columns(header, name);
  Generations table;
  for (int line = 2; !text.empty(); ++line) {
    const auto cells = split(take_line(text));
    if (cells.size() != header.size())
      fail(ExitCode::bad_file, "{}:{}: expected {} columns, found {}", name, line, header.size(),
           cells.size());
    for (std::size_t c = 0; c < columns.size(); ++c)
      (table.*columns[c].second).push_back(parse_cell(cells[places[c]], columns[c].first, name, line));
  }
  return table;
}

}  // namespace amble::analysis
