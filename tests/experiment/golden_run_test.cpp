#include <gtest/gtest.h>

#include <array>
#include <cstdint>
#include <filesystem>
#include <ostream>
#include <string>
#include <vector>

#include "amble/core/hash.hpp"
#include "amble/io/binary.hpp"
#include "amble/io/file.hpp"
#include "tests/experiment/fixture.hpp"

// Whole runs, pinned: a change that alters one bit of physics, controllers, CPPNs, NEAT or search anywhere on
// the way fails here, also one that is consistent with itself. Results of studies are comparable as long as
// these hold. The last one has noise, and an archive whose threshold rises and falls. Only the batch engine:
// ODE's and MuJoCo's own libraries call libm, whose bits depend on the CPU.
namespace amble::experiment {
namespace {

struct Golden {
  const char* config;  ///< below configs/
  const char* hash;
  const char* archive = "";               ///< hash of thresholds and archive; "" without an archive
  std::vector<std::string> changes = {};  ///< assignments
};

void PrintTo(const Golden& golden, std::ostream* out) {
  *out << golden.config;
  for (const auto& change : golden.changes) *out << ' ' << change;
}

/// `hash` and the archive's members, read from its file (docs/FORMATS.md) without what is around them.
std::string archive_hash(const std::filesystem::path& file, std::uint64_t hash) {
  const std::string bytes = io::read_file(file);
  io::BinaryReader reader(bytes, file.string());
  reader.get<std::uint64_t>();  // what the file is
  reader.get<std::uint32_t>();  // version
  const auto length = reader.get<std::uint32_t>();
  const std::size_t members = (bytes.size() - 16) / (4 * std::size_t{length} + 8);
  for (std::size_t member = 0; member < members; ++member) {
    for (std::uint32_t i = 0; i < length; ++i) {
      const std::array<float, 1> number{reader.get<float>()};
      hash = hash_span<float>(number, hash);
    }
    reader.get<std::uint64_t>();  // checksum
  }
  reader.finish();
  EXPECT_GE(members, 15u);
  return hex(hash);
}

struct Hashes {
  std::string run, archive;
};

/// Numbers of every generation, and of every champion's trial step by step: independent of file formats.
Hashes run_hashes(const Golden& golden) {
  Overrides overrides{
      .assignments = {"engine=batch", "population.size=40", "speciation.target_min=6",
                      "speciation.target_max=10", "speciation.initial_threshold=6", "trial.duration_s=3"},
      .seed = 7,
      .generations = 8};
  overrides.assignments.insert(overrides.assignments.end(), golden.changes.begin(), golden.changes.end());
  const auto config =
      load_config(std::string(AMBLE_SOURCE_DIR) + "/configs/" + golden.config + ".toml", overrides);
  const TemporaryFolder scratch;
  Listener listener;
  EXPECT_EQ(Run::start(scratch / "run", config, 1).execute(listener, listener.stop), RunStatus::finished);
  std::uint64_t hash = 0, thresholds = 0;
  for (const GenerationRow& row : listener.rows) {
    const auto metric_of = [&row](std::string_view name) { return row.metric(name).value_or(0.0); };
    const std::array<double, 9> numbers{row.best,
                                        row.mean,
                                        row.median,
                                        metric_of("threshold"),
                                        metric_of("mean_links"),
                                        metric_of("mean_hidden"),
                                        metric_of("species"),
                                        metric_of("archive"),
                                        metric_of("best_novelty")};
    hash = hash_span<double>(numbers, hash);
    thresholds = hash_span<double>(std::array{metric_of("novelty_threshold")}, thresholds);
  }
  for (const auto& file : RunPaths(scratch / "run").champion_files())
    hash = hash_span<std::uint32_t>(load_champion(file).trace, hash);
  const auto archive = scratch / "run/archive.bin";
  return {hex(hash), std::filesystem::exists(archive) ? archive_hash(archive, thresholds) : ""};
}

class GoldenRun : public testing::TestWithParam<Golden> {};

TEST_P(GoldenRun, GivesTheSameBitsForEver) {
  const Hashes hashes = run_hashes(GetParam());
  EXPECT_EQ(hashes.run, GetParam().hash);
  EXPECT_EQ(hashes.archive, GetParam().archive);
}

INSTANTIATE_TEST_SUITE_P(
    Run, GoldenRun,
    testing::Values(Golden{"authors/supg-novelty", "d845546e6e2001d0", "6f25df35f9ea510e"},
                    Golden{"authors/supg-objective", "392685cb71ae9214"},
                    Golden{"authors/ctrnn-novelty", "0045d63eaba3c807", "78d19a9f73070ba7"},
                    Golden{"authors/sine-objective", "c0695b524719fc88"},
                    Golden{"paper/supg-novelty", "3055d4e1a19ba920", "2a700f6409d33a4b"},
                    Golden{"paper/ctrnn-objective", "44ca20b0bd80484d"},
                    Golden{"paper/sine-novelty", "a25bbc790da0efc5", "44525b6d0aa39e1e"},
                    Golden{"robust/supg-objective", "f35a4fc49a82b68d"},
                    Golden{"robust/supg-objective",
                           "7a5ea5eb89b07223",
                           "40e210598e4a3add",
                           {"search.kind=novelty", "search.novelty.threshold=60",
                            "search.novelty.lower_after=1"}}),
    [](const auto& golden) {
      std::string name = golden.param.config;
      for (char& c : name)
        if (c == '/' || c == '-') c = '_';
      if (!golden.param.changes.empty()) name += "_under_novelty";
      return name;
    });

}  // namespace
}  // namespace amble::experiment
