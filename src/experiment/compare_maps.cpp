#include "amble/experiment/compare_maps.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "amble/experiment/repertoire.hpp"
#include "amble/io/settings.hpp"

namespace amble::experiment {
namespace {

using search::Elites;

/// What the cells of a map are: equal for maps that can be compared cell by cell.
io::Json meaning_of(const Repertoire& repertoire) {
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
  return std::filesystem::is_directory(input) && fills_map(load_config(find_run(input).config, {}));
}

}  // namespace

std::vector<ComparedMap> compare_maps(const std::vector<std::filesystem::path>& inputs) {
  std::vector<ComparedMap> maps;
  std::optional<Repertoire> first;
  for (const auto& input : inputs) {
    if (!has_map(input)) continue;
    auto repertoire = load_repertoire(find_run(input));
    const Elites& elites = repertoire.elites;
    ComparedMap map{.name = input.string(),
                    .cells = elites.cells(),
                    .filled = elites.size(),
                    .qd_score = elites.objective_sum(),
                    .best = elites.size() > 0 ? elites.best_objective() : 0.0,
                    .unit = score::objective_of(repertoire.config.score).unit,
                    .from_first = {}};
    if (first && meaning_of(*first) == meaning_of(repertoire))
      map.from_first = difference(elites, first->elites);
    maps.push_back(std::move(map));
    if (!first) first = std::move(repertoire);
  }
  return maps;
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

}  // namespace amble::experiment
