#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "amble/cli/commands.hpp"
#include "amble/cli/compare_table.hpp"
#include "amble/cli/disturbance.hpp"
#include "amble/cli/help.hpp"
#include "amble/cli/option_checks.hpp"
#include "amble/cli/stop_signal.hpp"
#include "amble/experiment/config.hpp"
#include "amble/experiment/episodes.hpp"
#include "amble/experiment/referees.hpp"
#include "amble/experiment/run_folder.hpp"
#include "amble/physics/engine.hpp"

namespace amble::cli {
namespace {

constexpr std::array formats{"text", "markdown", "json"};
struct CompareOptions {
  std::vector<std::filesystem::path> inputs;
  std::vector<double> seconds;  ///< none: as in the champion's evolution
  std::vector<std::string> engines{physics::engine_names().begin(), physics::engine_names().end()};
  std::string format = formats[0];
  std::optional<std::uint32_t> episodes;  ///< of an evaluation, that it has not met
  presentation::TrialChoice disturbance;
};

struct NamedChampion {
  std::string name;
  experiment::Champion champion;
};

std::vector<NamedChampion> load(const std::vector<std::filesystem::path>& inputs) {
  std::vector<NamedChampion> champions;
  champions.reserve(inputs.size());
  for (const auto& input : inputs)
    champions.push_back({input.string(), experiment::load_champion(experiment::champion_at(input))});
  return champions;
}

/// The requested engines and every champion's own, with which the others are compared.
std::vector<std::string> columns(const std::vector<std::string>& requested,
                                 const std::vector<NamedChampion>& champions) {
  for (const auto& engine : requested) physics::check_engine_name(engine, "--engines: ");
  std::vector<std::string> engines;
  for (const auto& name : physics::engine_names())
    if (std::ranges::count(requested, name) > 0 ||
        std::ranges::any_of(
            champions, [&](const NamedChampion& named) { return named.champion.problem.engine == name; }))
      engines.emplace_back(name);
  return engines;
}

/// The trials that tell what a champion typically does, the same in all engines.
std::vector<trial::ScenarioKey> typical_keys(const experiment::Champion& champion, int trials) {
  trial::ScenarioKey key = experiment::typical_key(champion.seed);
  std::vector<trial::ScenarioKey> keys;
  for (int i = 0; i < trials; ++i, ++key.episode) keys.push_back(key);
  return keys;
}

/// Noise that evolution has not used: its episodes have lower numbers.
std::vector<trial::ScenarioKey> unseen_noise(const experiment::Champion& champion, std::uint32_t episodes) {
  std::vector<trial::ScenarioKey> keys;
  for (std::uint32_t e = 0; e < episodes; ++e) keys.push_back(champion.unseen_scenario_key(e));
  return keys;
}

ComparedChampion compare(const NamedChampion& named, double seconds, const std::vector<std::string>& engines,
                         const CompareOptions& options) {
  auto [name, champion] = named;
  experiment::RefereeOptions referee_options{.seconds = seconds, .jobs = static_cast<int>(engines.size())};
  std::string under = "without noise";
  if (!options.disturbance.undisturbed) {
    const auto level = presentation::level_of(champion.problem, options.disturbance);
    champion.problem.noise = level.noise;
    under = level.under();
    const int asked = options.disturbance.trials;
    referee_options.noise = options.episodes
                                ? unseen_noise(champion, *options.episodes)
                                : typical_keys(champion, asked > 0 ? asked : experiment::running_trials);
  }
  try {
    auto results = experiment::try_in_engines(champion.problem, champion.genome, engines, referee_options,
                                              stop_signal());
    if (!results) fail(ExitCode::interrupted, "stopped before all champions had walked");
    return {.name = name,
            .home = champion.problem.engine,
            .trial_s = seconds,
            .under = under,
            .in = std::move(*results)};
  } catch (const UserError& error) {
    if (error.code() == ExitCode::interrupted) throw;
    fail(error.code(), "{}: {} (--engines chooses engines)", name, error.what());
  }
}

ExitCode run_compare(const CompareOptions& options) {
  const auto champions = load(options.inputs);
  const auto engines = columns(options.engines, champions);
  std::vector<ComparedChampion> rows;
  for (const auto& named : champions) {
    auto lengths_s = options.seconds;
    if (lengths_s.empty()) lengths_s.push_back(named.champion.problem.trial.duration_s);
    for (const double length_s : lengths_s) rows.push_back(compare(named, length_s, engines, options));
  }
  const auto maps = compare_maps(options.inputs);
  if (options.format == "json")
    fmt::print("{}", compare_json(rows, maps));
  else if (options.format == "markdown")
    fmt::print("{}{}", compare_markdown(rows), maps.empty() ? "" : "\n" + markdown_text(maps_table(maps)));
  else
    fmt::print("{}{}", compare_text(rows), maps.empty() ? "" : "\n" + aligned_text(maps_table(maps)));
  return ExitCode::ok;
}

}  // namespace

void add_compare(CLI::App& app, Action& action) {
  auto* command = app.add_subcommand(
      "compare",
      "Let champions walk in several physics engines: typical distances, and their share of that where they "
      "evolved");
  auto options = std::make_shared<CompareOptions>();
  command->add_option("INPUT", options->inputs, "Champions (JSON) and run folders (their best champions)")
      ->required();
  command
      ->add_option("--seconds", options->seconds,
                   "Lengths of trials, s, e.g. 15,300 (default: as in evolution)")
      ->delimiter(',')
      ->check(seconds_check());
  command->add_option("--engines", options->engines, "Engines besides the champions' own, e.g. ode,mujoco")
      ->delimiter(',')
      ->type_name(engine_values())
      ->capture_default_str();
  command->add_option("--format", options->format, "What to print: text, markdown or json")
      ->capture_default_str()
      ->check(CLI::IsMember(std::vector<std::string>(formats.begin(), formats.end())));
  add_disturbance(*command, options->disturbance, fmt::format("{}", experiment::running_trials));
  command
      ->add_option("--episodes", options->episodes,
                   "With --noise: in place of --trials so many episodes of an evaluation that it has not "
                   "met, those that "
                   "amble trial numbers from 1000")
      ->needs(command->get_option("--noise"))
      ->excludes(command->get_option("--trials"))
      ->check(between(1u, 1000u));
  add_examples(*command,
               {{"amble compare runs/1 --seconds 15,300", ""},
                {"amble compare runs/1 runs/2 --noise configs/robust/supg-objective.toml --trials 30", ""}});
  command->callback([options, &action] { action = [options] { return run_compare(*options); }; });
}

}  // namespace amble::cli
