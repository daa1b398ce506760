#include "amble/experiment/repertoire.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <utility>
#include <vector>

#include "amble/core/error.hpp"
#include "amble/experiment/champion_choice.hpp"
#include "amble/io/file.hpp"
#include "amble/io/json_file.hpp"
#include "amble/io/settings.hpp"
#include "amble/neat/genome_io.hpp"
#include "amble/neat/genome_json.hpp"
#include "amble/search/elite_log.hpp"

namespace amble::experiment {
namespace {

constexpr int repertoire_version = 1;

io::Json dimensions_json(const search::MapElitesSettings& settings) {
  io::Json dimensions = io::Json::array();
  for (const auto& descriptor : settings.descriptors) {
    io::Json dimension{{"quantity", descriptor.quantity}};
    if (!descriptor.leg.empty()) dimension["leg"] = descriptor.leg;
    dimension["least"] = descriptor.least;
    dimension["most"] = descriptor.most;
    if (settings.archive == search::Archive::grid) dimension["bins"] = descriptor.bins;
    dimensions.push_back(std::move(dimension));
  }
  return dimensions;
}

io::Json elite_json(const search::Elites& elites, std::uint32_t number) {
  const search::Elite& elite = elites[number];
  io::Json descriptor = io::Json::array();
  for (const float value : elites.descriptor(number)) descriptor.push_back(value);
  return {{"cell", elite.cell},
          {"objective", elite.objective},
          {"evaluations", elite.evaluations},
          {"descriptor", std::move(descriptor)},
          {"generation", elite.round},
          {"index", elite.candidate},
          {"genome", neat::to_json(neat::expand(elite.genome, "archive.bin"))}};
}

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

bool fills_map(const Config& config) {
  return config.search.kind == "map-elites";
}

Repertoire load_repertoire(const RunPaths& paths) {
  Config config = load_config(paths.config, {});
  if (!fills_map(config))
    fail(ExitCode::bad_input, "{}: a run with search.kind = \"{}\": expected one with \"map-elites\"",
         paths.folder.string(), config.search.kind);
  Problem problem = Problem::make(config, load_robot_file(paths.robot));
  const auto path = paths.folder / "archive.bin";
  io::InputFile file(path);
  const auto& settings = config.search.map_elites;
  auto elites = search::read_elites(file, path.string(), settings.cell_count(), settings.descriptors.size());
  std::error_code none;
  record::Generations generations;
  if (std::filesystem::exists(paths.generations, none))
    generations = record::read_generations(paths.generations);
  return {std::move(config), std::move(problem), std::move(elites), std::move(generations)};
}

std::string repertoire_json(const Repertoire& repertoire) {
  const search::Elites& elites = repertoire.elites;
  io::Json list = io::Json::array();
  for (std::uint32_t cell = 0; cell < elites.cells(); ++cell)
    if (const auto number = elites.in(cell); number != search::Elites::none)
      list.push_back(elite_json(elites, number));
  const auto& settings = repertoire.config.search.map_elites;
  return io::sealed_json("amble-repertoire", repertoire_version,
                         {{"experiment", repertoire.config.name},
                          {"seed", repertoire.config.seed},
                          {"robot", repertoire.problem.robot.name},
                          {"controller", repertoire.problem.architecture->name()},
                          {"engine", repertoire.problem.engine},
                          {"archive", search::archive_names[static_cast<std::size_t>(settings.archive)]},
                          {"dimensions", dimensions_json(settings)},
                          {"cells", elites.cells()},
                          {"coverage", elites.size() / static_cast<double>(elites.cells())},
                          {"qd_score", elites.objective_sum()},
                          {"elites", std::move(list)}});
}

std::optional<Champion> elite_champion(const Repertoire& repertoire, std::uint32_t cell, int jobs,
                                       const std::atomic<bool>& stop) {
  const search::Elites& elites = repertoire.elites;
  if (cell >= elites.cells())
    fail(ExitCode::bad_input, "--cell {}: the map has the cells 0 … {}", cell, elites.cells() - 1);
  const std::uint32_t number = elites.in(cell);
  if (number == search::Elites::none)
    fail(ExitCode::bad_input,
         "--cell {}: no elite is in this cell; `amble repertoire` lists some that are there", cell);
  const search::Elite& elite = elites[number];
  const neat::Genome genome = neat::expand(elite.genome, "archive.bin");
  StageTimes times;
  return try_champion(repertoire.config, repertoire.problem,
                      {.generation = static_cast<int>(elite.round),
                       .index = static_cast<int>(elite.candidate),
                       .genome = genome,
                       .objective = std::nullopt},
                      jobs, times, stop);
}

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
