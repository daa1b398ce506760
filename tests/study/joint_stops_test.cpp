#include <gtest/gtest.h>

#include <fmt/format.h>

#include <cmath>

#include "amble/io/file.hpp"
#include "amble/record/levels.hpp"
#include "amble/statistics/descriptive.hpp"
#include "amble/study/champion_tests.hpp"
#include "tests/study/fixture.hpp"

namespace amble::study {
namespace {

/// What the twenty champions of a kind reach in the study `paper`, whose legs lie straight on their stops at
/// the start.
struct Champions {
  double undisturbed_m = 0.0, typical_m = 0.0;  ///< means
  double alike = 0.0;  ///< share of the disturbed trials that end within 5 % of the undisturbed distance
};

/// At `micro`, with the stops on which the start lies moved away by so much; the targets stay.
Champions walk(const std::string& kind, double moved_rad) {
  const std::atomic<bool> never{false};
  Champions all;
  constexpr int champions = 20, trials = 16;
  for (int seed = 1; seed <= champions; ++seed) {
    const auto name = fmt::format("{}-novelty-{:03}.json", kind, seed);
    const auto record =
        ledger::parse_record(io::read_file(AMBLE_SOURCE_DIR "/results/paper/ledger/" + name), name);
    auto champion = champion_from_json(record.champion, name);
    for (robot::Joint& joint : champion.problem.robot.joints) {
      joint.command = joint.command_range();
      if (joint.lower_rad == 0.0) joint.lower_rad = -moved_rad;
      if (joint.upper_rad == 0.0) joint.upper_rad = moved_rad;
    }
    champion.problem.complete();
    PlannedTest test{.spec = trial_test("t", 15.0), .noise = {}};
    const double undisturbed_m = run_test(test, champion, never)->distance_m();
    test.spec.episodes = trials;
    test.noise = trial::noise_of(*record::find_level("micro"));
    const auto disturbed = run_test(test, champion, never);
    all.undisturbed_m += undisturbed_m / champions;
    all.typical_m += disturbed->distance_m() / champions;
    for (const auto& episode : disturbed->episodes)
      all.alike +=
          (std::abs(episode.distance_m - undisturbed_m) < 0.05 * undisturbed_m) / (1.0 * champions * trials);
  }
  fmt::print(
      "{}, stops moved by {} rad: undisturbed {:.2f} m, at micro {:.2f} m, {:.0f} % of the trials alike\n",
      kind, moved_rad, all.undisturbed_m, all.typical_m, 100.0 * all.alike);
  return all;
}

/// docs/GAITS-NOT-TRAJECTORIES.md has what this prints.
class JointStops : public testing::TestWithParam<const char*> {};
INSTANTIATE_TEST_SUITE_P(Of, JointStops, testing::Values("supg", "ctrnn", "sine"),
                         [](const auto& kind) { return std::string(kind.param); });

TEST_P(JointStops, AreWhyAMicroRadianMattersAtTheStart) {
#ifdef AMBLE_SANITIZED
  GTEST_SKIP() << "many walks, of which nothing is new to a sanitizer";
#endif
  const Champions on = walk(GetParam(), 0.0);
  EXPECT_LT(on.alike, 0.02) << "lying exactly on them is one trajectory";
  EXPECT_LT(on.typical_m, 0.5 * on.undisturbed_m);
  for (const double moved_rad : {1e-5, 1e-2}) {
    const Champions beside = walk(GetParam(), moved_rad);
    EXPECT_GT(beside.alike, 0.3) << "beside them a micro-radian changes little";
    EXPECT_NEAR(beside.typical_m, beside.undisturbed_m, 0.15 * beside.undisturbed_m);
    EXPECT_LT(beside.undisturbed_m, 0.5 * on.undisturbed_m) << "and what evolved is lost without any noise";
  }
}

}  // namespace
}  // namespace amble::study
