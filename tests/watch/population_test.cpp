#include "amble/watch/population.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "tests/experiment/fixture.hpp"

namespace amble::watch {
namespace {

using experiment::Listener;
using experiment::Run;
using experiment::RunPaths;

io::Json population_of(const experiment::Config& config) {
  const test::TemporaryFolder scratch;
  Listener listener;
  Run::start(scratch / "run", config, 1).execute(listener, listener.stop);
  PopulationReader reader(RunPaths(scratch / "run"));
  const io::Json found = reader.poll(0);
  EXPECT_TRUE(reader.poll(100).is_null()) << "nothing has changed";
  return found;
}

TEST(Population, HasTheSpeciesOfTheNextGeneration) {
  for (const auto& config :
       {experiment::small_config({"engine=batch"}), experiment::small_novelty_config({"engine=batch"})}) {
    const io::Json found = population_of(config);
    EXPECT_EQ(found.at("generation"), 3);
    int all = 0;
    for (const auto& species : found.at("species")) all += species.at(1).get<int>();
    EXPECT_EQ(all, 40);
  }
}

TEST(Population, OfARunUnderMapElitesIsItsMap) {
  const io::Json map = population_of(experiment::small_map_config()).at("map");
  EXPECT_EQ(map.at("cells"), 24);
  EXPECT_EQ(map.at("axes").size(), 2U);
  EXPECT_EQ(map.at("axes").at(0).at("name"), "duty_factor");
  EXPECT_EQ(map.at("axes").at(1).at("bins"), 6);
  EXPECT_GT(map.at("count"), 1);
  EXPECT_EQ(map.at("filled").size(), map.at("count").get<std::size_t>());
}

TEST(Population, IsNothingWhereFilesDoNotFit) {
  const test::TemporaryFolder scratch;
  const RunPaths paths(scratch.path());
  PopulationReader reader(paths);
  EXPECT_TRUE(reader.poll(0).is_null());
  Listener listener;
  Run::start(scratch / "run", experiment::small_config({"engine=batch"}), 1).execute(listener, listener.stop);
  std::ofstream(scratch / "run/checkpoint.bin", std::ios::app) << "more";
  PopulationReader broken(RunPaths(scratch / "run"));
  EXPECT_TRUE(broken.poll(0).is_null());
}

}  // namespace
}  // namespace amble::watch
