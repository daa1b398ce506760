#include "amble/cli/compare.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "amble/cli/commands.hpp"
#include "amble/cli/stop_signal.hpp"
#include "amble/experiment/replay.hpp"
#include "amble/physics/engine.hpp"

namespace amble::cli {
namespace {

struct CompareOptions {
  std::vector<std::filesystem::path> champions;
  std::vector<double> seconds;  ///< none: as in the champion's evolution
  std::vector<std::string> engines{physics::engine_names.begin(), physics::engine_names.end()};
};

constexpr std::string_view row = "{:<{}}  {:>8}  {:<8}  {:>11}  {:>8}  {:<10}  {:>6}\n";

void print_result(const std::string& name, std::size_t width, double seconds, const std::string& engine,
                  const experiment::TrialResult& result, const std::string& kept) {
  fmt::print(row, name, width, fmt::format("{:g}", seconds), engine, fmt::format("{:.3f}", result.distance_m),
             fmt::format("{:.2f}", result.seconds),
             record::outcome_names[static_cast<std::size_t>(result.outcome)], kept);
}

/// All engines for one champion and one duration, its own first. False if a signal came.
bool compare(const experiment::Champion& champion, double seconds, const std::string& name, std::size_t width,
             const std::vector<std::string>& engines) {
  const auto& home = champion.problem.engine;
  const auto in = [&](const std::string& engine) {
    return experiment::replay(champion.problem, champion.genome, {.seconds = seconds, .engine = engine},
                              stop_signal());
  };
  const auto at_home = in(home);
  if (!at_home) return false;
  print_result(name, width, seconds, home, at_home->result, "home");
  for (const auto& engine : engines) {
    if (engine == home) continue;
    const auto away = in(engine);
    if (!away) return false;
    print_result(name, width, seconds, engine, away->result,
                 share_text(away->result.distance_m, at_home->result.distance_m));
  }
  return true;
}

ExitCode run_compare(const CompareOptions& options) {
  for (const auto& engine : options.engines) physics::check_engine_name(engine);
  std::vector<experiment::Champion> champions;
  std::size_t width = std::string_view("champion").size();
  for (const auto& path : options.champions) {
    champions.push_back(experiment::load_champion(path));
    width = std::max(width, path.string().size());
  }
  fmt::print(row, "champion", width, "trial, s", "engine", "distance, m", "upright", "outcome", "kept");
  for (std::size_t i = 0; i < champions.size(); ++i) {
    auto durations = options.seconds;
    if (durations.empty()) durations.push_back(champions[i].problem.trial.duration_s);
    for (const double seconds : durations)
      if (!compare(champions[i], seconds, options.champions[i].string(), width, options.engines))
        return ExitCode::interrupted;
  }
  return ExitCode::ok;
}

}  // namespace

std::string share_text(double distance_m, double of_m) {
  return of_m > 0.0 ? fmt::format("{:.0f} %", 100.0 * distance_m / of_m) : "–";
}

void add_compare(CLI::App& app, Action& action) {
  auto* command = app.add_subcommand("compare", "Let champions walk in several physics engines, as a table");
  auto options = std::make_shared<CompareOptions>();
  command->add_option("CHAMPION", options->champions, "Champion files (JSON)")->required();
  command
      ->add_option("--seconds", options->seconds, "Lengths of trials, e.g. 15,300 (default: as in evolution)")
      ->delimiter(',')
      ->check(CLI::PositiveNumber);
  command->add_option("--engines", options->engines, "Engines besides the champion's own, e.g. ode,mujoco")
      ->delimiter(',')
      ->capture_default_str();
  command->callback([options, &action] { action = [options] { return run_compare(*options); }; });
}

}  // namespace amble::cli
