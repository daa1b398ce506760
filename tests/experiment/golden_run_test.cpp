#include <gtest/gtest.h>

#include <array>
#include <cstdint>
#include <ostream>
#include <string>
#include <vector>

#include "amble/core/hash.hpp"
#include "tests/experiment/fixture.hpp"

// Whole runs, pinned: a change that alters one bit of physics, controllers, CPPNs, NEAT or search anywhere on
// the way fails here, also one that is consistent with itself. Results of studies are comparable as long as
// these hold. Only the batch engine: ODE's and MuJoCo's own libraries call libm, whose bits depend on the
// CPU.
namespace amble::experiment {
namespace {

struct Golden {
  const char* config;  ///< below configs/
  const char* hash;
};

void PrintTo(const Golden& golden, std::ostream* out) {
  *out << golden.config;
}

/// Numbers of every generation, and of every champion's trial step by step: independent of file formats.
std::string run_hash(const Golden& golden) {
  Overrides overrides{
      .assignments = {"engine=batch", "population.size=40", "speciation.target_min=6",
                      "speciation.target_max=10", "speciation.initial_threshold=6", "trial.duration_s=3"},
      .seed = 7,
      .generations = 8};

  const auto config =
      load_config(std::string(AMBLE_SOURCE_DIR) + "/configs/" + golden.config + ".toml", overrides);
  const TemporaryFolder scratch;
  Listener listener;
  EXPECT_EQ(Run::start(scratch / "run", config, 1).execute(listener, listener.stop), RunStatus::finished);
  std::uint64_t hash = 0;
  for (const GenerationRow& row : listener.rows) {
    const auto novelty = row.novelty.value_or(search::NoveltyStatistics{});
    const std::array<double, 9> numbers{row.best_m,
                                        row.mean_m,
                                        row.median_m,
                                        row.population.compatibility_threshold,
                                        row.population.mean_links,
                                        row.population.mean_hidden,
                                        static_cast<double>(row.population.species),
                                        static_cast<double>(novelty.archive_members),
                                        novelty.best_novelty};
    hash = hash_span<double>(numbers, hash);
  }
  for (const auto& file : RunPaths(scratch / "run").champion_files())
    hash = hash_span<std::uint32_t>(load_champion(file).trace, hash);
  return hex(hash);
}

class GoldenRun : public testing::TestWithParam<Golden> {};

TEST_P(GoldenRun, GivesTheSameBitsForEver) {
  EXPECT_EQ(run_hash(GetParam()), GetParam().hash);
}

INSTANTIATE_TEST_SUITE_P(Run, GoldenRun,
                         testing::Values(Golden{"authors/supg-novelty", "d845546e6e2001d0"},
                                         Golden{"authors/supg-objective", "392685cb71ae9214"},
                                         Golden{"authors/ctrnn-novelty", "0045d63eaba3c807"},
                                         Golden{"authors/sine-objective", "c0695b524719fc88"},
                                         Golden{"paper/supg-novelty", "3055d4e1a19ba920"},
                                         Golden{"paper/ctrnn-objective", "44ca20b0bd80484d"},
                                         Golden{"paper/sine-novelty", "a25bbc790da0efc5"},
                                         Golden{"robust/supg-objective", "f35a4fc49a82b68d"}),
                         [](const auto& golden) {
                           std::string name = golden.param.config;
                           for (char& c : name)
                             if (c == '/' || c == '-') c = '_';
                           return name;
                         });

}  // namespace
}  // namespace amble::experiment
