#include "amble/watch/population.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <exception>
#include <utility>

#include "amble/core/clock.hpp"
#include "amble/experiment/checkpoint.hpp"
#include "amble/experiment/config.hpp"
#include "amble/experiment/plan/checkpoint.hpp"
#include "amble/experiment/problem.hpp"
#include "amble/experiment/repertoire.hpp"
#include "amble/io/file.hpp"
#include "amble/search/elite_log.hpp"
#include "amble/search/generational.hpp"

namespace amble::watch {
namespace {

constexpr double least_interval_s = 2.0, most_share = 0.002;
/// The largest archive that is still read.
constexpr std::int64_t most_archive_bytes = std::int64_t{256} << 20;
/// Elites that pages are told one by one.
constexpr std::uint32_t most_drawn = 20'000;

io::Json axes_json(const search::MapElitesSettings& settings) {
  io::Json axes = io::Json::array();
  if (settings.archive != search::Archive::grid) return axes;
  for (const auto& descriptor : settings.descriptors)
    axes.push_back(
        {{"name", descriptor.leg.empty() ? descriptor.quantity : descriptor.quantity + " " + descriptor.leg},
         {"least", descriptor.least},
         {"most", descriptor.most},
         {"bins", descriptor.bins}});
  return axes;
}

}  // namespace

struct PopulationReader::Run {
  experiment::Config config;
  experiment::Problem problem;
};

PopulationReader::PopulationReader(const experiment::RunPaths& paths) : paths_(paths) {}
PopulationReader::~PopulationReader() = default;

io::Json PopulationReader::poll(double now_s) {
  if (now_s < due_s_) return nullptr;
  double cost_s = 0.0;
  io::Json found;
  try {
    const Stopwatch watch(cost_s);
    found = read();
  } catch (const std::exception&) {
    // Replaced meanwhile, or of a run that began anew.
    run_.reset();
  }
  due_s_ = now_s + std::max(least_interval_s, cost_s / most_share);
  return found;
}

io::Json PopulationReader::read() {
  const FileMark config = FileMark::of(paths_.config);
  if (!config.exists()) return nullptr;
  if (config != config_ || !run_) {
    run_.reset();
    auto settings = experiment::load_config(paths_.config, {});
    auto problem = experiment::Problem::make(settings, experiment::load_robot_file(paths_.robot));
    run_ = std::make_unique<Run>(Run{std::move(settings), std::move(problem)});
    config_ = config;
    read_ = {};
  }
  const bool has_map = experiment::fills_map(run_->config);
  const FileMark now = FileMark::of(has_map ? paths_.folder / "archive.bin" : paths_.checkpoint);
  if (!now.exists() || now == read_) return nullptr;
  read_ = now;
  return has_map ? map() : species();
}

io::Json PopulationReader::species() {
  experiment::RunState state(run_->config, run_->problem);
  if (dynamic_cast<const search::GenerationalSearch*>(state.strategy.get()) == nullptr) return nullptr;
  experiment::load_checkpoint(paths_.checkpoint, run_->config, *state.strategy);
  const auto& neat = dynamic_cast<const search::GenerationalSearch&>(*state.strategy);
  io::Json sizes = io::Json::array();
  for (const auto& species : neat.population().species()) sizes.push_back({species.id, species.size});
  return {{"generation", neat.round()}, {"species", std::move(sizes)}};
}

io::Json PopulationReader::map() {
  if (read_.bytes > most_archive_bytes) return nullptr;
  const auto& settings = run_->config.search.map_elites;
  const auto path = paths_.folder / "archive.bin";
  io::InputFile file(path);
  const auto elites =
      search::read_elites(file, path.string(), settings.cell_count(), settings.descriptors.size());
  const bool is_drawn = elites.size() <= most_drawn;
  io::Json axes = is_drawn ? axes_json(settings) : io::Json::array(), filled = io::Json::array();
  if (!axes.empty())
    for (std::uint32_t i = 0; i < elites.size(); ++i)
      filled.push_back({elites[i].cell, std::round(1000.0 * elites[i].objective) / 1000.0});
  return {{"map",
           {{"axes", std::move(axes)},
            {"cells", elites.cells()},
            {"count", elites.size()},
            {"filled", std::move(filled)}}}};
}

}  // namespace amble::watch
