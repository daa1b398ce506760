#include "amble/record/generations_csv.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/core/error_of.hpp"

namespace amble::record {
namespace {

using testing::ElementsAre;

const std::string header =
    "generation,best,mean,median,species,threshold,mean_hidden,mean_links,evaluations,steps";

std::string error_of(const std::string& text) {
  return tests::error_of([&] { parse_generations(text, "runs/1/generations.csv"); });
}

TEST(GenerationsCsv, PassesOverARowThatWasNotWrittenToItsEnd) {
  const std::string row = "0,0.25,0.125,-0.5,3,100,0,8,300,450000\n";
  for (const char* torn : {"1,0.5", "1,0.5,0.5,0.25,4,90,0.5,8.5,301,440000"})
    EXPECT_EQ(parse_generations(header + "\n" + row + torn, "x").count(), 1u) << torn;
  EXPECT_NE(error_of(header + "\n1,0.5\n" + row), "") << "not the last";
}

TEST(GenerationsCsv, ReadsColumnsByNameInAnyOrder) {
  const auto table = parse_generations(
      "steps,wall_s,generation,best,mean,median,species,threshold,mean_hidden,mean_links,evaluations\n"
      "450000,0.5,0,0.25,0.125,-0.5,3,100,0,8,300\n"
      "440000,0.75,1,1e0,0.5,0.25,4,90,0.5,8.5,301\n",
      "x");
  ASSERT_EQ(table.count(), 2u);
  EXPECT_THAT(table.generation, ElementsAre(0, 1));
  EXPECT_THAT(table.best, ElementsAre(0.25, 1));
  EXPECT_THAT(table.mean, ElementsAre(0.125, 0.5));
  EXPECT_THAT(table.median, ElementsAre(-0.5, 0.25));
  EXPECT_THAT(table.species, ElementsAre(3, 4));
  EXPECT_THAT(table.threshold, ElementsAre(100, 90));
  EXPECT_THAT(table.mean_hidden, ElementsAre(0, 0.5));
  EXPECT_THAT(table.mean_links, ElementsAre(8, 8.5));
  EXPECT_THAT(table.evaluations, ElementsAre(300, 301));
  EXPECT_THAT(table.steps, ElementsAre(450000, 440000));
  EXPECT_THAT(table.wall_s, ElementsAre(0.5, 0.75));
  EXPECT_TRUE(table.physics_s.empty());
}

TEST(GenerationsCsv, KnowsTheNamesOfRunFoldersUpToVersionFive) {
  const auto table = parse_generations(
      "generation,best_m,best_so_far_m,mean_m,median_m,species,evaluations,steps\n0,4,4,2,1,3,300,450000\n",
      "x");
  EXPECT_THAT(table.best, ElementsAre(4));
  EXPECT_THAT(table.mean, ElementsAre(2));
  EXPECT_THAT(table.median, ElementsAre(1));
}

TEST(GenerationsCsv, TakesAHeaderAloneAndLinesEndingInCarriageReturns) {
  EXPECT_EQ(parse_generations(header + "\n", "x").count(), 0u);
  EXPECT_THAT(parse_generations(header + "\r\n0,1,2,3,4,5,6,7,8,9\r\n", "x").steps, ElementsAre(9));
}

TEST(GenerationsCsv, TakesColumnsOfNoveltySearchFilledEmptyOrAbsent) {
  const std::string more = header + ",archive,novelty_threshold,best_novelty\n", row = "0,1,2,3,4,5,6,7,8,9";
  const auto filled = parse_generations(more + row + ",15,1000,0.5\n" + row + ",17,1200,2e3\n", "x");
  EXPECT_THAT(filled.archive, ElementsAre(15, 17));
  EXPECT_THAT(filled.novelty_threshold, ElementsAre(1000, 1200));
  EXPECT_THAT(filled.best_novelty, ElementsAre(0.5, 2000));
  const auto empty = parse_generations(more + row + ",,,\n", "x");
  EXPECT_EQ(empty.count(), 1u);
  EXPECT_TRUE(empty.archive.empty());
  EXPECT_TRUE(parse_generations(header + "\n" + row + "\n", "x").best_novelty.empty());
  const std::string partly = ":3: column 'archive': filled in some rows only";
  EXPECT_EQ(error_of(more + row + ",15,1000,1\n" + row + ",,1000,1\n"), "runs/1/generations.csv" + partly);
  EXPECT_EQ(error_of(more + row + ",,1000,1\n" + row + ",15,1000,1\n"), "runs/1/generations.csv" + partly);
}

TEST(GenerationsCsv, NamesFileLineAndColumnOfWhatIsWrong) {
  EXPECT_EQ(error_of(""), "runs/1/generations.csv:1: expected a row of column names, found an empty file");
  EXPECT_EQ(error_of("generation,mean\n"), "runs/1/generations.csv:1: column 'best' is missing");
  EXPECT_EQ(error_of(header + "\n0,1,2,3,4,5,6,7,8,9\n1,x,2,3,4,5,6,7,8,9\n"),
            "runs/1/generations.csv:3: column 'best': expected a number, found 'x'");
  EXPECT_EQ(error_of(header + "\n0,1,2,3,4,5,6,7,8,9 \n"),
            "runs/1/generations.csv:2: column 'steps': expected a number, found '9 '");
  EXPECT_EQ(error_of(header + "\n0,1,nan,3,4,5,6,7,8,9\n"),
            "runs/1/generations.csv:2: column 'mean': expected a number, found 'nan'");
  EXPECT_EQ(error_of(header + "\n0,1,2\n"), "runs/1/generations.csv:2: expected 10 columns, found 3");
  EXPECT_EQ(error_of(header + "\n\n"), "runs/1/generations.csv:2: expected 10 columns, found 1");
}

TEST(GenerationsCsv, MissingFileIsAnErrorOfTheSystem) {
  try {
    read_generations("/nonexistent/generations.csv");
    FAIL();
  } catch (const UserError& error) {
    EXPECT_EQ(error.code(), ExitCode::io);
  }
}

}  // namespace
}  // namespace amble::record
