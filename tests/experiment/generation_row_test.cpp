#include "amble/experiment/generation_row.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <sstream>
#include <string>

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

/// The cell of a line under this column.
std::string cell(const std::string& line, const std::string& column) {
  std::istringstream names(csv_header()), cells(line);
  for (std::string name, found; std::getline(names, name, ',') && std::getline(cells, found, ',');)
    if (name == column) return found;
  return "no such column";
}

TEST(GenerationRow, HasCellsOfNoveltySearchThatAreEmptyForOtherSearches) {
  GenerationRow row;
  EXPECT_EQ(cell(csv_line(row), "archive"), "");
  EXPECT_EQ(cell(csv_line(row), "novelty_threshold"), "");
  EXPECT_EQ(cell(csv_line(row), "best_novelty"), "");
  row.evaluations = 77;
  row.novelty = {.archive_members = 17, .threshold = 1200.0, .best_novelty = 0.1};
  EXPECT_EQ(cell(csv_line(row), "archive"), "17");
  EXPECT_EQ(cell(csv_line(row), "novelty_threshold"), "1200");
  EXPECT_EQ(cell(csv_line(row), "best_novelty"), "0.1");
  EXPECT_EQ(cell(csv_line(row), "evaluations"), "77");
}

TEST(GenerationRow, EndsWithItsTimes) {
  EXPECT_TRUE(csv_header().ends_with(
      ",steps,wall_s,outside_s,physics_s,decode_s,control_s,waiting_s,judge_s,breed_s,referees_s,files_s\n"));
  GenerationRow row;
  row.wall_s = 2.0;
  row.times = {.physics_s = 1.25, .referees_s = 0.25, .files_s = 0.125};
  EXPECT_EQ(cell(csv_line(row), "outside_s"), "0.500000");
  EXPECT_EQ(cell(csv_line(row), "physics_s"), "1.250000");
  EXPECT_TRUE(csv_line(row).ends_with(",0.125000\n"));
}

}  // namespace
}  // namespace amble::experiment
