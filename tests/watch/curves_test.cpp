#include "amble/watch/curves.hpp"

#include <gtest/gtest.h>

#include <string>

#include "tests/watch/fake_run.hpp"

namespace amble::watch {
namespace {

class CurveOfARun : public testing::Test {
 protected:
  test::TemporaryFolder scratch_;
  FakeRun run_{scratch_ / "a", 100};
  Curve curve_{run_.folder() / "generations.csv"};

  std::string now() {
    curve_.poll();
    return curve_.json().dump();
  }
};

TEST_F(CurveOfARun, IsNothingBeforeTheFirstGeneration) {
  EXPECT_EQ(now(), "null");
}

TEST_F(CurveOfARun, HasTheGenerationsInWhichTheBestChanged) {
  for (const double best : {0.5, 0.5, 1.25, 1.0}) run_.grow(best);
  EXPECT_EQ(now(), R"({"last":3,"steps":[[0,0.5],[2,1.25],[3,1.0]]})");
  run_.grow(2.5);
  EXPECT_EQ(now(), R"({"last":4,"steps":[[0,0.5],[2,1.25],[3,1.0],[4,2.5]]})") << "it reads on";
}

TEST_F(CurveOfARun, BeginsAnewWithATableThatWasCutBack) {
  for (const double best : {0.5, 1.0, 2.0}) run_.grow(best);
  now();
  const auto table = run_.folder() / "generations.csv";
  std::ofstream(table)
      << "generation,best,mean,median,best_so_far,typical,species,wall_s\n0,3,0.1,0.2,3,0.5,3,2\n";
  EXPECT_EQ(now(), R"({"last":0,"steps":[[0,3.0]]})");
}

TEST_F(CurveOfARun, OfManyStepsHasTheFirstTheLastAndEvenlyChosenOnes) {
  for (int i = 0; i < 1000; ++i) run_.grow(1.0 + i);
  curve_.poll();
  const io::Json steps = curve_.json().at("steps");
  EXPECT_LE(steps.size(), 201u);
  EXPECT_EQ(steps.front().dump(), "[0,1.0]");
  EXPECT_EQ(steps.back().dump(), "[999,1000.0]");
}

TEST_F(CurveOfARun, OfATableWithoutTheColumnsIsNothing) {
  std::ofstream(run_.folder() / "generations.csv") << "something,else\n1,2\n";
  EXPECT_EQ(now(), "null");
}

TEST(Curves, AreOfTheRunsThatAreThereNow) {
  const test::TemporaryFolder scratch;
  FakeRun a(scratch / "a", 100), b(scratch / "b", 100);
  a.grow(1.0);
  b.grow(2.0);
  Curves curves;
  const auto table = [&scratch](const char* name) { return scratch / name / "generations.csv"; };
  EXPECT_EQ(curves.json({{"a", table("a")}, {"b", table("b")}}).at("runs").size(), 2u);
  const io::Json left = curves.json({{"b", table("b")}, {"none", table("none")}}).at("runs");
  EXPECT_EQ(left.dump(), R"({"b":{"last":0,"steps":[[0,2.0]]}})");
}

}  // namespace
}  // namespace amble::watch
