#include "amble/cli/compare_maps.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "amble/experiment/repertoire.hpp"
#include "amble/io/settings.hpp"

namespace amble::cli {
namespace {

using search::Elites;

/// What the cells of a map are: equal for maps that can be compared cell by cell.
io::Json meaning_of(const experiment::Repertoire& repertoire) {
  const auto& settings = repertoire.config.search.map_elites;
  return {settings.archive, repertoire.elites.cells(), settings.centroid_seed, settings.centroid_samples,
          [&] {
            io::Json all = io::Json::array();
            for (const auto& descriptor : settings.descriptors)
              all.push_back(io::settings_to_json(descriptor));
            return all;
          }()};
}

ComparedMap::Difference difference(const Elites& map, const Elites& first) {
  ComparedMap::Difference found;
  for (std::uint32_t cell = 0; cell < map.cells(); ++cell) {
    const auto here = map.in(cell), there = first.in(cell);
    if (here != Elites::none && there != Elites::none) {
      ++found.common;
      found.better += map[here].objective > first[there].objective;
      found.worse += map[here].objective < first[there].objective;
    }
    found.only_here += here != Elites::none && there == Elites::none;
    found.only_there += here == Elites::none && there != Elites::none;
  }
  return found;
}

bool has_map(const std::filesystem::path& input) {
  return std::filesystem::is_directory(input) &&
         experiment::fills_map(experiment::load_config(experiment::find_run(input).config, {}));
}

}  // namespace

std::vector<ComparedMap> compare_maps(const std::vector<std::filesystem::path>& inputs) {
  std::vector<ComparedMap> maps;
  std::optional<experiment::Repertoire> first;
  for (const auto& input : inputs) {
    if (!has_map(input)) continue;
    auto repertoire = experiment::load_repertoire(experiment::find_run(input));
    const Elites& elites = repertoire.elites;
    ComparedMap map{.name = input.string(),
                    .cells = elites.cells(),
                    .filled = elites.size(),
                    .qd_score = elites.objective_sum(),
                    .best = elites.size() > 0 ? elites.best_objective() : 0.0,
                    .unit = score::with_unit("", repertoire.config.score),
                    .from_first = {}};
    if (first && meaning_of(*first) == meaning_of(repertoire))
      map.from_first = difference(elites, first->elites);
    maps.push_back(std::move(map));
    if (!first) first = std::move(repertoire);
  }
  return maps;
}

std::vector<std::vector<std::string>> maps_table(const std::vector<ComparedMap>& maps) {
  std::vector<std::vector<std::string>> lines{{"map", "cells filled", "QD score", "best",
                                               "in common with the first", "better", "worse", "only here",
                                               "only there"}};
  for (const ComparedMap& map : maps) {
    lines.push_back({map.name,
                     fmt::format("{} of {}, {:.1f} %", map.filled, map.cells, 100.0 * map.filled / map.cells),
                     fmt::format("{:.2f}", map.qd_score), fmt::format("{:.3f}{}", map.best, map.unit)});
    const auto& from = map.from_first;
    if (!from) {
      lines.back().emplace_back(&map == &maps.front() ? "" : "other cells");
      lines.back().resize(lines.front().size());
      continue;
    }
    for (const auto count : {from->common, from->better, from->worse, from->only_here, from->only_there})
      lines.back().push_back(fmt::format("{}", count));
  }
  return lines;
}

io::Json map_json(const ComparedMap& map) {
  io::Json json{{"cells", map.cells},
                {"filled", map.filled},
                {"coverage", map.filled / static_cast<double>(map.cells)},
                {"qd_score", map.qd_score},
                {"best", map.best}};
  if (const auto& from = map.from_first)
    json["from_first"] = {{"common", from->common},
                          {"better", from->better},
                          {"worse", from->worse},
                          {"only_here", from->only_here},
                          {"only_there", from->only_there}};
  return json;
}

}  // namespace amble::cli
