#include <gtest/gtest.h>

#include <algorithm>

#include "amble/experiment/problem/problem_json.hpp"
#include "amble/experiment/replay.hpp"
#include "amble/experiment/verify.hpp"
#include "amble/record/recording.hpp"
#include "amble/robot/json.hpp"
#include "tests/experiment/fixture.hpp"

// Runs and trials of damaged robots.
namespace amble::experiment {
namespace {

std::string damage(const std::string& parts) {
  return "damage.parts=[" + parts + "]";
}
const std::string no_leg = R"({kind="missing",leg="BR"})",
                  no_leg_later = R"({kind="missing",leg="BR",from_s=0.3})",
                  numb_foot = R"({kind="numb",leg="FL"})",
                  load = R"({kind="payload",mass_kg=1,y_m=0.1,from_s=0.5})";

TEST(DamageRun, IsTheSameForAnyNumberOfWorkersAndAfterAnInterruptionAndIsVerified) {
  const TemporaryFolder scratch;
  const Config config = small_config({"engine=batch", damage(no_leg_later + "," + numb_foot + "," + load),
                                      "noise.episodes=2", "noise.push_m_s=0.2", "noise.start_tilt_rad=0.05"});
  Listener one, three, first(2), second;
  ASSERT_EQ(Run::start(scratch / "one", config, 1).execute(one, one.stop), RunStatus::finished);
  ASSERT_EQ(Run::start(scratch / "three", config, 3).execute(three, three.stop), RunStatus::finished);
  ASSERT_EQ(Run::start(scratch / "two", config, 2).execute(first, first.stop), RunStatus::interrupted);
  ASSERT_EQ(Run::resume(scratch / "two", {}, 1).execute(second, second.stop), RunStatus::finished);
  const std::string expected = champion_bytes(scratch / "one");
  EXPECT_GT(expected.size(), 1000u);
  EXPECT_TRUE(champion_bytes(scratch / "three") == expected);
  EXPECT_TRUE(champion_bytes(scratch / "two") == expected);
  const RunPaths paths(scratch / "one");
  const Origin origin = origin_of(paths);
  for (const auto& file : paths.champion_files()) {
    const auto verified = verify_champion(file, unstopped, &origin);
    EXPECT_TRUE(verified->agrees) << verified->text;
    EXPECT_EQ(load_champion(file).problem.damage.parts.size(), 3u);
  }
}

TEST(DamageRun, LeavesIdentityAndChampionsOfIntactRobotsAsTheyWere) {
  EXPECT_FALSE(identity_json(small_config()).contains("damage"));
  EXPECT_TRUE(identity_json(small_config({damage(no_leg)})).contains("damage"));
  EXPECT_FALSE(problem_json(small_problem()).contains("damage"));
  const Problem damaged = small_problem(small_config({damage(no_leg)}));
  EXPECT_TRUE(problem_json(damaged).contains("damage"));
  EXPECT_EQ(problem_json(damaged).at("robot"), problem_json(small_problem()).at("robot")) << "intact";
}

TEST(DamageRun, ANumbFootTriggersNoSupg) {
  const Problem intact = small_problem(small_config({"engine=batch", "trial.duration_s=5"}));
  const auto genome = small_population(intact).genomes()[0];
  const auto triggers = [&](const damage::Settings& damage) {
    Problem problem = intact;
    problem.set_damage(damage);
    const auto events = replay(problem, genome, {}, unstopped)->events;
    std::vector<std::int64_t> counts;
    for (const auto& [name, count] : events)
      if (name.starts_with("trigger.")) counts.push_back(count);
    return counts;
  };
  const auto before = triggers({});
  ASSERT_EQ(before.size(), 4u);
  for (std::size_t leg = 0; leg < 4; ++leg) {
    const damage::Part numb{.kind = damage::Kind::numb, .leg = intact.robot.legs[leg].name};
    EXPECT_EQ(triggers({{numb}})[leg], 0) << leg;
    damage::Part late = numb;
    late.from_s = 1000.0;
    EXPECT_EQ(triggers({{late}}), before);
  }
  EXPECT_GT(*std::ranges::max_element(before), 0);
}

TEST(DamageRun, OfWhatTheRobotDoesNotHaveIsRefusedWithItsPlace) {
  try {
    small_problem(small_config({damage(R"({kind="slack",joint="elbow"})")}));
    FAIL() << "accepted";
  } catch (const UserError& error) {
    const std::string text = error.what();
    EXPECT_NE(text.find("damage.parts[0].joint = \"elbow\": the robot has no such joint"), std::string::npos)
        << text;
    EXPECT_NE(text.find(": damage."), std::string::npos) << "where it was set: " << text;
  }
}

TEST(DamageRun, IsRecordedBesideTheIntactRobot) {
  const TemporaryFolder scratch;
  const Problem problem = small_problem(small_config({"engine=batch", damage(no_leg)}));
  const auto genome = small_population(problem).genomes()[0];
  ASSERT_TRUE(replay(problem, genome, {.record = scratch / "a.rec"}, unstopped));
  const record::RecordingReader reader(scratch / "a.rec");
  EXPECT_NE(reader.header().damage_json.find("missing"), std::string::npos);
  const robot::RobotSpec drawn = robot::parse_robot(reader.header().robot_json, "recording");
  ASSERT_EQ(drawn.legs.size(), 4u);
  for (std::size_t g = 0; g < drawn.geoms.size(); ++g) {
    const bool missing = drawn.leg_of_body(drawn.geoms[g].body) == 3;
    EXPECT_EQ(drawn.geoms[g].rgba[3] < problem.robot.geoms[g].rgba[3], missing) << "only BR is pale";
  }
  const Problem intact = small_problem(small_config({"engine=batch"}));
  ASSERT_TRUE(replay(intact, genome, {.record = scratch / "b.rec"}, unstopped));
  EXPECT_TRUE(record::RecordingReader(scratch / "b.rec").header().damage_json.empty());
}

TEST(DamageRun, WorksWithEveryNoiseAndEveryEngine) {
  auto settings = all_noise();
  settings.push_back(damage(no_leg + R"(,{kind="slack",joint=")" + small_problem().robot.joints[0].name +
                            R"(",from_s=0.2},)" + load));
  Problem problem = small_problem(small_config(settings));
  const auto genome = small_population(problem).genomes()[0];
  for (const char* name : {"ode", "batch", "mujoco"}) {
    problem.engine = name;
    const ReplayOptions how{.noise = trial::ScenarioKey{.seed = 1, .generation = 2, .episode = 3}};
    const auto once = replay(problem, genome, how, unstopped),
               again = replay(problem, genome, how, unstopped);
    EXPECT_NE(once->result.outcome, record::Outcome::diverged) << name;
    EXPECT_EQ(once->trace, again->trace) << name;
  }
}

}  // namespace
}  // namespace amble::experiment
