#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <set>
#include <string>
#include <vector>

#include "tests/cli/bad_input.hpp"

namespace amble::tests {
namespace {

using testing::HasSubstr;

class AdaptCommand : public BadInput {
 protected:
  void SetUp() override {
    const auto evolved =
        amble({"evolve", std::string(AMBLE_SOURCE_DIR) + "/configs/repertoire/quadruped.toml", "--set",
               "search.map_elites.batch=128", "--set", "search.map_elites.initial=128", "--set",
               "trial.duration_s=2", "--generations", "4", "--out", run_});
    ASSERT_EQ(evolved.exit_code, 0) << evolved.err;
  }
  const std::string run_ = scratch_ / "run";
};

TEST_F(AdaptCommand, TriesElitesOnTheDamagedRobotAndJudgesTheOneItFound) {
  const std::string out = scratch_ / "adapt.json";
  const auto adapted =
      amble({"adapt", run_, "--damage", "missing:FL", "--trials", "5", "--judge", "4", "-o", out});
  ASSERT_EQ(adapted.exit_code, 0) << adapted.err;
  EXPECT_THAT(adapted.out, HasSubstr("the same, damaged"));
  const auto json = nlohmann::json::parse(slurp(out));
  EXPECT_EQ(json["engine"], "ode");
  ASSERT_GE(json["trials"].size(), 1u);
  EXPECT_LE(json["trials"].size(), 5u);
  const auto& first = json["trials"][0];
  double best = 0.0;
  for (const auto& trial : json["trials"]) {
    EXPECT_LE(trial["expected"], first["expected"]) << "the map's best comes first";
    best = std::max(best, trial["measured"].get<double>());
  }
  EXPECT_EQ(first["predicted"], first["expected"]);
  bool found = false;
  for (const auto& trial : json["trials"])
    found |= trial["cell"] == json["cell"] && trial["measured"].get<double>() == best;
  EXPECT_TRUE(found) << "it is the elite of the best trial";
}

TEST_F(AdaptCommand, MakesAPageInWhichTheElitesThatItTriedWalk) {
  const std::string out = scratch_ / "adapt.html", steps = scratch_ / "adapt.json";
  const std::vector<std::string> command{"adapt",    run_, "--damage", "missing:FL",
                                         "--trials", "4",  "--judge",  "2"};
  for (const std::string& file : {out, steps}) {
    auto whole = command;
    whole.insert(whole.end(), {"-o", file});
    const auto adapted = amble(whole);
    ASSERT_EQ(adapted.exit_code, 0) << adapted.err;
  }
  const auto data = page_data(slurp(out));
  const auto json = nlohmann::json::parse(slurp(steps));
  const auto& table = data["map"]["table"];
  ASSERT_EQ(table.size(), json["trials"].size() + 1) << "a head and a row per trial";
  std::set<int> tried, walking;
  for (std::size_t i = 0; i < json["trials"].size(); ++i) {
    EXPECT_EQ(table[i + 1][0], std::to_string(json["trials"][i]["cell"].get<int>()));
    tried.insert(json["trials"][i]["cell"].get<int>());
  }
  for (const auto& walker : data["walkers"]) walking.insert(walker["cell"].get<int>());
  EXPECT_EQ(walking, tried);
  EXPECT_EQ(data["walkers"].size(), tried.size());
  EXPECT_EQ(data["walkers"][0]["cell"], json["cell"]) << "the one it found is shown first";
}

TEST_F(AdaptCommand, GivesTheSameForAnyNumberOfWorkersAndInTheMapsOwnEngine) {
  const std::vector<std::string> arguments{"adapt", run_,       "--damage", "weak:FL_knee=0.2", "--engine",
                                           "batch", "--trials", "4",        "--judge",          "3"};
  auto three = arguments;
  three.insert(three.end(), {"--jobs", "3"});
  EXPECT_EQ(amble(arguments).out, amble(three).out);
}

TEST_F(AdaptCommand, SaysOfHowManyAttemptsItsTrialsAre) {
  const std::string out = scratch_ / "adapt.json";
  const auto adapted = amble({"adapt", run_, "--damage", "missing:FL", "--engine", "batch", "--trials", "2",
                              "--judge", "2", "--stop-share", "2", "--episodes", "3", "-o", out});
  ASSERT_EQ(adapted.exit_code, 0) << adapted.err;
  EXPECT_THAT(adapted.out, HasSubstr("stopped after 2 trials of 3 attempts"));
  EXPECT_EQ(nlohmann::json::parse(slurp(out))["episodes"], 3);
}

TEST_F(AdaptCommand, RefusesWhatTheRobotDoesNotHaveInOneLine) {
  expect_refusal({"adapt", run_, "--damage", "missing:tail"}, ExitCode::bad_input, "tail");
  expect_refusal({"adapt", run_, "--damage", "missing:FL", "--engine", "bullet"}, ExitCode::bad_input,
                 "bullet");
  expect_refusal({"adapt", scratch_ / "gone", "--damage", "missing:FL"}, ExitCode::io, "gone");
}

}  // namespace
}  // namespace amble::tests
