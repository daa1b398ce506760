#include "amble/record/generations_csv.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <utility>

#include "amble/core/error.hpp"
#include "amble/core/index.hpp"
#include "amble/io/file.hpp"
#include "amble/io/text.hpp"

namespace amble::record {
namespace {

using Column = std::vector<double> Generations::*;

constexpr std::array<std::pair<std::string_view, Column>, 6> columns{{
    {column::generation, &Generations::generation},
    {column::best, &Generations::best},
    {column::mean, &Generations::mean},
    {column::median, &Generations::median},
    {column::evaluations, &Generations::evaluations},
    {column::steps, &Generations::steps},
}};

/// Columns that may be absent, or whose cells may be empty in every row.
constexpr std::array<std::pair<std::string_view, Column>, 26> optional_columns{{
    {"species", &Generations::species},
    {"threshold", &Generations::threshold},
    {"mean_hidden", &Generations::mean_hidden},
    {"mean_links", &Generations::mean_links},
    {"archive", &Generations::archive},
    {"novelty_threshold", &Generations::novelty_threshold},
    {"best_novelty", &Generations::best_novelty},
    {"coverage", &Generations::coverage},
    {"qd_score", &Generations::qd_score},
    {"map_best", &Generations::map_best},
    {"entered", &Generations::entered},
    {"improved", &Generations::improved},
    {"reevaluated", &Generations::reevaluated},
    {column::wall_s, &Generations::wall_s},
    {"physics_s", &Generations::physics_s},
    {"decode_s", &Generations::decode_s},
    {"control_s", &Generations::control_s},
    {"waiting_s", &Generations::waiting_s},
    {"search_s", &Generations::search_s},
    {"referees_s", &Generations::referees_s},
    {"files_s", &Generations::files_s},
    {column::best_so_far, &Generations::best_so_far},
    {column::typical, &Generations::typical},
    {column::typical_lower, &Generations::typical_lower},
    {column::typical_upper, &Generations::typical_upper},
    {column::typical_fell, &Generations::typical_fell},
}};

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

/// The index of a column in the header row; the header's size if it is missing.
std::size_t find_column(const std::vector<std::string_view>& header, std::string_view column) {
  const auto found = std::ranges::find(header, column);
  if (found != header.end()) return to_index(found - header.begin());
  // As it was called in run folders up to version 5.
  const std::string earlier = std::string(column) + "_m";
  return to_index(std::ranges::find(header, earlier) - header.begin());
}

void parse_row(const std::vector<std::string_view>& header, const std::vector<std::string_view>& cells,
               const std::string& name, int line, Generations& table) {
  for (const auto& [column, values] : columns)
    (table.*values).push_back(parse_cell(cells[find_column(header, column)], column, name, line));
  for (const auto& [column, values] : optional_columns) {
    const std::size_t place = find_column(header, column);
    const bool filled = place < header.size() && !cells[place].empty();
    if (!filled && (table.*values).empty()) continue;
    if (!filled || (table.*values).size() + 1 != table.count())
      fail(ExitCode::bad_file, "{}:{}: column '{}': filled in some rows only", name, line, column);
    (table.*values).push_back(parse_cell(cells[place], column, name, line));
  }
}

}  // namespace

bool keeps_champion(const Generations& generations, std::size_t index) {
  const std::vector<double>& champion = generations.best_so_far;
  if (index == 0) return champion.empty() || champion[0] == generations.best[0];
  if (!champion.empty()) return champion[index] != champion[index - 1];
  const auto here = generations.best.begin() + static_cast<std::ptrdiff_t>(index);
  return std::all_of(generations.best.begin(), here, [&](double earlier) { return earlier < *here; });
}

Generations read_generations(const std::filesystem::path& path) {
  return parse_generations(io::read_file(path), path.string());
}

Generations parse_generations(std::string_view text, const std::string& name) {
  if (text.empty())
    fail(ExitCode::bad_file, "{}:1: expected a row of column names, found an empty file", name);
  const bool is_whole = text.ends_with('\n');
  const auto header = io::split(take_line(text), ',');
  for (const auto& [column, values] : columns)
    if (find_column(header, column) == header.size())
      fail(ExitCode::bad_file, "{}:1: column '{}' is missing", name, column);
  Generations table;
  for (int line = 2; !text.empty(); ++line) {
    const auto cells = io::split(take_line(text), ',');
    if (text.empty() && !is_whole) break;  // a row that was being written as its machine stopped
    if (cells.size() != header.size())
      fail(ExitCode::bad_file, "{}:{}: expected {} columns, found {}", name, line, header.size(),
           cells.size());
    parse_row(header, cells, name, line, table);
  }
  return table;
}

}  // namespace amble::record
