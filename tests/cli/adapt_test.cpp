#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

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

TEST_F(AdaptCommand, GivesTheSameForAnyNumberOfWorkersAndInTheMapsOwnEngine) {
  const std::vector<std::string> arguments{"adapt", run_,       "--damage", "weak:FL_knee=0.2", "--engine",
                                           "batch", "--trials", "4",        "--judge",          "3"};
  auto three = arguments;
  three.insert(three.end(), {"--jobs", "3"});
  EXPECT_EQ(amble(arguments).out, amble(three).out);
}

TEST_F(AdaptCommand, RefusesWhatTheRobotDoesNotHaveInOneLine) {
  expect_complaint({"adapt", run_, "--damage", "missing:tail"}, ExitCode::bad_input, "tail");
  expect_complaint({"adapt", run_, "--damage", "missing:FL", "--engine", "bullet"}, ExitCode::bad_input,
                   "bullet");
  expect_complaint({"adapt", scratch_ / "gone", "--damage", "missing:FL"}, ExitCode::io, "gone");
}

}  // namespace
}  // namespace amble::tests
