#include <gtest/gtest.h>
#include <hwy/highway.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "amble/controllers/supg.hpp"
#include "amble/experiment/replay.hpp"
#include "amble/io/file.hpp"
#include "amble/record/recording.hpp"
#include "amble/score/score.hpp"
#include "tests/experiment/fixture.hpp"

// Whole generations and runs in the batch engine.
namespace amble::experiment {
namespace {

const std::atomic<bool> never{false};

Problem batch_problem(std::vector<std::string> more = {}) {
  more.push_back("engine=batch");
  return small_problem(small_config(std::move(more)));
}

/// Instruction sets for vectors of 16, 8, 4 and 1 robots; as many of them as this machine has.
std::vector<std::int64_t> instruction_sets() {
  std::vector<std::int64_t> sets;
  for (const std::int64_t set : {std::int64_t{HWY_AVX3}, std::int64_t{HWY_AVX2}})
    if ((hwy::SupportedTargets() & set) != 0) sets.push_back(set);
  return sets;
}

/// Kinds of controllers whose loops over the lanes are their own, and what they obey.
struct Kind {
  std::string name;
  std::vector<std::string> settings;
};
void PrintTo(const Kind& kind, std::ostream* out) {
  *out << kind.name;
}
std::vector<Kind> all_kinds() {
  const std::string modulation = "controller.supg.modulation.", told = "command.kind=random",
                    soon = "command.stretch_s=0.4", automatic = "controller.substrate=auto";
  return {
      {"supg", {}},
      {"modulated",
       {told, soon, modulation + "rate=1", modulation + "shape=1", modulation + "load_feedback=1",
        modulation + R"(sensors=["command_turn","heading_error","pitch","torque.knee"])",
        "controller.supg.seam.residual_s=0.05",
        R"(controller.sensing.sensors=[{of="pitch",noise=0.02,delay_s=0.03},{of="touch",dead_time_s=0.03}])"}},
      {"by_torque",
       {told, soon, "controller.supg.contact.source=torque", "controller.supg.contact.threshold=3",
        modulation + "rate=1", modulation + R"(sensors=["command_speed","yaw_rate"])"}},
      {"mixed",
       {told, soon, automatic, "controller.kind=mixed", "controller.supg.idle=wrap",
        R"(controller.sensing.sensors=[{of="heading_error",noise=0.05,delay_s=0.05}])"}},
      {"ctrnn",
       {told, soon, automatic, "controller.kind=ctrnn", "controller.ctrnn.state=kept",
        R"(controller.ctrnn.sensors=["command_speed","command_turn","heading_error","yaw_rate","load"])"}}};
}
std::string name_of(const testing::TestParamInfo<Kind>& info) {
  return info.param.name;
}

class BatchRun : public testing::TestWithParam<Kind> {};
INSTANTIATE_TEST_SUITE_P(Each, BatchRun, testing::ValuesIn(all_kinds()), name_of);

/// A whole run's champions, archive and table without its times.
std::string small_run(const std::filesystem::path& folder, int jobs, std::vector<std::string> settings) {
  Listener listener;
  settings.insert(settings.end(), {"engine=batch", "noise.push_m_s=0.2"});
  const auto config = small_novelty_config(std::move(settings));
  EXPECT_EQ(Run::start(folder, config, jobs).execute(listener, listener.stop), RunStatus::finished);
  const RunPaths paths(folder);
  std::string all = io::read_file(folder / "archive.bin");
  for (const auto& file : paths.champion_files()) all += io::read_file(file);
  for (auto row : listener.rows) {
    row.wall_s = 0.0;
    row.times = {};
    all += csv_line(row, csv_header(row.search));
  }
  return all;
}

TEST_P(BatchRun, GivesTheSameBytesOnEveryInstructionSet) {
  const TemporaryFolder scratch;
  const std::string best = small_run(scratch / "best", 2, GetParam().settings);
  EXPECT_GT(best.size(), 1000u);
  for (const std::int64_t set : instruction_sets()) {
    hwy::SetSupportedTargetsForTest(set);
    EXPECT_TRUE(small_run(scratch / hwy::TargetName(set), 1, GetParam().settings) == best)
        << hwy::TargetName(set);
  }
  hwy::SetSupportedTargetsForTest(0);
}

class BatchOfKind : public testing::TestWithParam<Kind> {};
INSTANTIATE_TEST_SUITE_P(Each, BatchOfKind, testing::ValuesIn(all_kinds()), name_of);

TEST_P(BatchOfKind, GivesEachGenomeWhatItGetsAloneWhateverTheirOrderAndTheWorkers) {
  auto settings = all_noise();
  settings.insert(settings.end(), GetParam().settings.begin(), GetParam().settings.end());
  const auto problem = batch_problem(settings);
  const auto population = small_population(problem);
  const auto scenarios = problem.scenarios(1, 2);
  std::vector<neat::Genome> backwards(population.genomes().rbegin(), population.genomes().rend());
  Evaluator evaluator(problem, {.stride = 5}, 2);
  const auto forth = evaluator.evaluate(population.genomes(), never, scenarios);
  const auto back = Evaluator(problem, {.stride = 5}, 3).evaluate(backwards, never, scenarios);
  for (std::size_t i = 0; i < backwards.size(); ++i) {
    for (std::uint32_t episode = 0; episode < 2; ++episode) {
      const auto& one = forth->of_genome(i)[episode];
      EXPECT_EQ(one.com_path_m, back->of_genome(backwards.size() - 1 - i)[episode].com_path_m) << i;
      if (i % 8 != 0) continue;
      ReplayOptions options;
      options.noise = trial::ScenarioKey{.seed = 1, .generation = 2, .episode = episode};
      const auto alone = replay(problem, population.genomes()[i], options, never);
      EXPECT_EQ(score::distance_m(one), alone->result.distance_m) << i;
    }
  }
}

TEST(BatchEvaluator, TakesNoneOneSeventeenAndMoreGenomesThanWorkersHaveLanes) {
  const auto problem = batch_problem();
  const auto population = small_population(problem);
  Evaluator evaluator(problem, {}, 3);
  const auto all = evaluator.evaluate(population.genomes(), never);
  for (const std::size_t count : {0u, 1u, 17u, 40u}) {
    const auto some = evaluator.evaluate(population.genomes().first(count), never);
    ASSERT_TRUE(some) << count;
    ASSERT_EQ(some->trajectories.size(), count);
    for (std::size_t i = 0; i < count; ++i)
      EXPECT_EQ(some->trajectories[i].com_end_m, all->trajectories[i].com_end_m) << count << ' ' << i;
    if (count == 0) {
      EXPECT_EQ(some->steps, 0u);
    }
  }
}

TEST(BatchEvaluator, EndsTrialsOfRobotsThatFallAtOnceAfterOneStepEach) {
  auto problem = batch_problem();
  problem.robot.fall_height_m = 10.0;
  const auto population = small_population(problem);
  Evaluator evaluator(problem, {}, 2);
  const auto result = evaluator.evaluate(population.genomes(), never);
  EXPECT_EQ(result->steps, population.genomes().size());
  for (const auto& trajectory : result->trajectories) {
    EXPECT_EQ(trajectory.outcome, record::Outcome::fell);
    EXPECT_EQ(trajectory.steps, 1);
  }
}

TEST(BatchEvaluator, CallsRobotsThatExplodeDiverged) {
  auto problem = batch_problem();
  problem.robot.gravity_m_s2.z = -1e30;
  const auto population = small_population(problem);
  Evaluator evaluator(problem, {.stride = 5}, 2);
  const auto result = evaluator.evaluate(population.genomes(), never);
  for (const auto& trajectory : result->trajectories) {
    EXPECT_EQ(trajectory.outcome, record::Outcome::diverged);
    EXPECT_EQ(score::distance_m(trajectory), 0.0) << "the last healthy place is the start";
  }
}

/// Trials of given SUPG controllers, in order.
class GivenTrials : public trial::TaskQueue {
 public:
  explicit GivenTrials(std::vector<std::shared_ptr<const controllers::Parameters>> given)
      : results(given.size()), given_(std::move(given)) {}
  std::optional<trial::Task> next() override {
    if (next_ == given_.size()) return std::nullopt;
    const std::size_t index = next_++;
    return trial::Task{index, given_[index], nullptr, nullptr};
  }
  void done(std::size_t index, record::Trajectory trajectory) override {
    results[index] = std::move(trajectory);
  }
  std::vector<record::Trajectory> results;

