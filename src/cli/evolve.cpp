#include <fmt/format.h>
#include <fmt/ranges.h>

#include <csignal>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <utility>

#include "amble/cli/help.hpp"
#include "amble/cli/live_server.hpp"
#include "amble/cli/messages.hpp"
#include "amble/cli/options.hpp"
#include "amble/cli/progress.hpp"
#include "amble/cli/stop_signal.hpp"
#include "amble/experiment/config.hpp"
#include "amble/experiment/idle_settings.hpp"
#include "amble/experiment/repertoire.hpp"
#include "amble/experiment/run.hpp"
#include "amble/experiment/start_look.hpp"
#include "amble/io/quoting.hpp"
#include "amble/robot/doubts.hpp"

namespace amble::cli {
namespace {

struct EvolveOptions {
  std::filesystem::path config, out;
  experiment::Overrides overrides;
  int jobs = 1;
  WatchOptions watch;
};

/// What the champion typically does, and behind it what made it the champion.
void print_best(const experiment::Run& run, int jobs) {
  const auto& progress = run.progress();
  const auto& score = run.config().score;
  const auto champion = experiment::load_champion(run.paths().champion(progress.best_generation));
  auto trials = presentation::typical_trials(champion.problem, champion.seed, {}, jobs);
  const auto results = trials.run(champion.genome, stop_signal());
  if (!results) fail(ExitCode::interrupted, "stopped before the best had walked; the run is complete");
  const auto typical = experiment::typical_objective(champion.problem, *results);
  const auto text = [&score](double value) { return score::with_unit(fmt::format("{:.3f}", value), score); };
  fmt::print("best: {}\n", experiment::typical_text(typical, score, champion.problem.trial.duration_s,
                                                    trials.level().under()));
  fmt::print("      {}{} without noise; generation {}, {} evaluations\n",
             champion.problem.trials_vary() ? fmt::format("{} in its evaluation, ", text(progress.best)) : "",
             text(champion.result.value()), progress.best_generation, progress.evaluations);
  if (!score.is_distance()) fmt::print("      by its score: {} (docs/SCORES.md)\n", score::described(score));
  const auto weak = robot::weak_joints(run.robot());
  if (typical.fell_share > 0.5 && !weak.empty())
    fmt::print("note: it falls in most of these trials, and motors are too weak to hold it up: {}\n",
               fmt::join(weak, ", "));
  else if (typical.fell_share > 0.5)
    fmt::print(
        "note: it falls in most of these trials. More generations may help: amble resume {} --generations "
        "{}\n",
        io::shell_word(run.paths().folder.string()), 2 * run.config().generations);
}

/// What may make a run meaningless is better known before it has taken hours.
void print_oddities(const experiment::Run& run) {
  for (const auto& odd : experiment::odd_for_run(run.robot(), run.config()))
    print_message(fmt::format("note: {}\n", odd));
}

/// Throws UserError where an option of its own and --set say the same setting.
void refuse_double_settings(const experiment::Overrides& overrides) {
  for (const std::string& assignment : overrides.assignments) {
    const std::string key = assignment.substr(0, assignment.find_first_of(" ="));
    if ((key == "seed" && overrides.seed) || (key == "generations" && overrides.generations))
      fail(ExitCode::bad_input, "--{}: --set {} says the same setting; expected one of both", key,
           assignment);
  }
}

/// `named`: the folder as it was given. `server`: may be null.
ExitCode execute(experiment::Run run, const std::filesystem::path& named, int jobs,
                 std::unique_ptr<LiveServer> server) {
  std::signal(SIGPIPE, SIG_IGN);  // the run goes on if the reader of its progress ends
  const std::string folder = named.string(), word = io::shell_word(folder);
  if (run.generation() >= run.config().generations)
    fmt::print("{}: all {} generations are done; for more: --generations N\n", folder,
               run.config().generations);
  experiment::RunStatus status;
  if (server) server->begin(named);
  {
    ProgressLine progress(run.generation(), run.config());
    status = run.execute(progress, stop_signal());
  }
  if (status == experiment::RunStatus::interrupted) {
    const std::string text = fmt::format("stopped at generation {} of {}; to continue, run: amble resume {}",
                                         run.generation(), run.config().generations, word);
    print_message(text + "\n");
    if (server) server->end("The run was " + text);
    return ExitCode::interrupted;
  }
  if (server) server->end(fmt::format("The run has ended; its files are in {}", folder));
  print_best(run, jobs);
  const bool has_map = experiment::fills_map(run.config());
  fmt::print("to read about it, run: amble view {} --static -o page.html\n", word);
  fmt::print("to see it, run: amble {} {} -o {}\n", has_map ? "repertoire" : "view", word,
             has_map ? "map.html" : "walker.html");
  const std::string verdict = run.tally().verdict();
  if (!verdict.empty()) fail(ExitCode::bad_input, "{}: {}", folder, verdict);
  return ExitCode::ok;
}

}  // namespace

void add_evolve(CLI::App& app, Action& action) {
  auto* command = app.add_subcommand("evolve", "Evolve controllers as a config file says, into a run folder");
  auto options = std::make_shared<EvolveOptions>();
  command->add_option("CONFIG", options->config, "Config file (TOML)")->required();
  command
      ->add_option("--set", options->overrides.assignments,
                   "Lay key.path=value over the config, e.g. population.size=100 (repeatable)")
      ->type_name("KEY=VALUE")
      ->allow_extra_args(false);
  command->add_option("--seed", options->overrides.seed, "Seed of all randomness (default: the config's)")
      ->check(between(std::int64_t{0}, experiment::largest_seed));
  command
      ->add_option("--generations", options->overrides.generations,
                   "Generations to evaluate (default: the config's)")
      ->check(between(1, experiment::most_generations));
  command->add_option("-o,--out", options->out, "The run folder to make; it must be new or empty")
      ->required();
  add_jobs(*command, options->jobs);
  add_watch(*command, options->watch, "run");
  add_examples(
      *command,
      {{"amble evolve configs/quick/quadruped.toml --seed 8 --out runs/1", "a walker in 40 s"},
       {"amble evolve configs/quick/quadruped.toml --set population.size=300 --generations 100 --out runs/2",
        ""},
       {"amble evolve configs/quick/quadruped.toml --out runs/3 --watch",
        "and a page to watch it in a browser"}});
  command->callback([options, &action] {
    action = [options] {
      stop_signal();
      refuse_double_settings(options->overrides);
      const auto config = experiment::load_config(options->config, options->overrides);
      auto server = server_for(options->watch);
      auto run = experiment::Run::start(options->out, config, options->jobs);
      print_oddities(run);
      for (const auto& idle : experiment::idle_assignments(config, options->overrides.assignments))
        print_message(fmt::format("note: --set {}\n", idle));
      for (const auto& idle : experiment::idle_parts(run.problem()))
        print_message(fmt::format("note: {}\n", idle));
      return execute(std::move(run), options->out, options->jobs, std::move(server));
    };
  });
}

void add_resume(CLI::App& app, Action& action) {
  struct Options {
    std::filesystem::path folder;
    std::optional<int> generations;
    int jobs = 1;
    WatchOptions watch;
  };
  auto* command = app.add_subcommand("resume", "Go on with a run that was stopped, or make it longer");
  auto options = std::make_shared<Options>();
  command->add_option("DIR", options->folder, "Run folder")->required();
  command->add_option("--generations", options->generations, "Generations to evaluate in all")
      ->check(between(1, experiment::most_generations));
  add_jobs(*command, options->jobs);
  add_watch(*command, options->watch, "run");
  add_examples(*command, {{"amble resume runs/1", "on after Ctrl-C, kill -9, a power cut"},
                          {"amble resume runs/1 --generations 800", "longer"}});
  command->callback([options, &action] {
    action = [options] {
      stop_signal();
      auto server = server_for(options->watch);
      return execute(experiment::Run::resume(options->folder, options->generations, options->jobs),
                     options->folder, options->jobs, std::move(server));
    };
  });
}

}  // namespace amble::cli
