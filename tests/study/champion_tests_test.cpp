#include "amble/study/champion_tests.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <optional>
#include <set>

#include "amble/experiment/gait_observer.hpp"
#include "amble/experiment/replay.hpp"
#include "amble/gait/recorded_gait.hpp"
#include "amble/io/file.hpp"
#include "amble/ledger/measures.hpp"
#include "amble/record/levels.hpp"
#include "amble/score/walking.hpp"
#include "tests/study/fixture.hpp"

namespace amble::study {
namespace {

const std::atomic<bool> never{false};

/// A champion of a small run under the noise of the preset `robust`, of two episodes.
const experiment::Champion& champion() {
  static const experiment::Champion made = [] {
    const test::TemporaryFolder folder;
    auto study = small_study({"noise.episodes=2"});
    study.conditions = {condition("supg", "robust/supg-objective")};
    Notes notes;
    work_on(study, folder.path(), notes);
    return champion_from_json(notes.records.at(0).champion, "record");
  }();
  return made;
}

ledger::TestResult tested(const ledger::TestSpec& spec) {
  PlannedTest test{.spec = spec, .noise = {}};
  if (!spec.noise.empty()) {
    test.noise = experiment::load_config(spec.noise, {}).noise;
    test.noise.first_undisturbed = false;
  }
  return run_test(test, champion(), never).value();
}

experiment::TrialResult replayed(double seconds, std::optional<trial::ScenarioKey> noise = {}) {
  auto problem = champion().problem;
  problem.noise.first_undisturbed = false;
  return experiment::replay(problem, champion().genome, {.seconds = seconds, .noise = noise}, never)->result;
}

TEST(ChampionTest, WithoutNoiseIsTheChampionsOwnTrialOfAnotherLength) {
  for (const double seconds : {1.0, 6.0}) {
    const auto result = tested(trial_test("t", seconds));
    ASSERT_EQ(result.episodes.size(), 1u);
    const auto expected = replayed(seconds);
    EXPECT_EQ(result.episodes[0].distance_m, expected.distance_m);
    EXPECT_EQ(result.episodes[0].seconds, expected.seconds);
    EXPECT_EQ(result.episodes[0].outcome, expected.outcome);
    EXPECT_LE(result.episodes[0].walking_s, expected.seconds);
    EXPECT_EQ(result.engine, "batch");
    EXPECT_EQ(result.trial_s, seconds);
  }
}

TEST(ChampionToJson, IsReadByLedgersAsTheChampionSays) {
  experiment::Champion walker = champion();
  const auto recorded = [&walker] {
    ledger::Record record;
    record.champion = champion_to_json(walker);
    return record;
  };
  EXPECT_EQ(ledger::evolution_trial_s(recorded()), walker.problem.trial.duration_s);
  EXPECT_FALSE(ledger::evolved_undisturbed(recorded())) << "evolved under noise";
  EXPECT_EQ(ledger::objective_of(recorded()), score::objective_of(walker.problem.score));
  EXPECT_EQ(ledger::score_of(recorded()), "");
  walker.episodes.clear();
  EXPECT_TRUE(ledger::evolved_undisturbed(recorded()));
  walker.problem.ground.kind = "hills";
  EXPECT_FALSE(ledger::evolved_undisturbed(recorded()));
  walker.problem.score.terms = {{.quantity = "economy"}};
  EXPECT_EQ(ledger::objective_of(recorded()), score::objective_of(walker.problem.score));
  EXPECT_NE(ledger::score_of(recorded()), "");
}

TEST(GaitObserver, MeasuresWhatIsMeasuredOfTheRecording) {
  const test::TemporaryFolder folder;
  const auto& problem = champion().problem;
  experiment::GaitObserver gait(problem, {});
  const auto replay =
      experiment::replay(problem, champion().genome,
                         {.seconds = 6.0, .record = folder.path() / "a.rec", .observer = &gait}, never);
  const gait::Report seen = gait.finish(replay->result.outcome),
                     recorded = gait::recorded_gait(folder.path() / "a.rec", {});
  // A recording has numbers of 24 bits.
  EXPECT_NEAR(seen.distance_m, recorded.distance_m, 1e-6);
  EXPECT_NEAR(seen.path_m, recorded.path_m, 1e-6);
  EXPECT_GT(recorded.path_m, 0.1);
  EXPECT_EQ(seen.duty_factor, recorded.duty_factor);
  ASSERT_EQ(seen.legs.size(), recorded.legs.size());
  for (std::size_t leg = 0; leg < seen.legs.size(); ++leg)
    EXPECT_EQ(seen.legs[leg].raw_touchdowns, recorded.legs[leg].raw_touchdowns);
}

TEST(ChampionTest, UnderNoiseMeetsWhatEvolutionHasNotMet) {
  const auto result = tested(trial_test("t", 1.0, config_file("robust/supg-objective"), 6));
  ASSERT_EQ(result.episodes.size(), 6u);
  std::set<double> met{replayed(1.0).distance_m};
  for (std::uint32_t episode = 0; episode < 100; ++episode)
    met.insert(replayed(1.0, champion().scenario_key(episode)).distance_m);
  EXPECT_GT(met.size(), 90u) << "noise tells episodes apart";
  for (const auto& episode : result.episodes)
    EXPECT_TRUE(met.insert(episode.distance_m).second) << "neither those of evolution nor one another's";
}

TEST(ChampionTest, OnGroundOfItsOwnMeetsPlacesThatEvolutionHasNotMetAndNoNoise) {
  const auto on_stones = [](double height_m, int episodes) {
    PlannedTest test{.spec = trial_test("t", 3.0), .noise = {}};
    test.spec.episodes = episodes;
    test.ground.emplace();
    test.ground->kind = "stones";
    test.ground->height_m = height_m;
    test.ground->start_place_m = 2.0;
    return run_test(test, champion(), never).value();
  };
  std::set<double> distances_m;
  for (const auto& episode : on_stones(0.2, 5).episodes) distances_m.insert(episode.distance_m);
  EXPECT_EQ(distances_m.size(), 5u);
  // Level ground is the plane, but for rounding: no noise is left.
  const double expected_m = replayed(0.3).distance_m;
  PlannedTest brief{.spec = trial_test("t", 0.3), .noise = {}};
  brief.ground.emplace();
  brief.ground->kind = "stones";
  brief.ground->height_m = 0.0;
  EXPECT_NEAR(run_test(brief, champion(), never)->episodes[0].distance_m, expected_m, 0.002);
}

TEST(ChampionTest, WithoutGroundOfItsOwnStartsAnywhereOnThatOfTheChampion) {
  experiment::Champion rough = champion();
  rough.problem.noise = {};
  ground::Settings ground;
  ground.kind = "stones";
  ground.height_m = 0.1;
  ground.start_place_m = 2.0;
  rough.problem.set_ground(ground);
  const PlannedTest test{.spec = trial_test("t", 2.0, "", 3), .noise = {}};
  const auto result = run_test(test, rough, never);
  ASSERT_EQ(result->episodes.size(), 3u);
  std::set<double> distances_m;
  for (std::size_t episode = 0; episode < 3; ++episode) {
    const auto expected = experiment::replay(
        rough.problem, rough.genome, {.seconds = 2.0, .noise = rough.unseen_scenario_key(episode)}, never);
    EXPECT_EQ(result->episodes[episode].distance_m, expected->result.distance_m);
    distances_m.insert(expected->result.distance_m);
  }
  EXPECT_EQ(distances_m.size(), 3u);
  // The path is counted from where the trial starts.
  ASSERT_EQ(result->episodes[0].seconds, 2.0);
  ASSERT_EQ(result->path_m.size(), 4u);
  EXPECT_NEAR(std::hypot(result->path_m[2], result->path_m[3]), result->episodes[0].distance_m, 0.001);
}

TEST(ChampionTest, OfADamagedRobotIsTheTrialOfThatRobot) {
  PlannedTest test{.spec = trial_test("t", 3.0), .noise = {}};
  test.damage.emplace().parts = {
      {.kind = damage::Kind::missing, .leg = champion().problem.robot.legs[0].name}};
  auto problem = champion().problem;
  problem.set_damage(*test.damage);
  const auto expected = experiment::replay(problem, champion().genome, {.seconds = 3.0}, never)->result;
  EXPECT_EQ(run_test(test, champion(), never)->episodes[0].distance_m, expected.distance_m);
  EXPECT_NE(expected.distance_m, replayed(3.0).distance_m);
}

TEST(ChampionTest, SteeredByHandIsTheTrialOfThatWalkerAndMeasuresItsCost) {
  PlannedTest test{.spec = trial_test("t", 6.0), .noise = {}};
  test.spec.command = "0.4,0.5";
  test.spec.energy = true;
  test.command = {.kind = trial::CommandKind::fixed, .stretches = {{0.4, 0.5}}};
  test.steering = experiment::HandSteering{{.turn_gain = 1.0, .full_speed_m_s = 0.4}};
  auto problem = champion().problem;
  problem.set_commands(*test.command);
  experiment::steer_by_hand(problem, *test.steering);
  const auto expected = experiment::replay(problem, champion().genome, {.seconds = 6.0}, never)->result;
  const auto result = run_test(test, champion(), never);
  EXPECT_EQ(result->episodes[0].distance_m, expected.distance_m);
  EXPECT_NE(expected.distance_m, replayed(6.0).distance_m);
  ASSERT_TRUE(result->episodes[0].obeyed && result->episodes[0].spent);
  EXPECT_GT(result->episodes[0].spent->energy_j, 0.0);
  EXPECT_NEAR(result->episodes[0].spent->weight_n, problem.weight_n(), 1e-3);
  // From second to second as the path of the record has it.
  double way_m = 0.0, x_m = 0.0, y_m = 0.0;
  for (std::size_t i = 0; i + 1 < result->path_m.size(); i += 2) {
    way_m += std::hypot(result->path_m[i] - x_m, result->path_m[i + 1] - y_m);
    x_m = result->path_m[i];
    y_m = result->path_m[i + 1];
  }
  EXPECT_NEAR(result->episodes[0].spent->way_m, way_m, 0.02);
  test.spec.energy = false;
  EXPECT_FALSE(run_test(test, champion(), never)->episodes[0].spent);
}

TEST(ChampionTest, IsScoredAsInEvolutionWhereItIsAsked) {
  PlannedTest test{.spec = trial_test("t", 6.0), .noise = {}};
  EXPECT_FALSE(run_test(test, champion(), never)->episodes[0].score);
  test.spec.score = true;
  const auto walked = run_test(test, champion(), never)->episodes[0];
  ASSERT_EQ(walked.outcome, record::Outcome::completed);
  EXPECT_NEAR(walked.score.value(), walked.distance_m, 6e-4) << "whose score is the distance";

  experiment::Champion other = champion();
  other.problem.score.terms = {{.quantity = "upright_time", .weight = 10.0}};
  EXPECT_EQ(run_test(test, other, never)->episodes[0].score, 10.0);
  other.problem.robot.fall_height_m = 100.0;
  other.problem.trial.fall_factor = 0.0;
  const auto fell = run_test(test, other, never)->episodes[0];
  ASSERT_EQ(fell.outcome, record::Outcome::fell);
  EXPECT_EQ(fell.score, 0.0);
}

TEST(ChampionTest, MeasuresTheSeamOfItsFirstTrialWhereItIsAsked) {
  PlannedTest test{.spec = trial_test("t", 6.0), .noise = {}};
  EXPECT_FALSE(run_test(test, champion(), never)->seam);
  test.spec.seam = true;
  const auto result = run_test(test, champion(), never);
  ASSERT_TRUE(result->seam);
  EXPECT_GT(result->seam->jumps, 0);
  EXPECT_GT(result->seam->mean_rad, 0.0);
  EXPECT_GE(result->seam->largest_rad, result->seam->mean_rad);
  EXPECT_GT(result->seam->power_w, 0.0);
}

TEST(ChampionTest, SamplesItsFirstTrialsPathInMillimetresEverySecondOrThreeHundredTimes) {
  const auto brief = tested(trial_test("t", 6.0));
  EXPECT_EQ(brief.path_interval_s, 1.0);
  const double lasted_s = brief.episodes[0].seconds;
  ASSERT_EQ(brief.path_m.size(), 2 * static_cast<std::size_t>(lasted_s + 1e-9));
  for (const double value : brief.path_m) EXPECT_NEAR(1000.0 * value, std::round(1000.0 * value), 1e-6);
  EXPECT_EQ(tested(trial_test("t", 300.0)).path_interval_s, 1.0);
  EXPECT_EQ(tested(trial_test("t", 301.0)).path_interval_s, 2.0);
}

TEST(ChampionTest, ShowsGaitAndPathOfTheFirstOfItsEpisodes) {
  const auto noise = config_file("robust/supg-objective");
  const auto one = tested(trial_test("t", 8.0, noise, 1)), four = tested(trial_test("t", 8.0, noise, 4));
  ASSERT_EQ(four.episodes.size(), 4u);
  EXPECT_EQ(four.episodes[0], one.episodes[0]);
  EXPECT_EQ(four.path_m, one.path_m);
  EXPECT_EQ(four.gait, one.gait);
}

TEST(ChampionTest, OfManyEpisodesIsToTheBitWhatTheyAreOneByOne) {
  // More episodes than the engine has lanes, and some that end early.
  PlannedTest test{.spec = trial_test("t", 8.0, "", 37), .noise = {}};
  test.noise = trial::noise_of(*record::find_level("milli"));
  const auto together = run_test(test, champion(), never);
  ASSERT_EQ(together->episodes.size(), 37u);
  experiment::Problem problem = champion().problem;
  problem.noise = test.noise;
  std::set<double> distances_m;
  for (std::size_t episode = 0; episode < 37; ++episode) {
    const auto alone =
        experiment::replay(problem, champion().genome,
                           {.seconds = 8.0, .noise = champion().unseen_scenario_key(episode)}, never);
    EXPECT_EQ(together->episodes[episode].distance_m, alone->result.distance_m) << episode;
    EXPECT_EQ(together->episodes[episode].seconds, alone->result.seconds) << episode;
    distances_m.insert(alone->result.distance_m);
  }
  EXPECT_EQ(distances_m.size(), 37u) << "episodes differ";
}

/// Walking time by the centre of mass after each step.
class Walk : public trial::Observer {
 public:
  void on_step(int, const physics::Engine& engine, const controllers::Batch&, const LaneArray&,
               int lane) override {
    const Vec3 com_m = engine.com_m(lane);
    if (!meter_) meter_.emplace(com_m, champion().problem.trial.timestep_s);
    meter_->add(com_m);
  }
  double walking_s() const { return meter_->walking_s(); }

