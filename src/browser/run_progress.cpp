// What pages are told of a generation.
#include <algorithm>
#include <cmath>

#include "amble/browser/run.hpp"
#include "amble/io/json_file.hpp"
#include "amble/score/score.hpp"
#include "amble/search/generational.hpp"
#include "amble/search/map_elites.hpp"
#include "amble/search/novelty.hpp"

namespace amble::browser {
namespace {

/// In cm, as short as that.
double rounded(double value_m) {
  return std::round(100.0 * value_m) / 100.0;
}

/// [cell, objective] of each elite; null for a search without a map.
io::Json map_json(const search::Strategy& strategy) {
  const auto* map = dynamic_cast<const search::MapElites*>(&strategy);
  if (map == nullptr) return nullptr;
  io::Json cells = io::Json::array();
  for (std::uint32_t i = 0; i < map->elites().size(); ++i)
    cells.push_back({map->elites()[i].cell, rounded(map->elites()[i].objective)});
  return cells;
}

/// [x, y, x, y, …], m: where the latest members of an archive of paths ended; null for a search without one.
io::Json archive_json(const search::Strategy& strategy) {
  constexpr std::size_t most_shown = 2000;
  const auto* generational = dynamic_cast<const search::GenerationalSearch*>(&strategy);
  if (generational == nullptr) return nullptr;
  const auto* novelty = dynamic_cast<const search::NoveltySearch*>(&generational->criterion());
  if (novelty == nullptr) return nullptr;
  const search::Behaviours& archive = novelty->archive();
  io::Json ends = io::Json::array();
  for (std::size_t r = archive.rows() - std::min(archive.rows(), most_shown); r < archive.rows(); ++r)
    for (const float coordinate_m : archive.row(r).last(2))
      ends.push_back(rounded(static_cast<double>(coordinate_m)));
  return ends;
}

}  // namespace

std::string Run::describe() const {
  const auto& architecture = *plan_->problem.architecture;
  return io::Json{{"inputs", architecture.cppn_inputs()},
                  {"outputs", architecture.cppn_outputs()},
                  {"genomes", plan_->config.neat.population.size},
                  {"episodes", plan_->problem.trials_vary() ? plan_->problem.noise.episodes : 1},
                  {"generation", generation()},
                  {"generations", plan_->config.generations}}
      .dump();
}

std::string Run::progress_json() const {
  io::Json species = io::Json::array(), metrics = io::Json::object(), ends = io::Json::array();
  for (const auto& [id, size] : species_) species.push_back({id, size});
  for (const auto& [name, value] : row_.search) metrics[std::string(name)] = io::json_number(value);
  for (const Told& told : shown_) {
    ends.push_back(rounded(told.end_x_m));
    ends.push_back(rounded(told.end_y_m));
  }
  return io::Json{
      {"generation", row_.generation},
      {"best", row_.best},
      {"median", row_.median},
      {"mean", row_.mean},
      {"best_so_far", row_.best_so_far},
      {"unit", score::objective_of(plan_->config.score).unit},
      {"best_generation", state_.progress.best_generation},
      {"typical", row_.typical.median},
      {"typical_fell", row_.typical.fell_share},
      {"fell", row_.fell},
      {"diverged", row_.diverged},
      {"hidden", row_.best_hidden},
      {"links", row_.best_links},
      {"trials", row_.evaluations * static_cast<std::uint64_t>(
                                        plan_->problem.trials_vary() ? plan_->problem.noise.episodes : 1)},
      {"steps", state_.progress.steps},
      {"evaluations", state_.progress.evaluations},
      {"species", std::move(species)},
      {"metrics", std::move(metrics)},
      {"ends", std::move(ends)},
      {"archive", archive_json(*state_.strategy)},
      {"map", map_json(*state_.strategy)}}
      .dump();
}

}  // namespace amble::browser
