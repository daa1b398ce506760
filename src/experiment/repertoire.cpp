#include "amble/experiment/repertoire.hpp"

#include <utility>
#include <vector>

#include "amble/core/error.hpp"
#include "amble/experiment/champion_trials.hpp"
#include "amble/io/file.hpp"
#include "amble/io/json_file.hpp"
#include "amble/neat/genome_compact.hpp"
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
  return {std::move(config), std::move(problem), std::move(elites)};
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

}  // namespace amble::experiment
