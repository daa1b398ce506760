#include "amble/experiment/repertoire.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "amble/cli/help.hpp"
#include "amble/cli/options.hpp"
#include "amble/cli/outputs.hpp"
#include "amble/cli/stop_signal.hpp"
#include "amble/core/index.hpp"
#include "amble/experiment/corrected_map.hpp"
#include "amble/experiment/switching_champion.hpp"
#include "amble/io/file.hpp"
#include "amble/io/quoting.hpp"
#include "amble/io/text.hpp"
#include "amble/presentation/map_page.hpp"

namespace amble::cli {
namespace {

namespace fs = std::filesystem;

struct RepertoireOptions {
  fs::path run;
  std::optional<fs::path> out;
  std::optional<std::uint32_t> cell;
  std::optional<int> retest;
  std::optional<int> gaits;
  double heading_gain = experiment::usual_heading_gain;
  std::optional<int> walkers;
  int jobs = 1;
};

constexpr std::size_t listed = 10;
constexpr int usual_walkers = 200;

/// Elites by falling objective, of equal ones by cell.
std::vector<std::uint32_t> ranking(const search::Elites& elites) {
  std::vector<std::uint32_t> numbers(elites.size());
  for (std::uint32_t i = 0; i < elites.size(); ++i) numbers[i] = i;
  std::ranges::sort(numbers, [&elites](std::uint32_t a, std::uint32_t b) {
    return std::pair(-elites[a].objective, elites[a].cell) < std::pair(-elites[b].objective, elites[b].cell);
  });
  return numbers;
}

void print_summary(const experiment::Repertoire& repertoire, const fs::path& run) {
  const search::Elites& elites = repertoire.elites;
  const auto& settings = repertoire.config.search.map_elites;
  const auto with_unit = [&](double value) {
    return score::with_unit(fmt::format("{:.3f}", value), repertoire.config.score);
  };
  fmt::print("experiment  {} (seed {})\n", io::printable(repertoire.config.name), repertoire.config.seed);
  fmt::print("map         {} of {} cells: {:.1f} %\n", elites.size(), elites.cells(),
             100.0 * elites.size() / elites.cells());
  fmt::print("dimensions ");
  for (const auto& descriptor : settings.descriptors)
    fmt::print(" {} ({:g} … {:g})", descriptor.label(), descriptor.least, descriptor.most);
  fmt::print("\nQD score    {:.2f}\n", elites.objective_sum());
  if (elites.size() == 0) return;
  double evaluations = 0.0;
  for (std::uint32_t i = 0; i < elites.size(); ++i) evaluations += elites[i].evaluations;
  fmt::print("evaluations {:.2f} per elite\n\n{:>8} {:>12} {:>5}  descriptor\n", evaluations / elites.size(),
             "cell", "objective", "of");
  const auto numbers = ranking(elites);
  for (std::size_t i = 0; i < std::min(listed, numbers.size()); ++i) {
    const search::Elite& elite = elites[numbers[i]];
    fmt::print("{:>8} {:>12} {:>5} ", elite.cell, with_unit(elite.objective), elite.evaluations);
    for (const float value : elites.descriptor(numbers[i])) fmt::print(" {:.2f}", value);
    fmt::print("\n");
  }
  fmt::print(
      "\nthe map as a page:      amble repertoire {0} -o map.html\n"
      "an elite as a champion: amble repertoire {0} --cell {1} -o elite.json\n",
      io::shell_word(run.string()), elites[numbers.front()].cell);
}

void print_corrected(const experiment::CorrectedMap& corrected) {
  const double promised = corrected.promised();
  fmt::print("{} elites, each in {} new trials\n", corrected.elites.size(), corrected.trials);
  fmt::print("objective   {:.1f} % of what the map says\n",
             promised > 0.0 ? 100.0 * corrected.kept() / promised : 0.0);
  fmt::print("in place    {:.1f} % of the elites\n", 100.0 * corrected.staying_share());
  fmt::print("corrected   {} cells, QD score {:.2f} (the map says {} and {:.2f})\n", corrected.filled(),
             corrected.qd_score(), corrected.elites.size(), promised);
}

ExitCode write_elite(const experiment::Repertoire& repertoire, std::uint32_t cell,
                     const std::optional<fs::path>& out) {
  if (!out || out->extension() != ".json")
    fail(ExitCode::bad_input, "--cell {}: expected -o FILE.json", cell);
  check_output(*out, "{\n  \"format\": \"amble-champion\"", "a champion");
  const auto champion = experiment::elite_champion(repertoire, cell, 1, stop_signal());
  if (!champion) return ExitCode::interrupted;
  io::write_output(*out, experiment::champion_text(*champion));
  fmt::print("to see it, run: amble view {} -o walker.html\n", io::shell_word(out->string()));
  return ExitCode::ok;
}

/// A walker that switches between elites as it is told.
ExitCode write_switching(const experiment::Repertoire& repertoire, const RepertoireOptions& options) {
  if (!options.out || options.out->extension() != ".json")
    fail(ExitCode::bad_input, "--switching {}: expected -o FILE.json", *options.gaits);
  check_output(*options.out, "{\n  \"format\": \"amble-champion\"", "a champion");
  experiment::check_can_switch(repertoire.config);
  const int trials = options.retest.value_or(experiment::usual_gait_trials);
  if (trials == 0)
    fail(
        ExitCode::bad_input,
        "--retest 0: gaits are picked by what elites do in new trials; expected at least 1 with --switching");
  const auto corrected = experiment::correct_map(repertoire, trials, options.jobs, stop_signal());
  if (!corrected) return ExitCode::interrupted;
  const auto gaits = experiment::pick_gaits(repertoire, *corrected, *options.gaits);
  const auto champion =
      experiment::switching_champion(repertoire, gaits, options.heading_gain, options.jobs, stop_signal());
  if (!champion) return ExitCode::interrupted;
  fmt::print("{:>4} {:>8} {:>12} {:>14}\n", "gait", "cell", "speed m/s", "turn rad/s");
  for (std::size_t i = 0; i < gaits.size(); ++i)
    fmt::print("{:>4} {:>8} {:>12.2f} {:>14.2f}\n", i + 1, repertoire.elites[gaits[i].number].cell,
               gaits[i].speed_m_s, gaits[i].turn_rad_s);
  io::write_output(*options.out, experiment::champion_text(*champion));
  fmt::print("to see it do as it is told, run: amble view {} -o walker.html\n",
             io::shell_word(options.out->string()));
  return ExitCode::ok;
}

ExitCode write_map(const experiment::Repertoire& repertoire, const RepertoireOptions& options) {
  prepare_output(*options.out);
  const presentation::MapFileOptions how{.trials = options.retest,
                                         .walkers = to_index(options.walkers.value_or(usual_walkers)),
                                         .jobs = options.jobs};
  if (!presentation::write_map_file(repertoire, options.run, *options.out, how, stop_signal()))
    return ExitCode::interrupted;
  if (options.out->extension() == ".html")
    fmt::print("{}\n", fs::absolute(*options.out).lexically_normal().string());
  return ExitCode::ok;
}

ExitCode run_repertoire(const RepertoireOptions& options) {
  const auto repertoire = experiment::load_repertoire(experiment::find_run(options.run));
  const bool retests = options.retest.value_or(0) > 0, takes_away = options.out && !options.gaits;
  if (retests && (options.cell || (takes_away && options.out->extension() == ".json")))
    fail(ExitCode::bad_input,
         "--retest {}: not with {}, which holds what the map says; expected it alone, or with -o FILE.html, "
         ".svg or .csv",
         *options.retest, options.cell ? "--cell" : "-o FILE.json");
  if (options.walkers && !(takes_away && options.out->extension() == ".html"))
    fail(ExitCode::bad_input, "--walkers {}: only with -o FILE.html", *options.walkers);
  if (retests && *options.retest > 1 && !repertoire.problem.trials_vary())
    print_message("note: its search was without noise, and so are these trials: one of each elite is all\n");
  if (options.gaits) return write_switching(repertoire, options);
  if (options.cell) return write_elite(repertoire, *options.cell, options.out);
  if (options.out) return write_map(repertoire, options);
  if (options.retest.value_or(0) == 0) {
    print_summary(repertoire, options.run);
    return ExitCode::ok;
  }
  const auto corrected = experiment::correct_map(repertoire, *options.retest, options.jobs, stop_signal());
  if (!corrected) return ExitCode::interrupted;
  print_corrected(*corrected);
  return ExitCode::ok;
}

}  // namespace

void add_repertoire(CLI::App& app, Action& action) {
  auto* command =
      app.add_subcommand("repertoire", "Show the map of a run under MAP-Elites, or take it or an elite away");
  auto options = std::make_shared<RepertoireOptions>();
  command->add_option("RUN", options->run, "Run folder")->required();
  command->add_option(
      "-o,--out", options->out,
      "FILE.html: a page in which cells are chosen and walk; FILE.svg: a picture of the map; FILE.csv: its "
      "elites as a table; FILE.json: the whole map, or with --cell one elite");
  command->add_option("--cell", options->cell, "The elite of this cell, as a champion file")
      ->check(between<std::int64_t>(0, 4294967295));
  command
      ->add_option(
          "--retest", options->retest,
          "Try each elite in so many new trials under noise: what the map keeps of what it says; with "
          "-o FILE.html, .svg or .csv what each elite keeps (20 if the map was made under noise; 0: not)")
      ->check(between(0, 1000));
  auto* const switching = command->add_option(
      "--switching", options->gaits,
      "A champion that does as it is told: at each trigger a leg takes over the elite that is nearest to the "
      "commanded speed and turn, of so many that cover what all do in new trials (docs/STEERING.md)");
  switching->check(between(1, 1000))->excludes("--cell");
  command
      ->add_option("--heading-gain", options->heading_gain,
                   "With --switching: rate of turning added for each radian of heading error, 1/s")
      ->check(between(0.0, 100.0))
      ->needs(switching)
      ->capture_default_str();
  command
      ->add_option("--walkers", options->walkers,
                   fmt::format("Cells at most that can be chosen in FILE.html (default: {})", usual_walkers))
      ->check(between(1, 10000));
  add_jobs(*command, options->jobs,
           "Processors for --retest and --switching; the results do not depend on it");
  add_examples(*command, {{"amble repertoire runs/map", "coverage, QD score, the best ten"},
                          {"amble repertoire runs/map -o map.html", ""},
                          {"amble repertoire runs/map --switching 16 -o walker.json",
                           "a walker that obeys, of a map of speeds and turns"}});
  command->callback([options, &action] { action = [options] { return run_repertoire(*options); }; });
}

}  // namespace amble::cli
