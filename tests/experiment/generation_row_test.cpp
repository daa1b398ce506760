#include "amble/experiment/plan/generation_row.hpp"

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
  const auto header = csv_header(row.search), line = csv_line(row, header);
  EXPECT_EQ(std::count(line.begin(), line.end(), ','), std::count(header.begin(), header.end(), ','));
  EXPECT_EQ(std::stod(line.substr(line.find(',') + 1)), 0.1 + 0.2);
}

/// The cell of a row under this column.
std::string cell(const GenerationRow& row, const std::string& column) {
  std::istringstream names(csv_header(row.search)), cells(csv_line(row, csv_header(row.search)));
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

TEST(GenerationRow, UnderAnEarlierHeaderHasItsColumnsAlone) {
  GenerationRow row;
  row.generation = 4;
  row.best = 2.5;
  row.typical.median = 1.5;
  row.search = {{"archive", 17.0}};
  EXPECT_EQ(csv_line(row, "generation,best,archive"), "4,2.5,17\n");
  EXPECT_EQ(csv_line(row, "typical,generation\n"), "1.5,4\n");
  EXPECT_EQ(unknown_column(csv_header(row.search), row.search), "");
  EXPECT_EQ(unknown_column("generation,colour", row.search), "colour");
  EXPECT_EQ(unknown_column("generation,archive", {}), "archive");
}

TEST(GenerationRow, EndsWithItsTimes) {
  EXPECT_TRUE(csv_header({}).ends_with(
      ",steps,wall_s,outside_s,physics_s,decode_s,control_s,waiting_s,search_s,referees_s,files_s\n"));
  GenerationRow row;
  row.wall_s = 2.0;
  row.times = {.physics_s = 1.25, .referees_s = 0.25, .files_s = 0.125};
  EXPECT_EQ(cell(row, "outside_s"), "0.500000");
  EXPECT_EQ(cell(row, "physics_s"), "1.250000");
  EXPECT_TRUE(csv_line(row, csv_header(row.search)).ends_with(",0.125000\n"));
}

}  // namespace
}  // namespace amble::experiment
