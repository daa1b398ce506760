#include "amble/experiment/verify.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "amble/experiment/replay.hpp"
#include "amble/io/file.hpp"
#include "tests/experiment/fixture.hpp"

namespace amble::experiment {
namespace verify_test {

using testing::HasSubstr;
using testing::StartsWith;

const std::atomic<bool> never{false};

class Verify : public testing::Test {
 protected:
  Verify() {
    champion_.genome = small_population(champion_.problem).genomes()[0];
    const auto trial = replay(champion_.problem, champion_.genome, {}, never);
    champion_.result = trial->result;
    champion_.trace = trial->trace;
  }

  Verification verification() {
    io::write_file(path_, champion_text(champion_));
    return verify_champion(path_, never).value();
  }

  TemporaryFolder scratch_;
  std::filesystem::path path_ = scratch_ / "c.json";
  Champion champion_{.experiment = "test",
                     .seed = 1,
                     .generation = 0,
                     .index = 0,
                     .problem = small_problem(),
                     .genome = {},
                     .result = {},
                     .trace = {},
                     .episodes = {}};
};

TEST_F(Verify, AgreesWithAnHonestChampion) {
  const auto found = verification();
  EXPECT_TRUE(found.agrees) << found.text;
  EXPECT_THAT(found.text, StartsWith("agrees: "));
}

TEST_F(Verify, RunsTheEpisodesOfAChampionAgainUnderTheirNoise) {
  champion_.problem = noisy_problem();
  for (std::size_t i = 0; i < 2; ++i) {
    ReplayOptions options;
    options.noise = champion_.scenario_key(i);
    const auto trial = replay(champion_.problem, champion_.genome, options, never);
    champion_.episodes.push_back({trial->result, trial->trace});
  }
  EXPECT_NE(champion_.episodes[0].trace, champion_.trace) << "noise is felt";
  EXPECT_NE(champion_.episodes[0].trace, champion_.episodes[1].trace);
  EXPECT_THAT(verification().text, HasSubstr("; under noise "));
  EXPECT_TRUE(verification().agrees);

  champion_.episodes[1].trace[4] ^= 1;
  EXPECT_EQ(verification().text, "differs: under noise 1: first differing step 5 (t = 0.05 s)");
  champion_.episodes[1].trace[4] ^= 1;
  ++champion_.generation;
  EXPECT_THAT(verification().text, StartsWith("differs: under noise 0: first differing step 1 "))
      << "noise of another generation";
}

TEST_F(Verify, KnowsWhichGenerationsOfTheRunHaveAChampion) {
  // Only one that is better than all before it.
  champion_.generation = 2;
  path_ = scratch_ / "00002.json";
  io::write_file(path_, champion_text(champion_));
  const double own = champion_.objective();
  Origin origin{.config = small_config(), .problem = small_problem()};
  const auto text = [&](double first, double second, double third) {
    origin.table.generation = {0, 1, 2, 3};
    origin.table.best = {first, second, third, own + 2.0};
    return verify_champion(path_, never, &origin).value().text;
  };
  for (const double less : {0.0, std::nextafter(own, 0.0)}) {
    EXPECT_THAT(text(less, 0.0, own), StartsWith("agrees: "));
    EXPECT_THAT(text(0.0, less, own), StartsWith("agrees: "));
  }
  EXPECT_THAT(text(0.0, 0.0, std::nextafter(own, 0.0)), HasSubstr("it reached "));
  for (const double not_less : {own, std::nextafter(own, 2.0 * own), own + 1.0}) {
    EXPECT_EQ(text(not_less, 0.0, own), "differs: the run kept no champion of its generation");
    EXPECT_EQ(text(0.0, not_less, own), "differs: the run kept no champion of its generation");
  }
  origin.table.generation.resize(2);
  origin.table.best.resize(2);
  EXPECT_THAT(verify_champion(path_, never, &origin).value().text, StartsWith("agrees: "))
      << "ahead of the run's table";
}

TEST_F(Verify, NamesTheFirstStepThatDiffers) {
  champion_.trace[41] ^= 1;
  const auto found = verification();
  EXPECT_FALSE(found.agrees);
  EXPECT_EQ(found.text, "differs: first differing step 42 (t = 0.42 s)");
}

TEST_F(Verify, NamesAnotherDistance) {
  champion_.result.distance_m = 123.0;
  EXPECT_THAT(verification().text, HasSubstr("distance 123 m recorded"));
}

TEST_F(Verify, NamesAnotherEnd) {
  ASSERT_TRUE(verification().agrees);
  const TrialResult own = champion_.result;
  for (const record::Outcome outcome :
       {record::Outcome::completed, record::Outcome::fell, record::Outcome::diverged}) {
    champion_.result.outcome = outcome;
    EXPECT_EQ(verification().agrees, outcome == own.outcome);
  }
  champion_.result = own;
  ++champion_.result.steps;
  EXPECT_THAT(verification().text, HasSubstr("steps recorded"));
}

TEST_F(Verify, NamesAnotherScore) {
  champion_.problem.score.terms = {{.quantity = "uprightness"}};
  champion_.result = replay(champion_.problem, champion_.genome, {}, never)->result;
  EXPECT_TRUE(verification().agrees);
  champion_.result.score = champion_.result.score.value() + 0.25;
  EXPECT_THAT(verification().text, HasSubstr("score "));
}

TEST_F(Verify, SeesAGenomeThatIsNotTheOneThatWalked) {
  champion_.genome = small_population(champion_.problem).genomes()[1];
  EXPECT_THAT(verification().text, HasSubstr("first differing step"));
}

TEST_F(Verify, CallsADamagedFileUnsound) {
  io::write_file(path_, champion_text(champion_).substr(0, 500));
  const auto found = verify_champion(path_, never).value();
  EXPECT_FALSE(found.agrees);
  EXPECT_THAT(found.text, StartsWith("unsound: "));
}

}  // namespace verify_test
}  // namespace amble::experiment
