#pragma once

#include <gtest/gtest.h>

#include <atomic>
#include <cstdlib>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "amble/experiment/repertoire.hpp"
#include "amble/experiment/run.hpp"
#include "amble/io/file.hpp"
#include "amble/io/json_file.hpp"
#include "amble/neat/population.hpp"
#include "tests/io/temporary_folder.hpp"

namespace amble::experiment {

using test::TemporaryFolder;

/// configs/authors/supg-objective.toml, made small: 40 genomes, trials of one second.
inline Config small_config(std::vector<std::string> more = {}) {
  Overrides overrides{
      .assignments = {"population.size=40", "trial.duration_s=1"}, .seed = 1, .generations = 3};
  overrides.assignments.insert(overrides.assignments.end(), more.begin(), more.end());
  return load_config(AMBLE_SOURCE_DIR "/configs/authors/supg-objective.toml", overrides);
}

/// Config::identity(), read.
inline io::Json identity_json(const Config& config) {
  return io::parse_json(config.identity(), "identity");
}

/// The same under novelty search, with a threshold that makes the archive grow in each of these generations.
inline Config small_novelty_config(std::vector<std::string> more = {}) {
  more.insert(more.begin(), {"search.kind=novelty", "search.novelty.threshold=0.5"});
  return small_config(std::move(more));
}

/// The same under MAP-Elites, in batches of 32, by the mean duty factor and how far it turns.
inline Config small_map_config(std::vector<std::string> more = {}) {
  more.insert(more.begin(), {"search.kind=map-elites", "engine=batch", "search.map_elites.batch=32",
                             "search.map_elites.initial=32", "search.map_elites.reevaluate_share=0.25",
                             "search.map_elites.descriptors=[{quantity=\"duty_factor\", bins=4}, "
                             "{quantity=\"turn\", least=-30, most=30, bins=6}]"});
  return small_config(std::move(more));
}

/// Every kind of noise, and two episodes.
inline std::vector<std::string> all_noise() {
  return {"noise.episodes=2",
          "noise.push_m_s=0.3",
          "noise.push_interval_s=0.3",
          "noise.start_joint_rad=0.05",
          "noise.start_tilt_rad=0.05",
          "noise.start_height_m=0.02",
          "noise.touch_flip_probability=0.01",
          "noise.joint_sensor_rad=0.02",
          "noise.attitude_sensor_rad=0.02",
          "noise.latency_ticks=2"};
}

inline Problem small_problem(const Config& config = small_config()) {
  return Problem::make(config, load_robot_file(config.robot));
}
inline Problem noisy_problem() {
  return small_problem(small_config(all_noise()));
}

inline neat::Population small_population(const Problem& problem, std::uint64_t seed = 1) {
  return neat::Population(small_config().neat, problem.cppn_inputs(), problem.cppn_outputs(), true, seed);
}

/// All champion files of a run folder, one after another.
inline std::string champion_bytes(const std::filesystem::path& folder) {
  std::string all;
  for (const auto& file : RunPaths(folder).champion_files()) all += io::read_file(file);
  return all;
}

inline const std::atomic<bool> unstopped{false};

/// Hears nothing, or stops the run after some generations.
class Listener : public RunListener {
 public:
  explicit Listener(int stop_after = 1 << 30) : left_(stop_after) {}
  void on_generation(const GenerationRow& row, const Progress&, const Config&) override {
    rows.push_back(row);
    if (--left_ == 0) stop = true;
  }
  std::atomic<bool> stop{false};
  std::vector<GenerationRow> rows;

 private:
  int left_;
};

/// A map of six generations under every kind of noise.
class EvolvedMap : public testing::Test {
 protected:
  EvolvedMap() {
    auto config = small_map_config(all_noise());
    config.generations = 6;
    Listener listener;
    Run::start(scratch_ / "run", config, 2).execute(listener, listener.stop);
  }
  Repertoire map() const { return load_repertoire(RunPaths(scratch_ / "run")); }

 private:
  TemporaryFolder scratch_;
};

}  // namespace amble::experiment
