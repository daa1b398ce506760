#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "amble/experiment/problem/episode_set.hpp"
#include "amble/experiment/problem/problem_json.hpp"
#include "amble/experiment/replay.hpp"
#include "amble/experiment/verify.hpp"
#include "amble/ground/recorded.hpp"
#include "amble/io/json_file.hpp"
#include "amble/record/recording.hpp"
#include "amble/robot/pose.hpp"
#include "tests/core/error_of.hpp"
#include "tests/experiment/fixture.hpp"

// Runs on other ground than the plane.
namespace amble::experiment {
namespace {

/// Ground that is new in each generation and grows, with starts anywhere.
Config rough_config(std::vector<std::string> more = {}) {
  std::vector<std::string> all{"engine=batch",     "ground.kind=rough",        "ground.height_m=0.1",
                               "ground.seed=3",    "ground.vary=generations",  "ground.start_place_m=4",
                               "noise.episodes=2", "ground.grow_generations=2"};
  all.insert(all.end(), more.begin(), more.end());
  return small_config(std::move(all));
}

TEST(GroundRun, IsTheSameForAnyNumberOfWorkersAndAfterAnInterruption) {
  const TemporaryFolder scratch;
  Listener listener;
  ASSERT_EQ(Run::start(scratch / "one", rough_config(), 1).execute(listener, listener.stop),
            RunStatus::finished);
  Listener three;
  ASSERT_EQ(Run::start(scratch / "three", rough_config(), 3).execute(three, three.stop), RunStatus::finished);
  Listener first(2), second;
  ASSERT_EQ(Run::start(scratch / "two", rough_config(), 2).execute(first, first.stop),
            RunStatus::interrupted);
  ASSERT_EQ(Run::resume(scratch / "two", {}, 1).execute(second, second.stop), RunStatus::finished);
  const std::string expected = champion_bytes(scratch / "one");
  EXPECT_GT(expected.size(), 1000u);
  EXPECT_TRUE(champion_bytes(scratch / "three") == expected);
  EXPECT_TRUE(champion_bytes(scratch / "two") == expected);
  for (const auto& row : listener.rows) EXPECT_EQ(row.diverged, 0);
}

TEST(GroundRun, HasChampionsThatAreVerifiedOnTheGroundOfTheirGeneration) {
  const TemporaryFolder scratch;
  Listener listener;
  ASSERT_EQ(Run::start(scratch / "run", rough_config(), 1).execute(listener, listener.stop),
            RunStatus::finished);
  const RunPaths paths(scratch / "run");
  const Origin origin = origin_of(paths);
  for (const auto& file : paths.champion_files()) {
    const auto verified = verify_champion(file, unstopped, &origin);
    EXPECT_TRUE(verified->agrees) << verified->text;
    const Champion champion = load_champion(file);
    EXPECT_EQ(champion.problem.ground.kind, "rough");
    EXPECT_EQ(champion.problem.ground_key.generation, static_cast<std::uint32_t>(champion.generation));
    EXPECT_EQ(champion.episodes.size(), 2u);
  }
}

TEST(GroundRun, TestsChampionsOnGroundThatEvolutionHasNotMet) {
  const Problem problem = small_problem(rough_config());
  const trial::ScenarioKey own{.seed = 1, .generation = 2, .episode = 1},
      unseen{1, 2, episode_number(EpisodeSet::unseen, 0)};
  EXPECT_EQ(ground_of(own), ground_of({.seed = 1, .generation = 2, .episode = 0}));
  EXPECT_NE(problem.make_ground(ground_of(own))->surface().heights_m(),
            problem.make_ground(ground_of(unseen))->surface().heights_m());
}

TEST(GroundRun, CountsAFallByTheHeightOverTheGroundBelow) {
  // Hills from −1 to 1 m: robots that start in a hollow have not fallen, and on a hill they still can.
  Problem problem =
      small_problem(small_config({"engine=batch", "ground.kind=hills", "ground.height_m=4",
                                  "ground.length_m=5", "ground.start_place_m=100", "trial.duration_s=0.1"}));
  const auto population = small_population(problem);
  double lowest_m = 0.0, highest_m = 0.0;
  const auto end_height_m = [&](std::uint32_t episode, record::Outcome expected) {
    ReplayOptions options;
    options.noise = {.seed = 4, .generation = 0, .episode = episode};
    const auto trial = replay(problem, population.genomes()[0], options, unstopped);
    EXPECT_EQ(trial->result.outcome, expected) << episode;
    return problem.scenario(*options.noise, problem.make_ground(ground_of(*options.noise)).get())
        .start->root.position_m.z;
  };
  for (std::uint32_t episode = 0; episode < 30; ++episode) {
    const double root_m = end_height_m(episode, record::Outcome::completed);
    lowest_m = std::min(lowest_m, root_m - problem.robot.bodies[0].position_m.z);
    highest_m = std::max(highest_m, root_m - problem.robot.bodies[0].position_m.z);
  }
  EXPECT_LT(lowest_m, -problem.robot.fall_height_m);
  EXPECT_GT(highest_m, problem.robot.fall_height_m);
  problem.robot.fall_height_m = 2.0;  // over any hill
  end_height_m(0, record::Outcome::fell);
}

TEST(GroundRun, RecordsItsGround) {
  const TemporaryFolder scratch;
  const Problem problem = small_problem(rough_config());
  const auto population = small_population(problem);
  ReplayOptions options{.record = scratch / "walk.rec"};
  options.noise = {.seed = 9, .generation = 7, .episode = 1};
  replay(problem, population.genomes()[0], options, unstopped);
  record::RecordingReader reader(scratch / "walk.rec");
  const io::Json json = io::parse_json(reader.header().ground_json, "test");
  const auto ground = problem.make_ground(ground_of(*options.noise));
  EXPECT_EQ(ground::field_from_json(io::JsonView(json, "test")).heights_m(), ground->surface().heights_m());
  std::vector<float> frame;
  ASSERT_TRUE(reader.next(frame));
  const Vec3 start_m = problem.scenario(*options.noise, ground.get()).start->root.position_m;
  EXPECT_NEAR(frame[0], start_m.x, 0.05);
  EXPECT_NEAR(frame[1], start_m.y, 0.05);
}

TEST(GroundRun, LeavesNoTraceInFilesAndIdentityWhereItIsThePlane) {
  const Config config = small_config();
  EXPECT_FALSE(identity_json(config).contains("ground"));
  EXPECT_FALSE(problem_json(small_problem(config)).contains("ground"));
  EXPECT_TRUE(identity_json(small_config({"ground.slope_x=0.1"})).contains("ground"));
}

TEST(GroundRun, TiltsGravityAndChangesFrictionOfItsRobotAlone) {
  const Problem flat = small_problem(),
                slope = small_problem(small_config({"ground.slope_y=0.2", "ground.friction=0.4"}));
  EXPECT_EQ(slope.robot.contact.friction, 0.4);
  EXPECT_NEAR(slope.robot.gravity_m_s2.y, -0.2 * norm(flat.robot.gravity_m_s2) / std::sqrt(1.04), 1e-12);
  EXPECT_EQ(slope.make_ground({}), nullptr);
}

TEST(GroundRun, IsRefusedWhereTheRobotWouldStartInTheGround) {
  try {
    small_problem(small_config({"ground.kind=stones", "ground.height_m=0.5", "ground.start_radius_m=0.1"}));
    FAIL();
  } catch (const UserError& error) {
    EXPECT_NE(std::string(error.what()).find("ground.start_radius_m = 0.1: the robot starts in the ground"),
              std::string::npos)
        << error.what();
  }
}

TEST(GenerationGround, IsMadeAnewOnlyWhenItChanges) {
  const Problem grows = small_problem(small_config({"ground.kind=hills", "ground.grow_generations=2"}));
  GenerationGround ground;
  const auto first = ground.of(grows, 1, 0), second = ground.of(grows, 1, 1), third = ground.of(grows, 1, 2);
  EXPECT_NE(first, second);
  EXPECT_NE(second, third);
  EXPECT_EQ(ground.of(grows, 1, 3), third);
  EXPECT_EQ(ground.of(grows, 1, 300), third);
  const Problem varies = small_problem(rough_config());
  GenerationGround anew;
  const auto one = anew.of(varies, 1, 5);
  EXPECT_EQ(anew.of(varies, 1, 5), one);
  EXPECT_NE(anew.of(varies, 1, 6), one);
}

TEST(GroundRun, TriesChampionsOnTheGroundOfTheirGenerationWithoutNoiseToo) {
  // Without a flat start: robots are dropped onto ground that is another one in each generation.
  const TemporaryFolder scratch;
  Listener listener;
  const Config config =
      small_config({"engine=batch", "drop_m=0.15", "ground.kind=rough", "ground.height_m=0.1",
                    "ground.start_radius_m=0", "ground.vary=generations"});
  ASSERT_EQ(Run::start(scratch / "run", config, 1).execute(listener, listener.stop), RunStatus::finished);
  const RunPaths paths(scratch / "run");
  const Origin origin = origin_of(paths);
  ASSERT_FALSE(paths.champion_files().empty());
  for (const auto& file : paths.champion_files()) {
    const auto verified = verify_champion(file, unstopped, &origin);
    EXPECT_TRUE(verified->agrees) << verified->text;
    // On other ground it goes elsewhere.
    Champion champion = load_champion(file);
    const auto at_home = replay(champion.problem, champion.genome, {}, unstopped);
    ++champion.problem.ground_key.generation;
    const auto elsewhere = replay(champion.problem, champion.genome, {}, unstopped);
    EXPECT_EQ(at_home->result.distance_m, champion.result.distance_m);
    EXPECT_NE(elsewhere->result.distance_m, champion.result.distance_m);
  }
}

TEST(GroundRun, OfAProblemThatWalksOnOtherGroundIsThatOfAProblemMadeForIt) {
  const auto ground_of_case = [](int number) {
    ground::Settings settings;
    settings.slope_x = number % 2 == 0 ? 0.0 : 0.2;
    settings.slope_y = number / 2 % 2 == 0 ? 0.0 : -0.3;
    settings.friction = number / 4 % 2 == 0 ? 0.5 : 0.9;
    settings.kind = number / 8 % 2 == 0 ? "plane" : "hills";
    return settings;
  };
  Config config = small_config();
  for (const int from : {0, 3, 9, 14})
    for (const int to : {0, 2, 5, 11}) {
      config.ground = ground_of_case(from);
      Problem walked = small_problem(config);
      walked.set_ground(ground_of_case(to));
      config.ground = ground_of_case(to);
      const Problem made = small_problem(config);
      EXPECT_NEAR(norm(walked.robot.gravity_m_s2 - made.robot.gravity_m_s2), 0.0, 1e-12) << from << " " << to;
      EXPECT_EQ(walked.robot.contact.friction, made.robot.contact.friction);
      EXPECT_EQ(io::settings_to_json(walked.ground), io::settings_to_json(config.ground));
      EXPECT_EQ(walked.make_ground({}) == nullptr, made.make_ground({}) == nullptr);
    }
}

TEST(GroundRun, AProblemWhoseChangeIsRefusedIsWhatItWas) {
  Problem problem = small_problem(small_config({"ground.friction=0.5"}));
  const std::string before = problem_json(problem).dump();
  ground::Settings stones;
  stones.kind = "stones";
  stones.height_m = 0.5;
  stones.start_radius_m = 0.1;
  stones.slope_x = 0.3;
  stones.friction = 0.7;
  EXPECT_THROW(problem.set_ground(stones), UserError);
  EXPECT_EQ(problem_json(problem).dump(), before);
  EXPECT_THROW(problem.set_damage({{{.kind = damage::Kind::missing, .leg = "no such leg"}}}), UserError);
  EXPECT_EQ(problem_json(problem).dump(), before);
  EXPECT_THROW(problem.set_differential({.turn_gain = 1.0}), UserError) << "nothing is commanded";
  EXPECT_EQ(problem_json(problem).dump(), before);
}

TEST(GroundRun, MayBeginAsDeepInTheGroundAsOnThePlane) {
  // Feet that sink in by less than a centimetre are no mistake of the ground's.
  const Config config = small_config({"ground.kind=hills", "drop_m=0"});
  robot::RobotSpec robot = load_robot_file(config.robot);
  robot.bodies[0].position_m.z -= robot::clearance_m(robot, robot::start_poses(robot)) + 0.009;
  EXPECT_NO_THROW(Problem::make(config, robot));
}

TEST(GroundRun, ThatGrowsIsRefusedWhereAllGenerationsHaveTheGroundOfTheFirst) {
  EXPECT_THAT(
      tests::error_of([] {
        small_config({"ground.kind=hills", "ground.grow_generations=2", "evaluation.draw=once"}).validate();
      }),
      testing::HasSubstr("would never grow"));
}

}  // namespace
}  // namespace amble::experiment
