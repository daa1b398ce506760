#include "amble/cli/compare.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <array>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "amble/cli/help.hpp"
#include "amble/cli/options.hpp"
#include "amble/cli/progress.hpp"
#include "amble/cli/stop_signal.hpp"
#include "amble/core/index.hpp"
#include "amble/experiment/repertoire.hpp"
#include "amble/experiment/run_folder.hpp"
#include "amble/physics/engine.hpp"
#include "amble/presentation/comparison.hpp"
#include "amble/statistics/descriptive.hpp"

namespace amble::cli {
namespace {

using experiment::EngineResult;
using experiment::share_kept;
using experiment::TrialResult;

/// From this share on a champion counts as one that has kept its distance.
constexpr double enough = 0.7;

using Cells = std::vector<std::string>;

std::string_view outcome_name(const TrialResult& result) {
  return record::outcome_names[to_index(result.outcome)];
}

std::string ending(const TrialResult& result) {
  if (result.outcome == record::Outcome::completed) return "";
  return fmt::format(", {} at {:.2f} s", outcome_name(result), result.seconds);
}

std::string endings(const EngineResult& result) {
  if (result.trials.size() == 1) return ending(result.trials.front());
  const auto early = std::ranges::count_if(
      result.trials, [](const TrialResult& trial) { return trial.outcome != record::Outcome::completed; });
  return early > 0 ? fmt::format(", {} of {} ended early", early, result.trials.size()) : "";
}

std::string distance_text(double distance_m) {
  return fmt::format("{:.3f} m", distance_m);
}

/// Quartiles of fewer trials say little.
constexpr std::size_t fewest_for_quartiles = 4;

/// The distance, and where several trials lie: " [4.9, 5.8]", their quartiles.
std::string spread_text(const EngineResult& result) {
  if (result.trials.size() < fewest_for_quartiles) return "";
  std::vector<double> distances_m;
  for (const TrialResult& trial : result.trials) distances_m.push_back(trial.distance_m);
  return fmt::format(" [{:.2f}, {:.2f}]", statistics::quantile(distances_m, 0.25),
                     statistics::quantile(distances_m, 0.75));
}

std::string kept_text(double distance_m, double of_m) {
  const auto kept = share_kept(distance_m, of_m);
  return kept ? fmt::format(", {:.0f} %", 100.0 * *kept) : "";
}

Cells row_cells(const presentation::ComparedChampion& row) {
  const std::size_t trials = row.in.front().trials.size();
  Cells cells{
      row.name, row.home,
      fmt::format("{}{:g} s {}", trials > 1 ? fmt::format("{} x ", trials) : "", row.trial_s, row.under)};
  for (const auto& result : row.in) {
    const double walked_m = result.distance_m();
    cells.push_back(distance_text(walked_m) + spread_text(result) +
                    (result.engine == row.home ? "" : kept_text(walked_m, row.home_m())) + endings(result));
  }
  return cells;
}

/// What the first cell of summary_cells() means.
constexpr std::string_view summary_note =
    "kept 70 %: of how many champions the distance in this engine is at least 70 % of that in the engine in "
    "which they evolved\n";

/// What a row's percentages mean.
constexpr std::string_view percent_note = "%: share of the distance in the engine in which it evolved\n";

/// What the brackets of a row mean.
constexpr std::string_view quartiles_note = "median [quartiles] of the trials\n";

/// What is below a table with so many rows of champions.
std::string notes(const std::vector<Cells>& lines, std::size_t rows) {
  const auto some_has = [&lines](std::string_view text) {
    return std::ranges::any_of(lines, [text](const Cells& cells) {
      return std::ranges::any_of(
          cells, [text](const std::string& cell) { return cell.find(text) != std::string::npos; });
    });
  };
  std::string text;
  if (some_has(" [")) text += quartiles_note;
  if (some_has(" %")) text += percent_note;
  if (lines.size() > rows + 1) text += summary_note;
  return text;
}

/// All champions for one length of time.
Cells summary_cells(const std::vector<presentation::ComparedChampion>& rows, double trial_s) {
  Cells cells{"median; kept 70 %", "", fmt::format("{:g} s", trial_s)};
  for (std::size_t e = 0; e < rows.front().in.size(); ++e) {
    std::vector<double> distances_m;
    int away = 0, kept = 0;
    for (const auto& row : rows) {
      if (row.trial_s != trial_s) continue;
      distances_m.push_back(row.in[e].distance_m());
      if (row.in[e].engine == row.home) continue;
      ++away;
      kept += share_kept(distances_m.back(), row.home_m()).value_or(0.0) >= enough;
    }
    cells.push_back(distance_text(statistics::median(distances_m)) +
                    (away > 0 ? fmt::format("; {} of {}", kept, away) : ""));
  }
  return cells;
}

/// Head, rows, and a summary per length of time if there are several champions.
std::vector<Cells> table(const std::vector<presentation::ComparedChampion>& rows) {
  std::vector<Cells> lines{{"champion", "evolved in", "trials"}};
  if (rows.empty()) return lines;
  for (const auto& referee : rows.front().in) lines.front().push_back("in " + referee.engine);
  std::vector<double> lengths_s;
  for (const auto& row : rows) {
    lines.push_back(row_cells(row));
    if (std::ranges::find(lengths_s, row.trial_s) == lengths_s.end()) lengths_s.push_back(row.trial_s);
  }
  if (rows.size() > lengths_s.size())
    for (const double length_s : lengths_s) lines.push_back(summary_cells(rows, length_s));
  return lines;
}

constexpr std::array formats{"text", "markdown", "json"};
struct Options {
  std::vector<std::filesystem::path> inputs;
  std::string format = formats[0];
  presentation::CompareOptions how;
};

/// Without those that were named before, which would count twice.
template <typename T>
std::vector<T> each_once(const std::vector<T>& named) {
  std::vector<T> once;
  for (const T& item : named)
    if (std::ranges::find(once, item) == once.end()) once.push_back(item);
  return once;
}

std::vector<presentation::NamedChampion> load(const std::vector<std::filesystem::path>& inputs,
                                              const std::vector<double>& seconds) {
  std::vector<presentation::NamedChampion> champions;
  champions.reserve(inputs.size());
  for (const auto& input : inputs) {
    champions.push_back({input.string(), experiment::load_champion(experiment::champion_at(input))});
    for (const double length_s : seconds) check_seconds(length_s, champions.back().champion.problem.trial);
  }
  return champions;
}

ExitCode run_compare(const Options& options) {
  presentation::CompareOptions how = options.how;
  PartsLine progress("trials");
  how.on_trial = [&progress](std::size_t done, std::size_t of) { progress.show(done, of); };
  how.seconds = each_once(how.seconds);
  const auto inputs = each_once(options.inputs);
  const auto rows = presentation::compare(load(inputs, how.seconds), how, stop_signal());
  if (!rows) fail(ExitCode::interrupted, "stopped before all champions had walked");
  const auto maps = experiment::compare_maps(inputs);
  if (options.format == "json")
    fmt::print("{}\n", presentation::comparison_json(*rows, maps).dump(2));
  else if (options.format == "markdown")
    fmt::print("{}{}", compare_markdown(*rows), maps.empty() ? "" : "\n" + markdown_text(maps_table(maps)));
  else
    fmt::print("{}{}", compare_text(*rows), maps.empty() ? "" : "\n" + aligned_text(maps_table(maps)));
  return ExitCode::ok;
}

}  // namespace

std::string aligned_text(const std::vector<Cells>& lines) {
  std::vector<std::size_t> widths(lines.front().size(), 0);
  for (const auto& cells : lines)
    for (std::size_t c = 0; c < cells.size(); ++c) widths[c] = std::max(widths[c], cells[c].size());
  std::string text;
  for (const auto& cells : lines) {
    std::string line;
    for (std::size_t c = 0; c < cells.size(); ++c) line += fmt::format("{:<{}}  ", cells[c], widths[c]);
    text += line.substr(0, line.find_last_not_of(' ') + 1) + "\n";
  }
  return text;
}

std::string markdown_text(const std::vector<Cells>& lines) {
  std::string text;
  for (const auto& cells : lines) {
    const bool head = text.empty();
    text += fmt::format("| {} |\n", fmt::join(cells, " | "));
    if (!head) continue;
    for (std::size_t c = 0; c < cells.size(); ++c) text += "|---";
    text += "|\n";
  }
  return text;
}

std::vector<std::vector<std::string>> maps_table(const std::vector<experiment::ComparedMap>& maps) {
  std::vector<std::vector<std::string>> lines{{"map", "cells filled", "QD score", "best",
                                               "in common with the first", "better", "worse", "only here",
                                               "only there"}};
  for (const experiment::ComparedMap& map : maps) {
    lines.push_back({map.name,
                     fmt::format("{} of {}, {:.1f} %", map.filled, map.cells, 100.0 * map.filled / map.cells),
                     fmt::format("{:.2f}", map.qd_score), fmt::format("{:.3f}{}", map.best, map.unit)});
    const auto& from = map.from_first;
    if (!from) {
      lines.back().emplace_back(&map == &maps.front() ? "" : "other cells");
      lines.back().resize(lines.front().size());
      continue;
    }
    for (const auto count : {from->common, from->better, from->worse, from->only_here, from->only_there})
      lines.back().push_back(fmt::format("{}", count));
  }
  return lines;
}

std::string compare_text(const std::vector<presentation::ComparedChampion>& rows) {
  const auto lines = table(rows);
  return aligned_text(lines) + notes(lines, rows.size());
}

std::string compare_markdown(const std::vector<presentation::ComparedChampion>& rows) {
  const auto lines = table(rows);
  const std::string text = notes(lines, rows.size());
  return markdown_text(lines) + (text.empty() ? "" : "\n" + text);
}

std::string result_text(const TrialResult& result, double home_m) {
  return distance_text(result.distance_m) + kept_text(result.distance_m, home_m) + ending(result);
}

void add_compare(CLI::App& app, Action& action) {
  auto* command = app.add_subcommand(
      "compare",
      "Let champions walk in several physics engines: typical distances, and their share of that where they "
      "evolved");
  auto options = std::make_shared<Options>();
  command->add_option("INPUT", options->inputs, "Champions (JSON) and run folders (their best champions)")
      ->required();
  command
      ->add_option("--seconds", options->how.seconds,
                   "Lengths of trials, s, e.g. 15,300 (default: as in evolution)")
      ->delimiter(',')
      ->check(seconds_check());
  command
      ->add_option(
          "--engines", options->how.engines,
          "Engines besides the champions' own, e.g. ode,mujoco (default: all; mujoco-model where the "
          "robots carry their models)")
      ->delimiter(',')
      ->type_name(engine_values());
  command->add_option("--format", options->format, "What to print: text, markdown or json")
      ->capture_default_str()
      ->check(CLI::IsMember(std::vector<std::string>(formats.begin(), formats.end())));
  add_disturbance(*command, options->how.disturbance, fmt::format("{}", experiment::running_trials));
  command
      ->add_option("--episodes", options->how.episodes,
                   "With --noise: in place of --trials so many trials that evolution has not met, those of "
                   "amble trial --unseen")
      ->needs(command->get_option("--noise"))
      ->excludes(command->get_option("--trials"))
      ->check(between(1u, 1000u));
  add_examples(*command,
               {{"amble compare runs/1 --seconds 15,300", ""},
                {"amble compare runs/1 runs/2 --noise configs/robust/supg-objective.toml --trials 30", ""}});
  command->callback([options, &action] { action = [options] { return run_compare(*options); }; });
}

}  // namespace amble::cli
