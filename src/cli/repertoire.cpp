#include "amble/experiment/repertoire.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "amble/cli/commands.hpp"
#include "amble/cli/repertoire_page.hpp"
#include "amble/cli/stop_signal.hpp"
#include "amble/core/index.hpp"
#include "amble/io/file.hpp"
#include "amble/io/printable.hpp"

namespace amble::cli {
namespace {

namespace fs = std::filesystem;

struct RepertoireOptions {
  fs::path run;
  std::optional<fs::path> out;
  std::optional<std::uint32_t> cell;
  std::optional<int> retest;
  int walkers = 200;
  int jobs = 1;
};

constexpr std::size_t listed = 10;

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
      run.string(), elites[numbers.front()].cell);
}

ExitCode run_retest(const experiment::Repertoire& repertoire, const RepertoireOptions& options) {
  const auto result = experiment::retest(repertoire, *options.retest, options.jobs, stop_signal());
  if (!result) return ExitCode::interrupted;
  const auto share = [&](double part, double whole) { return whole > 0.0 ? 100.0 * part / whole : 0.0; };
  fmt::print("{} elites, each in {} new trials\n", result->elites, *options.retest);
  fmt::print("objective   {:.1f} % of what the map says\n", share(result->kept, result->promised));
  fmt::print("in place    {:.1f} % of the elites\n", share(result->in_place, result->elites));
  fmt::print("corrected   {} cells, QD score {:.2f} (the map says {} and {:.2f})\n", result->corrected_elites,
             result->corrected_score, result->elites, result->promised);
  return ExitCode::ok;
}

ExitCode run_repertoire(const RepertoireOptions& options) {
  const auto repertoire = experiment::load_repertoire(experiment::find_run(options.run));
  const std::string extension = options.out ? options.out->extension().string() : "";
  if (options.cell) {
    if (extension != ".json") fail(ExitCode::bad_input, "--cell {}: expected -o FILE.json", *options.cell);
    io::refuse_to_replace(*options.out, "{\n  \"format\": \"amble-champion\"", "a champion");
    const auto champion = experiment::elite_champion(repertoire, *options.cell, 1, stop_signal());
    if (!champion) return ExitCode::interrupted;
    io::write_file(*options.out, experiment::champion_text(*champion));
    fmt::print("look at it by: amble view {}\n", options.out->string());
  } else if (options.retest) {
    return run_retest(repertoire, options);
  } else if (!options.out) {
    print_summary(repertoire, options.run);
  } else if (extension == ".json") {
    io::refuse_to_replace(*options.out, "{\n  \"format\": \"amble-repertoire\"", "a repertoire");
    io::write_file(*options.out, experiment::repertoire_json(repertoire));
  } else if (extension == ".svg") {
    io::refuse_to_replace(*options.out, "<svg", "a picture");
    io::write_file(*options.out, figures::map_svg(map_picture(repertoire)));
  } else if (extension == ".html") {
    return write_map_page(repertoire, options.run, options.walkers, *options.out);
  } else {
    fail(ExitCode::bad_input, "--out {}: expected FILE.html, FILE.json or FILE.svg", options.out->string());
  }
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
      "FILE.html: a page in which cells are chosen and walk; FILE.svg: a picture of the map; FILE.json: "
      "the whole map, or with --cell one elite");
  command->add_option("--cell", options->cell, "The elite of this cell, as a champion file");
  command
      ->add_option("--retest", options->retest,
                   "Try each elite in so many new trials under noise: what the map keeps of what it says")
      ->check(CLI::Range(1, 1000));
  command->add_option("--walkers", options->walkers, "Cells at most that can be chosen in FILE.html")
      ->check(CLI::Range(1, 10000))
      ->capture_default_str();
  command->add_option("--jobs", options->jobs, "Workers for --retest")
      ->check(CLI::Range(1, 1024))
      ->capture_default_str();
  command->callback([options, &action] { action = [options] { return run_repertoire(*options); }; });
}

}  // namespace amble::cli
