#include "amble/browser/run.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <memory>
#include <string>

#include "amble/browser/plan.hpp"
#include "amble/browser/trials.hpp"
#include "amble/core/error.hpp"
#include "amble/io/json_file.hpp"
#include "tests/browser/champion.hpp"

namespace amble::browser {
namespace {

/// A small run with the controller of the servo robot's champion.
experiment::Config small_config(const std::string& search) {
  const auto problem = experiment::parse_champion(tests::champion_text(), "champion").champion.problem;
  experiment::Config config;
  config.robot = "robot.json";
  config.engine = "batch";
  config.neat.population.size = 20;
  config.cppn = problem.cppn;
  config.controller = problem.controller;
  config.trial = problem.trial;
  config.trial.duration_s = 1.0;
  config.noise.start_joint_rad = 1e-3;
  config.search.kind = search;
  return config;
}

std::string plan_text(const experiment::Config& config, double gravity = 1.0) {
  return io::Json{{"config", io::parse_json(config_json(config), "config")},
                  {"robot", tests::champion_text()},
                  {"gravity", gravity},
                  {"new", true}}
      .dump();
}

std::shared_ptr<const Plan> plan(const std::string& search = "objective") {
  return std::make_shared<const Plan>(plan_text(small_config(search)));
}

/// One generation, so many genomes at a time, the last ones first.
std::string step(browser::Run& run, const std::shared_ptr<const Plan>& of, std::size_t together) {
  const std::size_t all = run.candidates();
  for (std::size_t left = all; left > 0;) {
    const std::size_t first = left - std::min(together, left);
    Trials trials(of);
    trials.begin(run.generation(), run.candidates(first, left - first));
    while (!trials.advance(17)) {
    }
    run.take(first, trials.told().bytes());
    left = first;
  }
  run.tell(0.5);
  return run.progress_json();
}

TEST(BrowserRun, IsTheSameWhicheverGenomesAreTriedTogether) {
  const auto of = plan();
  browser::Run one(of), other(of);
  for (int i = 0; i < 3; ++i) EXPECT_EQ(step(one, of, 20), step(other, of, 3));
  EXPECT_EQ(one.files(), other.files());
}

TEST(BrowserRun, GoesOnFromItsFilesToTheSameBits) {
  for (const char* search : {"objective", "novelty"}) {
    const auto of = plan(search);
    browser::Run whole(of);
    step(whole, of, 16);
    step(whole, of, 16);
    browser::Run again(of, whole.files());
    EXPECT_EQ(again.generation(), 2);
    EXPECT_EQ(step(again, of, 16), step(whole, of, 16)) << search;
    EXPECT_EQ(again.files(), whole.files()) << search;
  }
}

TEST(BrowserRun, TellsWhereTheMembersOfANoveltyArchiveEnded) {
  const auto of = plan("novelty"), farthest = plan();
  browser::Run run(of);
  std::size_t before = 0;
  for (int i = 0; i < 3; ++i) {
    const io::Json told = io::parse_json(step(run, of, 20), "progress");
    const auto members = told["metrics"]["archive"].get<std::size_t>();
    ASSERT_EQ(told["archive"].size(), 2 * members);
    EXPECT_GE(members, before);
    before = members;
    if (i > 0 || members == 0) continue;
    // All of them are robots of the first generation, in their order.
    std::size_t at = 0;
    const auto &ends = told["ends"], &archive = told["archive"];
    for (std::size_t k = 0; k < ends.size() && at < archive.size(); k += 2)
      if (ends[k] == archive[at] && ends[k + 1] == archive[at + 1]) at += 2;
    EXPECT_EQ(at, archive.size());
  }
  EXPECT_GT(before, 0u);
  browser::Run other(farthest);
  EXPECT_TRUE(io::parse_json(step(other, farthest, 20), "progress")["archive"].is_null());
}

TEST(BrowserRun, RefusesFilesOfAnotherRunAndDamagedOnes) {
  const auto of = plan();
  browser::Run run(of);
  step(run, of, 16);
  const Files files = run.files();
  for (const char* damaged : {"checkpoint.bin", "generations.csv"}) {
    Files less = files;
    less[damaged].resize(less[damaged].size() / 2);
    EXPECT_THROW(browser::Run(of, less), UserError) << damaged;
    less.erase(damaged);
    EXPECT_THROW(browser::Run(of, less), UserError) << damaged;
  }
  auto other = small_config("objective");
  other.seed = 2;
  EXPECT_THROW(browser::Run(std::make_shared<const Plan>(plan_text(other)), files), UserError);
}

TEST(BrowserRun, ForgetsTheBestOfAnotherWorldAndKeepsItsSearch) {
  const auto of = plan();
  browser::Run run(of);
  step(run, of, 16);
  auto config = small_config("objective");
  config.ground.slope_x = 0.1;
  const auto uphill = std::make_shared<const Plan>(plan_text(config, 0.38));
  run.change(uphill);
  const auto told = io::parse_json(step(run, uphill, 16), "progress");
  EXPECT_EQ(told.at("best_generation"), 1);
  EXPECT_EQ(told.at("best"), told.at("best_so_far"));
  config.neat.mutation.add_node_share = 0.3;
  EXPECT_THROW(run.change(std::make_shared<const Plan>(plan_text(config))), UserError);
}

TEST(Plan, HasTheRobotUnderItsGravity) {
  const Plan on_mars(plan_text(small_config("objective"), 0.38));
  EXPECT_NEAR(on_mars.robot.gravity_m_s2.z,
              0.38 * Plan(plan_text(small_config("objective"))).robot.gravity_m_s2.z, 1e-12);
}

TEST(Plan, RefusesWhatPagesDoNotHave) {
  auto config = small_config("objective");
  config.engine = "ode";
  EXPECT_THROW(Plan(plan_text(config)), UserError);
  config = small_config("objective");
  config.evaluation.finalists = 0.1;
  EXPECT_THROW(Plan(plan_text(config)), UserError);
  EXPECT_THROW(robot_in("{}"), UserError);
  EXPECT_THROW(robot_in("no JSON"), UserError);
}

TEST(ToldGenomes, ReadBackToTheSameBits) {
  const ToldGenomes told{.steps = 7,
                         .genomes = {{.objective = 0.1, .viable = false, .fell = 2, .behaviour = {1.5f}}}};
  const auto again = ToldGenomes::read(told.bytes());
  EXPECT_EQ(again.bytes(), told.bytes());
  EXPECT_THROW(ToldGenomes::read(told.bytes().substr(1)), UserError);
}

}  // namespace
}  // namespace amble::browser
