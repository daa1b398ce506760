#include "bench/walkers.hpp"

#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <filesystem>
#include <memory>
#include <string>

#include "amble/experiment/champion.hpp"
#include "amble/experiment/run.hpp"
#include "amble/physics/batch/batch_engine.hpp"
#include "bench/workload.hpp"

namespace amble::bench {
namespace {

class Silence : public experiment::RunListener {
 public:
  void on_generation(const experiment::GenerationRow&, const experiment::Progress&,
                     const experiment::Config&) override {}
};

/// The last two champions of one seed.
void evolve(int seed, std::vector<experiment::Champion>& champions) {
  const auto folder = std::filesystem::temp_directory_path() / ("amble-walkers-" + std::to_string(getpid()));
  auto config = authors_config({"engine=batch", "generations=15", "population.size=100"});
  config.seed = seed;
  Silence silence;
  const std::atomic<bool> never{false};
  auto run = experiment::Run::start(folder, config, 1);
  run.execute(silence, never);
  std::vector<std::filesystem::path> files;
  for (const auto& entry : std::filesystem::directory_iterator(folder / "champions"))
    files.push_back(entry.path());
  std::ranges::sort(files);
  for (std::size_t i = files.size() < 2 ? 0 : files.size() - 2; i < files.size(); ++i)
    champions.push_back(experiment::load_champion(files[i]));
  std::filesystem::remove_all(folder);
}

}  // namespace

Walkers evolve_walkers(int steps) {
  std::vector<experiment::Champion> champions;
  for (int seed = 1; champions.size() < walker_count; ++seed) evolve(seed, champions);
  const experiment::Problem& problem = champions[0].problem;
  const auto engine = physics::make_batch_engine(problem.robot, {});
  const auto controllers = problem.architecture->make_batch(walker_count);
  std::vector<std::unique_ptr<controllers::Parameters>> parameters;
  for (int lane = 0; lane < walker_count; ++lane) {
    parameters.push_back(problem.decode(champions[static_cast<std::size_t>(lane)].genome));
    controllers->load(lane, *parameters.back());
    engine->place(lane);
  }
  Walkers walkers{problem.robot, {}};
  for (int step = 0; step < steps; ++step) {
    walkers.targets_rad.emplace_back(static_cast<int>(problem.robot.joints.size()), walker_count);
    controllers->step(engine->sensors(), walkers.targets_rad.back());
    engine->step(walkers.targets_rad.back());
    for (int lane = 0; lane < walker_count; ++lane)
      walkers.mean_contacts += static_cast<double>(engine->contacts(lane)) / (steps * walker_count);
  }
  return walkers;
}

}  // namespace amble::bench
