#include "amble/presentation/adaptation_page.hpp"

#include <fmt/format.h>

#include <map>
#include <memory>
#include <utility>
#include <vector>

#include "amble/io/file.hpp"
#include "amble/page/replay_page.hpp"
#include "amble/presentation/map_page.hpp"

namespace amble::presentation {

std::optional<std::string> adaptation_page(const experiment::Adaptation& adaptation,
                                           const experiment::Repertoire& repertoire,
                                           const experiment::AdaptSettings& settings,
                                           const std::string& damage, const std::filesystem::path& run,
                                           const std::atomic<bool>& stop) {
  const auto text = [&](double value) {
    return score::with_unit(fmt::format("{:.2f}", value), repertoire.config.score);
  };
  auto page = blank_map_page(
      repertoire, fmt::format("{}, {}, in {}", repertoire.config.name, damage, settings.engine),
      "The outlined cells were tried. Choose one and its elite walks on the damaged robot, in a trial "
      "without noise; with the Shift key, beside the one that walks there already.");
  page.map->table_title = "Trial and error";
  page.map->table_note = fmt::format(
      "Means of {} trials: the map’s best {} on the intact robot and {} on the damaged one; the gait found, "
      "in cell {}, {}.",
      settings.test_trials, text(adaptation.intact), text(adaptation.damaged), adaptation.cell,
      text(adaptation.adapted));
  page.map->table.push_back({"cell", "trial", "the map says", "predicted", "measured"});
  std::map<std::uint32_t, std::string> titles;
  for (std::size_t i = 0; i < adaptation.steps.size(); ++i) {
    const auto& step = adaptation.steps[i];
    page.map->table.push_back({fmt::format("{}", step.cell), fmt::format("{}", i + 1), text(step.expected),
                               fmt::format("{:.2f} ± {:.2f}", step.predicted, step.deviation),
                               text(step.measured)});
    titles.try_emplace(step.cell,
                       fmt::format("cell {}, trial {} ({} measured)", step.cell, i + 1, text(step.measured)));
  }
  const auto problem = experiment::damaged_problem(repertoire, settings);
  std::vector<std::uint32_t> cells{adaptation.cell};
  for (const auto& [cell, title] : titles)
    if (cell != adaptation.cell) cells.push_back(cell);
  std::vector<std::unique_ptr<io::ScratchFile>> recordings;
  for (const std::uint32_t cell : cells) {
    recordings.push_back(std::make_unique<io::ScratchFile>("walk.rec"));
    auto walker = elite_walker(repertoire, problem, cell, titles.at(cell), run, *recordings.back(), stop);
    if (!walker) return std::nullopt;
    page.walkers.push_back(std::move(*walker));
  }
  return page::make_page(page);
}

}  // namespace amble::presentation
