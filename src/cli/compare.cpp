#include <fmt/format.h>

#include <array>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "amble/cli/commands.hpp"
#include "amble/cli/compare_table.hpp"
#include "amble/cli/disturbance.hpp"
#include "amble/cli/help.hpp"
#include "amble/cli/option_checks.hpp"
#include "amble/cli/stop_signal.hpp"
#include "amble/experiment/compare_maps.hpp"
#include "amble/experiment/run_folder.hpp"
#include "amble/physics/engine.hpp"
#include "amble/presentation/comparison.hpp"

namespace amble::cli {
namespace {

constexpr std::array formats{"text", "markdown", "json"};
struct Options {
  std::vector<std::filesystem::path> inputs;
  std::string format = formats[0];
  presentation::CompareOptions how;
};

std::vector<presentation::NamedChampion> load(const std::vector<std::filesystem::path>& inputs) {
  std::vector<presentation::NamedChampion> champions;
  champions.reserve(inputs.size());
  for (const auto& input : inputs)
    champions.push_back({input.string(), experiment::load_champion(experiment::champion_at(input))});
  return champions;
}

ExitCode run_compare(const Options& options) {
  const auto rows = presentation::compare(load(options.inputs), options.how, stop_signal());
  if (!rows) fail(ExitCode::interrupted, "stopped before all champions had walked");
  const auto maps = experiment::compare_maps(options.inputs);
  if (options.format == "json")
    fmt::print("{}\n", presentation::comparison_json(*rows, maps).dump(2));
  else if (options.format == "markdown")
    fmt::print("{}{}", compare_markdown(*rows), maps.empty() ? "" : "\n" + markdown_text(maps_table(maps)));
  else
    fmt::print("{}{}", compare_text(*rows), maps.empty() ? "" : "\n" + aligned_text(maps_table(maps)));
  return ExitCode::ok;
}

}  // namespace

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