 private:
  std::vector<std::shared_ptr<const controllers::Parameters>> given_;
  std::size_t next_ = 0;
};

TEST(BatchRunner, EndsTheTrialOfAControllerThatGivesNoNumberAndNoOther) {
  const auto problem = batch_problem();
  const auto population = small_population(problem);
  const auto engine = problem.make_engine();
  const auto batch = problem.architecture->make_batch(engine->lanes());
  std::vector<std::shared_ptr<const controllers::Parameters>> good, mixed;
  for (std::size_t i = 0; i < 40; ++i) {
    good.push_back(problem.decode(population.genomes()[i]));
    mixed.push_back(good.back());
    if (i % 3 != 1) continue;
    auto bad = std::make_shared<controllers::SupgParameters>(
        dynamic_cast<const controllers::SupgParameters&>(*good.back()));
    for (int tick = 30; tick < 100; ++tick)
      bad->targets_rad(0, tick)[1] = std::numeric_limits<float>::quiet_NaN();
    mixed.back() = bad;
  }
  GivenTrials expected(good), found(mixed);
  trial::Runner runner(*engine, *batch, problem.protocol({.stride = 5}));
  runner.run(expected, never);
  runner.run(found, never);
  for (std::size_t i = 0; i < 40; ++i) {
    if (i % 3 == 1) {
      EXPECT_EQ(found.results[i].outcome, record::Outcome::diverged) << i;
      EXPECT_TRUE(std::isfinite(score::distance_m(found.results[i])));
      continue;
    }
    EXPECT_EQ(found.results[i].com_path_m, expected.results[i].com_path_m) << i;
    EXPECT_EQ(found.results[i].com_end_m, expected.results[i].com_end_m) << i;
  }
}

TEST(BatchReplay, RecordsMotorTorquesAndGivesTheDistanceOfTheRun) {
  const TemporaryFolder scratch;
  const auto problem = batch_problem();
  const auto population = small_population(problem);
  ReplayOptions options;
  options.record = scratch / "walk.rec";
  const auto recorded = replay(problem, population.genomes()[7], options, never);
  EXPECT_EQ(recorded->result.distance_m,
            replay(problem, population.genomes()[7], {}, never)->result.distance_m);
  record::RecordingReader reader(*options.record);
  const auto& columns = reader.header().columns;
  const auto torque = std::ranges::find(columns, "torque.FL_hip_fb") - columns.begin();
  ASSERT_LT(torque, std::ssize(columns));
  float largest_nm = 0.0f;
  std::vector<float> frame;
  while (reader.next(frame))
    largest_nm = std::max(largest_nm, std::abs(frame[static_cast<std::size_t>(torque)]));
  EXPECT_GT(largest_nm, 0.1f);
  EXPECT_LE(largest_nm, 1.001f * static_cast<float>(problem.robot.joints[1].servo.max_torque_nm));
}

}  // namespace
}  // namespace amble::experiment
