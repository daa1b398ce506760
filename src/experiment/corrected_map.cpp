#include "amble/experiment/corrected_map.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <utility>

#include "amble/experiment/episodes.hpp"
#include "amble/experiment/evaluator.hpp"
#include "amble/neat/genome_io.hpp"
#include "amble/search/cells.hpp"

namespace amble::experiment {
namespace {

/// The best typical objective of each cell that has one.
std::map<std::uint32_t, double> best_of_cells(const std::vector<TypicalElite>& elites) {
  std::map<std::uint32_t, double> best;
  for (const TypicalElite& elite : elites) {
    if (elite.typical_cell == search::Elites::none) continue;
    const auto [entry, is_new] = best.try_emplace(elite.typical_cell, elite.objective);
    if (!is_new) entry->second = std::max(entry->second, elite.objective);
  }
  return best;
}

}  // namespace

double CorrectedMap::promised() const {
  double sum = 0.0;
  for (const TypicalElite& elite : elites) sum += elite.promised;
  return sum;
}

double CorrectedMap::kept() const {
  double sum = 0.0;
  for (const TypicalElite& elite : elites) sum += elite.objective;
  return sum;
}

std::uint32_t CorrectedMap::staying() const {
  return static_cast<std::uint32_t>(std::ranges::count_if(elites, &TypicalElite::stays));
}

std::uint32_t CorrectedMap::filled() const {
  return static_cast<std::uint32_t>(best_of_cells(elites).size());
}

double CorrectedMap::qd_score() const {
  double sum = 0.0;
  for (const auto& [cell, objective] : best_of_cells(elites)) sum += objective;
  return sum;
}

double CorrectedMap::staying_share() const {
  return elites.empty() ? 0.0 : staying() / static_cast<double>(elites.size());
}

std::optional<CorrectedMap> correct_map(const Repertoire& repertoire, int trials, int jobs,
                                        const std::atomic<bool>& stop) {
  const Config& config = repertoire.config;
  Problem problem = repertoire.problem;
  problem.noise.score = trial::EpisodeScore::mean;
  const search::Elites& elites = repertoire.elites;
  std::vector<neat::Genome> genomes;
  genomes.reserve(elites.size());
  for (std::uint32_t i = 0; i < elites.size(); ++i)
    genomes.push_back(neat::expand(elites[i].genome, "archive.bin"));

  const auto ground = problem.make_ground(ground_of(episode_key(EpisodeSet::unseen, config.seed)));
  const auto scenarios = unseen_scenarios(problem, config.seed, 0, trials, ground.get(), stop);
  if (!scenarios) return std::nullopt;
  const auto behaviour = config.make_behaviour(&problem.robot);
  Evaluator evaluator(problem, behaviour->path(), jobs, behaviour->measures());
  const auto result = evaluator.evaluate(genomes, stop, *scenarios, ground);
  if (!result) return std::nullopt;

  const auto objectives = experiment::objectives(problem, *result);
  const auto cells = search::make_cells(config.search.map_elites);
  // Where nothing differs between trials, one is all of them.
  CorrectedMap corrected{.cells = elites.cells(), .trials = problem.trials_vary() ? trials : 1, .elites = {}};
  for (std::uint32_t i = 0; i < elites.size(); ++i) {
    TypicalElite elite{.cell = elites[i].cell,
                       .promised = elites[i].objective,
                       .objective = objectives[i],
                       .descriptor = {}};
    const auto episodes = result->of_genome(i);
    if (std::ranges::count(episodes, record::Outcome::diverged, &record::Trajectory::outcome) == 0) {
      elite.descriptor = behaviour->of(episodes);
      elite.typical_cell = cells->of(elite.descriptor);
    }
    corrected.elites.push_back(std::move(elite));
  }
  return corrected;
}

std::string repertoire_csv(const Repertoire& repertoire, const std::optional<CorrectedMap>& corrected) {
  const search::Elites& elites = repertoire.elites;
  const auto& dimensions = repertoire.config.search.map_elites.descriptors;
  std::string text = "cell,objective,evaluations";
  for (const auto& dimension : dimensions) text += "," + dimension.label();
  if (corrected) {
    text += ",trials,typical objective";
    for (const auto& dimension : dimensions) text += ",typical " + dimension.label();
    text += ",stays";
  }
  text += "\n";
  for (std::uint32_t cell = 0; cell < elites.cells(); ++cell) {
    const std::uint32_t number = elites.in(cell);
    if (number == search::Elites::none) continue;
    text += fmt::format("{},{},{}", cell, elites[number].objective, elites[number].evaluations);
    for (const float value : elites.descriptor(number)) text += fmt::format(",{}", value);
    if (corrected) {
      const TypicalElite& typical = corrected->elites[number];
      text += fmt::format(",{},{}", corrected->trials, typical.objective);
      for (std::size_t i = 0; i < dimensions.size(); ++i)
        text += typical.descriptor.empty() ? "," : fmt::format(",{}", typical.descriptor[i]);
      text += typical.stays() ? ",1" : ",0";
    }
    text += "\n";
  }
  return text;
}

}  // namespace amble::experiment
