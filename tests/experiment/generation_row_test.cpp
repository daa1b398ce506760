#include "amble/experiment/generation_row.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <sstream>
#include <string>

namespace amble::experiment {
namespace {

TEST(GenerationRow, SummarisesDistancesAndOutcomes) {
  const std::array<double, 4> objectives{1.0, 4.0, 2.0, 3.5};
  std::array<record::Trajectory, 4> trajectories;
  trajectories[0].outcome = record::Outcome::fell;
  trajectories[2].outcome = record::Outcome::fell;
  trajectories[3].outcome = record::Outcome::diverged;
  GenerationRow row;
  summarise_trials(objectives, trajectories, row);
  EXPECT_EQ(row.best, 4.0);
  EXPECT_EQ(row.mean, 2.625);
  EXPECT_EQ(row.median, 2.75);
  EXPECT_EQ(row.fell, 2);
  EXPECT_EQ(row.diverged, 1);
}

TEST(GenerationRow, MedianOfAnOddCountIsTheMiddleOne) {
  const std::array<double, 3> objectives{9.0, 1.0, 2.0};
  GenerationRow row;
  summarise_trials(objectives, {}, row);
  EXPECT_EQ(row.median, 2.0);
}

TEST(GenerationRow, LineHasAsManyColumnsAsTheHeaderAndRoundTripsNumbers) {
  GenerationRow row;
  row.best = 0.1 + 0.2;
  row.search = {{"archive", 1.0}};
  const auto line = csv_line(row), header = csv_header(row.search);
  EXPECT_EQ(std::count(line.begin(), line.end(), ','), std::count(header.begin(), header.end(), ','));
  EXPECT_EQ(std::stod(line.substr(line.find(',') + 1)), 0.1 + 0.2);
}

/// The cell of a row under this column.
std::string cell(const GenerationRow& row, const std::string& column) {
  std::istringstream names(csv_header(row.search)), cells(csv_line(row));
  for (std::string name, found; std::getline(names, name, ',') && std::getline(cells, found, ',');)
    if (name == column) return found;
  return "no such column";
}

TEST(GenerationRow, HasTheColumnsOfItsSearchBetweenItsOwnAndItsTimes) {
  GenerationRow row;
  row.evaluations = 77;
  row.search = {{"archive", 17.0}, {"novelty_threshold", 1200.0}, {"best_novelty", 0.1}};
  EXPECT_EQ(cell(row, "archive"), "17");
  EXPECT_EQ(cell(row, "novelty_threshold"), "1200");
  EXPECT_EQ(cell(row, "best_novelty"), "0.1");
  EXPECT_EQ(cell(row, "evaluations"), "77");
  EXPECT_NE(csv_header(row.search).find(",steps,archive,novelty_threshold,best_novelty,wall_s,"),
            std::string::npos);
  EXPECT_NE(csv_header({}).find(",steps,wall_s,"), std::string::npos);
  EXPECT_EQ(row.metric("archive"), 17.0);
  EXPECT_FALSE(row.metric("species"));
}

TEST(GenerationRow, EndsWithItsTimes) {
  EXPECT_TRUE(csv_header({}).ends_with(
      ",steps,wall_s,outside_s,physics_s,decode_s,control_s,waiting_s,search_s,referees_s,files_s\n"));
  GenerationRow row;
  row.wall_s = 2.0;
  row.times = {.physics_s = 1.25, .referees_s = 0.25, .files_s = 0.125};
  EXPECT_EQ(cell(row, "outside_s"), "0.500000");
  EXPECT_EQ(cell(row, "physics_s"), "1.250000");
  EXPECT_TRUE(csv_line(row).ends_with(",0.125000\n"));
}

}  // namespace
}  // namespace amble::experiment
