#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <set>
#include <string>
#include <vector>

#include "amble/core/error.hpp"
#include "amble/io/json_file.hpp"
#include "tests/cli/process.hpp"

namespace amble::tests {
namespace {

using testing::HasSubstr;
using testing::StartsWith;

const std::string configs = std::string(AMBLE_SOURCE_DIR) + "/configs/",
                  robust = configs + "robust/supg-objective.toml";

/// A small run in the batch engine, and its best champion.
class Compare : public testing::Test {
 protected:
  void SetUp() override {
    const auto evolved = amble({"evolve", robust, "--set", "engine=batch", "--set", "population.size=40",
                                "--set", "trial.duration_s=1", "--generations", "2", "--out", run_});
    ASSERT_EQ(evolved.exit_code, 0) << evolved.err;
    for (const auto& file : std::filesystem::directory_iterator(scratch_ / "run/champions"))
      champion_ = std::max(champion_, file.path().string());
  }

  /// What a command prints behind "distance  ".
  std::string distance(const std::vector<std::string>& command) {
    const auto out = amble(command).out;
    const auto at = out.find("distance  ") + 10;
    return out.substr(at, out.find('\n', at) - at);
  }

  TemporaryFolder scratch_;
  std::string run_ = scratch_ / "run", champion_;
};

TEST_F(Compare, CountsWhatIsNamedTwiceOnce) {
  const auto once = amble({"compare", champion_, "--engines", "batch", "--seconds", "1"});
  ASSERT_EQ(once.exit_code, 0) << once.err;
  EXPECT_EQ(amble({"compare", champion_, champion_, "--engines", "batch", "--seconds", "1,1"}).out, once.out);
}

TEST_F(Compare, MakesATableOfTheRequestedEnginesAndTheChampionsOwn) {
  const auto table = amble({"compare", champion_, run_, "--engines", "mujoco"});
  ASSERT_EQ(table.exit_code, 0) << table.err;
  EXPECT_THAT(table.out, HasSubstr("in batch "));
  EXPECT_THAT(table.out, Not(HasSubstr("in ode")));
  EXPECT_THAT(table.out, HasSubstr("\nmedian; kept 70 %")) << "two rows";
  EXPECT_THAT(table.out,
              testing::EndsWith("kept 70 %: of how many champions the distance in this engine is at "
                                "least 70 % of that in the engine in which they evolved\n"));
  const auto one = amble({"compare", champion_, "--engines", "mujoco", "--undisturbed"});
  EXPECT_THAT(one.out, HasSubstr("  " + distance({"trial", champion_, "--engine", "mujoco"}) + ", "));
  EXPECT_THAT(one.out, HasSubstr("1 s without noise"));
  const auto markdown = amble({"compare", champion_, "--engines", "mujoco", "--format", "markdown"}).out;
  EXPECT_THAT(
      markdown,
      StartsWith("| champion | evolved in | trials | in batch | in mujoco |\n|---|---|---|---|---|\n"));
}

TEST_F(Compare, TakesAnEngineThatIsAVariantOnlyIfItIsNamed) {
  EXPECT_THAT(amble({"compare", champion_, "--trials", "1"}).out, Not(HasSubstr("ode-variant")));
  EXPECT_THAT(amble({"compare", champion_, "--trials", "1", "--engines", "ode-variant"}).out,
              HasSubstr("in ode-variant"));
}

TEST_F(Compare, TrialTakesARunFolderForItsBestChampion) {
  const auto of_folder = amble({"trial", run_}), of_file = amble({"trial", champion_});
  EXPECT_EQ(of_folder.exit_code, 0) << of_folder.err;
  EXPECT_EQ(of_folder.out, of_file.out);
  EXPECT_NE(of_folder.out, "");
  const auto none = amble({"trial", scratch_.path().string()});
  EXPECT_EQ(none.exit_code, amble({"gait", scratch_.path().string()}).exit_code);
  EXPECT_THAT(none.err, StartsWith("amble: " + scratch_.path().string()));
}

TEST_F(Compare, ListsEveryLengthAndEngineAsJson) {
  const auto list = io::Json::parse(
      amble({"compare", champion_, "--seconds", "1,2", "--undisturbed", "--format", "json"}).out);
  ASSERT_EQ(list.size(), 2u);
  EXPECT_EQ(list[1]["trial_s"], 2.0);
  EXPECT_EQ(list[0]["evolved_in"], "batch");
  std::vector<std::string> engines;
  for (const auto& judged : list[0]["results"]) engines.push_back(judged["engine"]);
  EXPECT_THAT(engines, testing::IsSupersetOf({"ode", "batch", "mujoco"}));
  EXPECT_EQ(std::set(engines.begin(), engines.end()).size(), engines.size()) << "each once";
  EXPECT_EQ(list[0]["results"][0]["trials"].size(), 1u);
}

TEST_F(Compare, TakesTheMedianOfTrialsUnderNoiseThatEvolutionHasNotMet) {
  const auto under_noise =
      amble({"compare", champion_, "--noise", robust, "--episodes", "3", "--format", "json"});
  ASSERT_EQ(under_noise.exit_code, 0) << under_noise.err;
  const auto list = io::Json::parse(under_noise.out);
  for (const auto& judged : list[0]["results"]) {
    std::vector<double> distances_m;
    for (std::size_t e = 0; e < 3; ++e) {
      distances_m.push_back(judged["trials"].at(e)["distance_m"]);
      const auto alone = distance({"trial", champion_, "--engine", judged["engine"].get<std::string>(),
                                   "--unseen", std::to_string(e)});
      EXPECT_NEAR(std::stod(alone), distances_m.back(), 0.0005) << judged["engine"];
    }
    std::ranges::sort(distances_m);
    EXPECT_EQ(judged["distance_m"], distances_m[1]) << judged["engine"];
    EXPECT_NE(distances_m[0], distances_m[2]) << "each episode has noise of its own";
  }
}

TEST_F(Compare, SaysByDefaultWhatAChampionTypicallyDoes) {
  const auto compared =
      amble({"compare", champion_, "--engines", "batch", "--trials", "5", "--format", "json"});
  ASSERT_EQ(compared.exit_code, 0) << compared.err;
  const auto row = io::Json::parse(compared.out)[0];
  EXPECT_EQ(row["under"], "under its own noise");
  EXPECT_EQ(row["results"][0]["trials"].size(), 5u);
  // The same trials as those of `amble trial`.
  const auto trial = amble({"trial", champion_, "--trials", "5"});
  EXPECT_THAT(trial.out,
              StartsWith(fmt::format("typically {:.2f} m in 1 s: half of 5 trials under its own noise ",
                                     row["results"][0]["distance_m"].get<double>())));
}

TEST_F(Compare, SaysWhereHalfOfItsTrialsLieIfThereAreEnough) {
  const std::string trial = amble({"trial", champion_, "--trials", "5"}).out;
  const std::string half = "noise ", unit = " m, ";
  const std::size_t begin = trial.find(half) + half.size();
  std::string quartiles = trial.substr(begin, trial.find(unit, begin) - begin);
  quartiles.replace(quartiles.find(" to "), 4, ", ");
  const auto five = amble({"compare", champion_, "--engines", "batch", "--trials", "5"});
  EXPECT_THAT(five.out, HasSubstr(" m [" + quartiles + "]"));
  EXPECT_THAT(five.out, HasSubstr("\nmedian [quartiles] of the trials\n"));
  EXPECT_EQ(five.err, "") << "progress is for those who have to wait";
  EXPECT_THAT(amble({"compare", champion_, "--engines", "batch", "--trials", "3"}).out, Not(HasSubstr("[")));
}

TEST_F(Compare, TheNoiseOfAConfigIsTheSameTrialsInEveryCommand) {
  const auto compared = amble(
      {"compare", champion_, "--engines", "batch", "--noise", robust, "--trials", "3", "--format", "json"});
  ASSERT_EQ(compared.exit_code, 0) << compared.err;
  const auto row = io::Json::parse(compared.out)[0];
  const std::string typical =
      fmt::format("typically {:.2f} m in 1 s: half of 3 trials under the noise of {} ",
                  row["results"][0]["distance_m"].get<double>(), robust);
  for (const char* command : {"trial", "gait"})
    EXPECT_THAT(amble({command, champion_, "--noise", robust, "--trials", "3"}).out, StartsWith(typical))
        << command;
}

TEST_F(Compare, AnEpisodeAskedForByAnOldNameIsToldTheNewOne) {
  const std::string unmet = amble({"trial", champion_, "--unseen", "2"}).out;
  for (const char* name : {"--noise", "--episode"}) {
    const auto old = amble({"trial", champion_, name, "1002"});
    EXPECT_EQ(old.exit_code, 0);
    EXPECT_EQ(old.err,
              std::string(name) + " 1002: for a trial that evolution has not met, now written --unseen 2\n");
    EXPECT_EQ(old.out, unmet);
  }
  const auto met = amble({"trial", champion_, "--noise", "0"});
  EXPECT_EQ(met.err, "--noise 0: for an episode, now written --episode 0\n");
  EXPECT_EQ(met.out, amble({"trial", champion_, "--episode", "0"}).out);
  EXPECT_NE(met.out, unmet);
}

TEST_F(Compare, TheMedianTrialIsWhatGaitViewAndPageShowOfAWalkerEvolvedUnderNoise) {
  const auto gait = amble({"gait", champion_, "--trials", "5"});
  EXPECT_THAT(gait.out, StartsWith("typically "));
  EXPECT_THAT(gait.out, HasSubstr("\nthe gait of the median trial:\n"));
  EXPECT_THAT(amble({"gait", champion_, "--undisturbed"}).out, Not(HasSubstr("typically")));
  const std::string view = scratch_ / "view.html", page = scratch_ / "page.html";
  EXPECT_THAT(amble({"view", champion_, "--trials", "5", "-o", view}).out,
              HasSubstr("its median trial is shown"));
  EXPECT_THAT(slurp(view), HasSubstr(", median trial"));
  EXPECT_EQ(amble({"view", run_, "--static", "--trials", "5", "-o", page}).exit_code, 0);
  EXPECT_THAT(slurp(page), HasSubstr("typically "));
  EXPECT_THAT(slurp(page), HasSubstr("the median of these trials"));
  EXPECT_EQ(amble({"view", run_, "--undisturbed", "-o", view}).exit_code, 0);
  EXPECT_THAT(slurp(view), Not(HasSubstr(", median trial")));
}

TEST(View, AHistoryIsUpToEightChampionsFromFirstToLast) {
  const TemporaryFolder scratch;
  const auto evolved = amble({"evolve", configs + "authors/supg-objective.toml", "--set", "engine=batch",
                              "--set", "population.size=20", "--set", "trial.duration_s=0.5", "--generations",
                              "40", "--out", scratch / "run"});
  ASSERT_EQ(evolved.exit_code, 0) << evolved.err;
  std::vector<std::string> champions;
  for (const auto& file : std::filesystem::directory_iterator(scratch / "run/champions"))
    champions.push_back(file.path().stem());
  std::ranges::sort(champions);
  ASSERT_GT(champions.size(), 1u);
  const auto made = amble({"view", scratch / "run", "--history", "-o", scratch / "h.html"});
  ASSERT_EQ(made.exit_code, 0) << made.err;
  const std::string page = slurp(scratch / "h.html");
  const auto title = [](const std::string& stem) {
    return "\"gen " + std::to_string(std::stoi(stem)) + "\"";
  };
  EXPECT_THAT(page, HasSubstr(title(champions.front())));
  EXPECT_THAT(page, HasSubstr(title(champions.back())));
  std::size_t shown = 0;
  for (const std::string& stem : champions) shown += page.find(title(stem)) != std::string::npos;
  EXPECT_EQ(shown, std::min<std::size_t>(champions.size(), 8));
  EXPECT_THAT(page, HasSubstr("supg-objective (authors): its history"));
  const auto two = amble({"view", scratch / "run", scratch / "run", "--history", "-o", scratch / "two.html"});
  EXPECT_THAT(two.err, HasSubstr("--history: expected one run folder, not 2 inputs"));
}

TEST_F(Compare, LevelsAreKnownByNameAndExcludeOtherNoise) {
  const auto unknown = amble({"trial", champion_, "--level", "nano"});
  EXPECT_EQ(unknown.exit_code, static_cast<int>(ExitCode::bad_input));
  EXPECT_THAT(unknown.err, HasSubstr("level 'nano': expected own or control, micro, 100-micro or milli"));
  EXPECT_EQ(amble({"compare", champion_, "--level", "milli", "--undisturbed"}).exit_code,
            static_cast<int>(ExitCode::bad_input));
  EXPECT_EQ(amble({"compare", champion_, "--noise", robust, "--level", "milli"}).exit_code,
            static_cast<int>(ExitCode::bad_input));
}

TEST_F(Compare, RefusesANoiseThatIsNoneAndEpisodesWithoutNoise) {
  const auto none = amble({"compare", champion_, "--noise", configs + "authors/supg-objective.toml"});
  EXPECT_EQ(none.exit_code, static_cast<int>(ExitCode::bad_input));
  EXPECT_THAT(none.err, HasSubstr("--noise: "));
  EXPECT_THAT(none.err, HasSubstr("is without noise"));
  EXPECT_EQ(amble({"compare", champion_, "--episodes", "3"}).exit_code,
            static_cast<int>(ExitCode::bad_input));
}

TEST_F(Compare, TheRequestedEngineIsShownByViewAndPage) {
  const std::string view = scratch_ / "view.html", page = scratch_ / "page.html";
  EXPECT_EQ(amble({"view", run_, "--engine", "ode", "-o", view}).exit_code, 0);
  EXPECT_THAT(slurp(view), HasSubstr(", in the engine ode"));
  EXPECT_EQ(amble({"page", run_, "--engine", "ode", "-o", page}).exit_code, 0);
  EXPECT_THAT(slurp(page), HasSubstr("as it walks in the engine ode"));
  const auto refused = amble({"view", run_, "--engine", "bullet", "-o", scratch_ / "other.html"});
  EXPECT_EQ(refused.exit_code, static_cast<int>(ExitCode::bad_input));
  EXPECT_THAT(refused.err, HasSubstr("unknown engine 'bullet'"));
}

}  // namespace
}  // namespace amble::tests
