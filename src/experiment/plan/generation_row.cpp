#include "amble/experiment/plan/generation_row.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <algorithm>

#include "amble/core/check.hpp"
#include "amble/core/hash.hpp"
#include "amble/io/text.hpp"
#include "amble/record/generations_csv.hpp"
#include "amble/statistics/descriptive.hpp"

namespace amble::experiment {
namespace {

using Cells = std::vector<std::pair<std::string_view, std::string>>;

/// Column by column, in the file's order.
Cells cells_of(const GenerationRow& row) {
  namespace column = record::column;
  Cells cells;
  const auto add = [&cells](std::string_view name, auto value) {
    cells.emplace_back(name, fmt::format("{}", value));
  };
  const auto add_time = [&cells](std::string_view name, double seconds) {
    cells.emplace_back(name, fmt::format("{:.6f}", seconds));
  };
  add(column::generation, row.generation);
  add(column::best, row.best);
  add(column::best_so_far, row.best_so_far);
  add(column::mean, row.mean);
  add(column::median, row.median);
  add(column::typical, row.typical.median);
  add(column::typical_lower, row.typical.lower_quartile);
  add(column::typical_upper, row.typical.upper_quartile);
  add(column::typical_fell, row.typical.fell_share);
  add(column::best_hidden, row.best_hidden);
  add(column::best_links, row.best_links);
  add(column::fell, row.fell);
  add(column::diverged, row.diverged);
  add(column::evaluations, row.evaluations);
  add(column::steps, row.steps);
  for (const auto& [name, value] : row.search) add(name, value);
  add_time(column::wall_s, row.wall_s);
  add_time(column::outside_s, row.outside_s());
  for (const Stage& stage : stages) add_time(stage.column, row.times.*stage.seconds);
  return cells;
}

/// The names in a header, which may end in a newline.
std::vector<std::string_view> names_in(std::string_view header) {
  if (header.ends_with('\n')) header.remove_suffix(1);
  std::vector<std::string_view> names;
  for (std::size_t comma; (comma = header.find(',')) != std::string_view::npos;
       header.remove_prefix(comma + 1))
    names.push_back(header.substr(0, comma));
  names.push_back(header);
  return names;
}

Cells cells_of(std::span<const search::Metric> search) {
  GenerationRow row;
  row.search.assign(search.begin(), search.end());
  return cells_of(row);
}

/// More than this share of trials must count.
constexpr double least_share = 0.1;
/// A trial that falls within this share of its length shows nothing of a controller.
constexpr double at_once_share = 0.01;

}  // namespace

std::optional<double> GenerationRow::metric(std::string_view name) const {
  const auto found = std::ranges::find(search, name, &search::Metric::name);
  return found == search.end() ? std::nullopt : std::optional(found->value);
}

std::string csv_header(std::span<const search::Metric> search) {
  std::string line;
  for (const auto& [name, value] : cells_of(search))
    line += fmt::format("{}{}", line.empty() ? "" : ",", name);
  return line + "\n";
}

std::string csv_line(const GenerationRow& row, std::string_view header) {
  const Cells cells = cells_of(row);
  std::string line;
  for (const std::string_view name : names_in(header)) {
    const auto cell = std::ranges::find(cells, name, &Cells::value_type::first);
    AMBLE_CHECK(cell != cells.end(), "a column that a run has");
    line += (line.empty() ? "" : ",") + cell->second;
  }
  return line + "\n";
}

std::string unknown_column(std::string_view header, std::span<const search::Metric> search) {
  const Cells cells = cells_of(search);
  for (const std::string_view name : names_in(header))
    if (std::ranges::find(cells, name, &Cells::value_type::first) == cells.end()) return std::string(name);
  return {};
}

void summarise_trials(std::span<const double> objectives, std::span<const record::Trajectory> trajectories,
                      GenerationRow& row) {
  AMBLE_CHECK(!objectives.empty(), "a generation has members");
  row.best = std::ranges::max(objectives);
  row.median = statistics::median(objectives);
  double sum = 0.0;
  for (const double objective : objectives) sum += objective;
  row.mean = sum / static_cast<double>(objectives.size());
  for (const auto& trajectory : trajectories) {
    row.fell += trajectory.outcome == record::Outcome::fell;
    row.diverged += trajectory.outcome == record::Outcome::diverged;
  }
}

void TrialTally::add(std::span<const record::Trajectory> trajectories, int full_steps) {
  trials_ += trajectories.size();
  for (const auto& trajectory : trajectories) {
    diverged_ += trajectory.outcome == record::Outcome::diverged;
    at_once_ +=
        trajectory.outcome == record::Outcome::fell && trajectory.steps <= 1 + at_once_share * full_steps;
  }
}

std::string TrialTally::verdict() const {
  if (trials_ == 0 ||
      static_cast<double>(trials_ - diverged_ - at_once_) > least_share * static_cast<double>(trials_))
    return {};
  std::string how;
  if (diverged_ > 0) how = fmt::format("{} of {} trials diverged", diverged_, trials_);
  if (at_once_ > 0)
    how += fmt::format("{}{} of {} fell at once", how.empty() ? "" : " and ", at_once_, trials_);
  return fmt::format(
      "{}, so the results mean nothing: see what is odd about the robot by `amble robot`, a smaller "
      "trial.timestep_s may help",
      how);
}

std::uint64_t table_digest(std::uint64_t before, std::string_view header, std::string_view line) {
  const auto names = io::split(header.substr(0, header.find('\n')), ',');
  const auto untimed = std::ranges::find(names, record::column::wall_s) - names.begin();
  std::size_t end = 0;
  for (auto column = untimed; column > 0 && end < line.size(); --column)
    end = std::min(line.find(',', end), line.size() - 1) + 1;
  const std::uint64_t digest = hash_bytes(line.data(), end, before);
  return digest == 0 ? 1 : digest;
}

}  // namespace amble::experiment