 private:
  std::optional<score::WalkingMeter> meter_;
};

TEST(ChampionTest, MeasuresHowLongTheRobotWalks) {
  Walk walk;
  const auto replay =
      experiment::replay(champion().problem, champion().genome, {.seconds = 30.0, .observer = &walk}, never);
  const auto result = tested(trial_test("t", 30.0));
  EXPECT_LT(walk.walking_s(), replay->result.seconds) << "for some of the time it does not";
  EXPECT_EQ(result.episodes[0].walking_s, walk.walking_s());
}

TEST(ChampionTest, IsGivenUpWhenStopped) {
  const std::atomic<bool> stopped{true};
  EXPECT_FALSE(run_test({.spec = trial_test("t", 1.0), .noise = {}}, champion(), stopped));
}

/// ODE calls libm, whose variants for other processors change the last digits: at the end of these trials by
/// up to 5e-6 m.
TEST(ChampionsThatEvolvedInOde, StillWalkAsFarAsTheirRecordsSay) {
  int champions = 0;
  for (const auto& entry : std::filesystem::directory_iterator(AMBLE_SOURCE_DIR "/results/ode/ledger")) {
    const auto name = entry.path().filename().string();
    const auto record = ledger::parse_record(io::read_file(entry.path()), name);
    const auto walker = champion_from_json(record.champion, name);
    const auto trial = experiment::replay(walker.problem, walker.genome, {.engine = "ode"}, never);
    ASSERT_TRUE(trial);
    EXPECT_NEAR(trial->result.distance_m, record.best_objective, 1e-4) << name;
    ++champions;
  }
  EXPECT_EQ(champions, 9);
}

}  // namespace
}  // namespace amble::study
