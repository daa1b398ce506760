#include "amble/experiment/generation_row.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>

namespace amble::experiment {
namespace {

TEST(GenerationRow, SummarisesDistancesAndOutcomes) {
  const std::array<double, 4> distances_m{1.0, 4.0, 2.0, 3.5};
  std::array<record::Trajectory, 4> trajectories;
  trajectories[0].outcome = record::Outcome::fell;
  trajectories[2].outcome = record::Outcome::fell;
  trajectories[3].outcome = record::Outcome::diverged;
  GenerationRow row;
  summarise_trials(distances_m, trajectories, row);
  EXPECT_EQ(row.best_m, 4.0);
  EXPECT_EQ(row.mean_m, 2.625);
  EXPECT_EQ(row.median_m, 2.75);
  EXPECT_EQ(row.fell, 2);
  EXPECT_EQ(row.diverged, 1);
}

TEST(GenerationRow, MedianOfAnOddCountIsTheMiddleOne) {
  const std::array<double, 3> distances_m{9.0, 1.0, 2.0};
  GenerationRow row;
  summarise_trials(distances_m, {}, row);
  EXPECT_EQ(row.median_m, 2.0);
}

TEST(GenerationRow, LineHasAsManyColumnsAsTheHeaderAndRoundTripsNumbers) {
  GenerationRow row;
  row.best_m = 0.1 + 0.2;
  const auto line = csv_line(row), header = csv_header();
  EXPECT_EQ(std::count(line.begin(), line.end(), ','), std::count(header.begin(), header.end(), ','));
  EXPECT_EQ(std::stod(line.substr(line.find(',') + 1)), 0.1 + 0.2);
}

}  // namespace
}  // namespace amble::experiment
