#include "amble/presentation/map_page.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <array>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "amble/core/error.hpp"
#include "amble/experiment/corrected_map.hpp"
#include "amble/figures/fitness_figure.hpp"
#include "amble/io/file.hpp"
#include "amble/neat/genome_io.hpp"
#include "amble/page/replay_page.hpp"
#include "amble/presentation/walker.hpp"
#include "amble/record/generations_csv.hpp"

namespace amble::presentation {
namespace {

namespace fs = std::filesystem;

/// Which of two elites is shown first: by what they do in new trials, if there were any, one that stays in
/// its cell before one that leaves it; then by the objective.
bool comes_first(const search::Elites& elites, const std::optional<experiment::CorrectedMap>& corrected,
                 std::uint32_t one, std::uint32_t other) {
  if (!corrected) return elites[one].objective > elites[other].objective;
  const auto &here = corrected->elites[one], &there = corrected->elites[other];
  return here.stays() != there.stays() ? here.stays() : here.objective > there.objective;
}

/// The numbers of the elites that the page can show: the first (comes_first), then in the order of their
/// cells.
std::vector<std::uint32_t> chosen_elites(const search::Elites& elites,
                                         const std::optional<experiment::CorrectedMap>& corrected,
                                         std::size_t most) {
  std::vector<std::uint32_t> filled;
  std::uint32_t best = search::Elites::none;
  for (std::uint32_t cell = 0; cell < elites.cells(); ++cell) {
    const std::uint32_t number = elites.in(cell);
    if (number == search::Elites::none) continue;
    filled.push_back(number);
    if (best == search::Elites::none || comes_first(elites, corrected, number, best)) best = number;
  }
  if (filled.empty()) fail(ExitCode::bad_input, "the map has no elite yet");
  std::vector<std::uint32_t> chosen{best};
  const std::size_t count = std::min(most, filled.size());
  chosen.reserve(count);
  // Evenly: as if the filled cells were a line cut into `count` pieces, and the middle of each taken.
  for (std::size_t i = 0; i < count && chosen.size() < count; ++i) {
    const std::uint32_t number = filled[(2 * i + 1) * filled.size() / (2 * count)];
    if (number != best) chosen.push_back(number);
  }
  return chosen;
}

std::string title_of(const experiment::Repertoire& repertoire,
                     const std::optional<experiment::CorrectedMap>& corrected, std::uint32_t number) {
  const search::Elite& elite = repertoire.elites[number];
  const auto text = [&](double value) {
    return score::with_unit(fmt::format("{:.2f}", value), repertoire.config.score);
  };
  if (!corrected) return fmt::format("cell {} ({} in the map)", elite.cell, text(elite.objective));
  return fmt::format("cell {} ({} in the map, {} in new trials)", elite.cell, text(elite.objective),
                     text(corrected->elites[number].objective));
}

std::string kept_text(const experiment::CorrectedMap& corrected) {
  return fmt::format(
      " In {} new trials of each elite {:.0f} % stay in their cell; those that leave it have small squares. "
      "The map "
      "has {} elites and a QD score of {:.2f}; the one that the new trials fill {} and {:.2f}.",
      corrected.trials, 100.0 * corrected.staying_share(), corrected.elites.size(), corrected.promised(),
      corrected.filled(), corrected.qd_score());
}

/// How the map filled; empty before the first round.
std::string curves_of(const experiment::Repertoire& repertoire) {
  if (repertoire.generations.count() == 0) return {};
  record::Objective objective = score::objective_of(repertoire.config.score);
  objective.title = "Objective";
  return figures::fitness_figure(repertoire.generations, figures::FigureSize::wide, objective);
}

constexpr int usual_trials = 20;

/// A kind of file with a whole map.
struct MapFile {
  std::string_view extension, beginning, what;
  bool has_new_trials;  ///< what each elite does in some, unless --retest 0
};
constexpr std::array map_files{
    MapFile{".html", "<!DOCTYPE html>", "a page", true}, MapFile{".svg", "<svg", "a picture", true},
    MapFile{".csv", "cell,", "a table", true},
    MapFile{".json", "{\n  \"format\": \"amble-repertoire\"", "a repertoire", false}};

/// Nothing if `stop` was set.
std::optional<std::string> text_of(const experiment::Repertoire& repertoire, const std::filesystem::path& run,
                                   const MapFile& file, const MapFileOptions& options,
                                   const std::atomic<bool>& stop) {
  if (!file.has_new_trials) return experiment::repertoire_json(repertoire);
  if (file.extension != ".csv") map_picture(repertoire);  // refuses before the trials
  const int trials = options.trials.value_or(repertoire.problem.trials_vary() ? usual_trials : 0);
  std::optional<experiment::CorrectedMap> corrected;
  if (trials > 0 && !(corrected = experiment::correct_map(repertoire, trials, options.jobs, stop)))
    return std::nullopt;
  if (file.extension == ".html") return map_page(repertoire, corrected, run, options.walkers, stop);
  return file.extension == ".csv" ? experiment::repertoire_csv(repertoire, corrected)
                                  : figures::map_svg(map_picture(repertoire, corrected));
}

}  // namespace

figures::GridMap map_picture(const experiment::Repertoire& repertoire,
                             const std::optional<experiment::CorrectedMap>& corrected) {
  const auto& settings = repertoire.config.search.map_elites;
  if (settings.archive != search::Archive::grid)
    fail(ExitCode::bad_input, "--out: a map of centroids has no picture: expected FILE.json");
  figures::GridMap map;
  for (const auto& descriptor : settings.descriptors)
    map.dimensions.push_back({descriptor.label(), descriptor.least, descriptor.most, descriptor.bins});
  const search::Elites& elites = repertoire.elites;
  for (std::uint32_t cell = 0; cell < elites.cells(); ++cell) {
    const auto number = elites.in(cell);
    map.objective.push_back(number == search::Elites::none ? std::numeric_limits<double>::quiet_NaN()
                                                           : elites[number].objective);
  }
  map.unit = score::objective_of(repertoire.config.score).unit;
  if (!corrected) return map;
  map.trials = corrected->trials;
  map.typical.resize(map.objective.size());
  for (const auto& elite : corrected->elites) map.typical[elite.cell] = {elite.objective, elite.stays()};
  return map;
}

page::ReplayPage blank_map_page(const experiment::Repertoire& repertoire, const std::string& title,
                                const std::string& note,
                                const std::optional<experiment::CorrectedMap>& corrected) {
  page::ReplayPage page;
  page.title = title;
  page.made_by = made_by();
  page.map = page::MapPanel{
      .map_svg = figures::map_figure(map_picture(repertoire, corrected)), .curves_svg = {}, .note = note};
  return page;
}

std::optional<page::Walker> elite_walker(const experiment::Repertoire& repertoire,
                                         const experiment::Problem& problem, std::uint32_t cell,
                                         const std::string& title, const fs::path& run,
                                         const io::ScratchFile& recording, const std::atomic<bool>& stop) {
  const search::Elite& elite = repertoire.elites[repertoire.elites.in(cell)];
  auto walker =
      walk(problem, neat::expand(elite.genome, "archive.bin"), run.string(), {}, recording.path(), stop);
  if (!walker) return std::nullopt;
  walker->title = title;
  walker->cell = cell;
  return walker;
}

std::optional<std::string> map_page(const experiment::Repertoire& repertoire,
                                    const std::optional<experiment::CorrectedMap>& corrected,
                                    const fs::path& run, std::size_t walkers, const std::atomic<bool>& stop) {
  const search::Elites& elites = repertoire.elites;
  const auto chosen = chosen_elites(elites, corrected, walkers);
  const std::string who = chosen.size() == elites.size()
                              ? std::string("Choose a framed cell, and its elite walks")
                              : fmt::format("Choose one of the {} outlined cells of {}, and its elite walks",
                                            chosen.size(), elites.size());
  auto page = blank_map_page(repertoire, fmt::format("Map of {}", repertoire.config.name),
                             who + "; with the Shift key, beside the one that walks there already." +
                                 (corrected ? kept_text(*corrected) : ""),
                             corrected);
  page.map->curves_svg = curves_of(repertoire);
  std::vector<std::unique_ptr<io::ScratchFile>> recordings;
  for (const std::uint32_t number : chosen) {
    recordings.push_back(std::make_unique<io::ScratchFile>("walk.rec"));
    auto walker = elite_walker(repertoire, repertoire.problem, elites[number].cell,
                               title_of(repertoire, corrected, number), run, *recordings.back(), stop);
    if (!walker) return std::nullopt;
    page.walkers.push_back(std::move(*walker));
  }
  return page::make_page(page);
}

bool write_map_file(const experiment::Repertoire& repertoire, const std::filesystem::path& run,
                    const std::filesystem::path& out, const MapFileOptions& options,
                    const std::atomic<bool>& stop) {
  const auto file = std::ranges::find(map_files, out.extension().string(), &MapFile::extension);
  if (file == map_files.end())
    fail(ExitCode::bad_input, "--out {}: expected FILE.html, FILE.json, FILE.csv or FILE.svg", out.string());
  io::check_output(out, std::string(file->beginning), std::string(file->what));
  const auto text = text_of(repertoire, run, *file, options, stop);
  if (text) io::write_output(out, *text);
  return text.has_value();
}

}  // namespace amble::presentation
