#include "amble/exporting/c_source.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <sstream>

#include "amble/core/error.hpp"
#include "amble/io/file.hpp"
#include "tests/exporting/champions.hpp"
#include "tests/exporting/compiled.hpp"
#include "tests/io/temporary_folder.hpp"

namespace amble::tests {
namespace {

using exporting::Arithmetic;
using exporting::Trace;
using test::TemporaryFolder;

const std::filesystem::path replay_main = AMBLE_SOURCE_DIR "/tests/exporting/replay.c";

/// tools/export-study tries all champions over 300 s in all builds, and prints a row for each.
const bool is_study = std::getenv("AMBLE_EXPORT_STUDY") != nullptr;

const Sample untriggered_sample{"untriggered",
                                "authors/supg",
                                "quadruped",
                                {"controller.supg.trigger=none", "controller.supg.idle=wrap"}};

/// Champions of others, which tools/export-study is given: their paths, with a line end after each.
std::vector<Sample> given_samples() {
  std::vector<Sample> given;
  const char* const paths = std::getenv("AMBLE_EXPORT_CHAMPIONS");
  std::istringstream lines(paths == nullptr ? "" : paths);
  for (std::string path; std::getline(lines, path);)
    given.push_back({.name = fmt::format("given_{}", given.size() + 1), .preset = {}, .file = path});
  return given;
}

std::vector<Sample> samples() {
  std::vector<Sample> some = given_samples();
  if (!some.empty()) return some;
  for (const Sample& sample : twenty_samples())
    for (const char* name : {"quadruped_supg", "holding_level", "wrapping_debounced", "hexapod_sine",
                             "quadruped_ctrnn", "recurrent_sine", "ctrnn_runge_kutta", "biped_ctrnn"})
      if (is_study || sample.name == name) {
        some.push_back(sample);
        break;
      }
  some.push_back(untriggered_sample);
  for (const Sample& sample : seam_samples()) some.push_back(sample);
  for (const Sample& sample : modulated_samples()) some.push_back(sample);
  for (const Sample& sample : sensing_samples()) some.push_back(sample);
  return some;
}

class EachChampion : public testing::TestWithParam<Sample> {};
INSTANTIATE_TEST_SUITE_P(CSource, EachChampion, testing::ValuesIn(samples()),
                         [](const auto& sample) { return sample.param.name; });

Trace trace_of(const experiment::Champion& champion, int ticks) {
  const std::atomic<bool> stop{false};
  return exporting::record_trace(champion.problem, champion.genome, ticks, stop);
}

struct Build {
  const char *name, *compiler, *flags;
  int ticks;  ///< compared unless in the study
};

TEST_P(EachChampion, AnswersRecordedSensorsWithRecordedTargetsToTheBit) {
  const TemporaryFolder scratch;
  const experiment::Champion champion = evolve(GetParam());
  const auto tables = exporting::controller_tables(champion.problem, champion.genome);
  constexpr int some = 2000;
#ifdef AMBLE_SANITIZED
  constexpr int all = some;  // recording the trace is what takes the time
#else
  constexpr int all = 30000;
#endif
  const Trace trace = trace_of(champion, all);
  ASSERT_EQ(trace.ticks.size(), static_cast<std::size_t>(all));
  write_walker(scratch.path(), champion);
  // Passes until nothing changes and Runge-Kutta are slow where fused multiply-adds are emulated.
  const auto* const neural = std::get_if<exporting::NeuralTables>(&tables.parts);
  const bool slow = neural && (neural->update == exporting::NeuralTables::Update::passes ||
                               neural->update == exporting::NeuralTables::Update::runge_kutta);
  for (const Build& build :
       {Build{"gcc", "gcc", "-O2", slow ? some : all},
        {"clang_native", "clang-14", "-O2 -march=native", some},
        {"gcc_native", "gcc", "-O3 -march=native", slow ? all : some},
        {"sanitized", "clang-14", "-O1 -fsanitize=address,undefined -fno-sanitize-recover=all", some}}) {
    ASSERT_EQ(
        compile(scratch.path(), build.compiler, strict_flags + " " + build.flags, replay_main, build.name),
        "")
        << build.name;
    Trace part = trace;
    if (!is_study) part.ticks.resize(static_cast<std::size_t>(build.ticks));
    const Difference difference = replay(scratch / build.name, tables, part);
    EXPECT_EQ(difference.ticks, part.ticks.size()) << build.name;
    EXPECT_EQ(difference.targets_of_other_bits, 0u) << build.name;
    EXPECT_EQ(difference.states_of_other_bits, 0u) << build.name;
    EXPECT_LE(difference.largest_rad, 1e-6) << build.name;
    if (is_study)
      fmt::print("| {} | {} | {} | {} | {:.2g} | {} | {} |\n", GetParam().name, tables.kind, build.name,
                 difference.ticks, difference.largest_rad, difference.targets_of_other_bits,
                 difference.states_of_other_bits);
  }
}

TEST_P(EachChampion, PassesItsSelfTestWhateverTheSensorsSay) {
  const TemporaryFolder scratch;
  const experiment::Champion champion = evolve(GetParam());
  const auto source = write_walker(scratch.path(), champion);
  const std::string flags =
      strict_flags + " -DWALKER_SELF_TEST -fsanitize=address,undefined -fno-sanitize-recover=all";
  ASSERT_EQ(compile(scratch.path(), "clang-14", flags, {}, "self"), "");
  const Ran ran = run_shell("'" + (scratch / "self").string() + "'");
  EXPECT_EQ(ran.exit_code, 0) << ran.out;
  EXPECT_EQ(ran.out, "walker: 100 ticks, largest error 0 rad\n");
  // C++ understands the header.
  EXPECT_EQ(run_shell("g++ -std=c++11 -pedantic -Wall -Wextra -Werror -fsyntax-only -x c++ '" +
                      (scratch / "walker.h").string() + "'")
                .out,
            source.header.empty() ? "no header" : "");
}

TEST_P(EachChampion, InFixedPointIsWithinHalfABit) {
  const TemporaryFolder scratch;
  const experiment::Champion champion = evolve(GetParam());
  const auto tables = exporting::controller_tables(champion.problem, champion.genome);
  const auto* const supg = std::get_if<exporting::SupgTables>(&tables.parts);
  if (!supg || supg->seam || supg->modulation || supg->contact || tables.differential) {
    EXPECT_THROW(write_walker(scratch.path(), champion, Arithmetic::fixed), UserError);
    return;
  }
  const Trace trace = trace_of(champion, is_study ? 30000 : 3000);
  write_walker(scratch.path(), champion, Arithmetic::fixed);
  ASSERT_EQ(compile(scratch.path(), "gcc", strict_flags, replay_main, "fixed"), "");
  const Difference difference = replay(scratch / "fixed", tables, trace);
  EXPECT_EQ(difference.ticks, trace.ticks.size());
  EXPECT_EQ(difference.states_of_other_bits, 0u);
  // The ends of a range may be a bit away, since targets stay inside.
  EXPECT_LE(difference.largest_rad, std::ldexp(1.0, -exporting::fraction_bits(tables)));
  ASSERT_EQ(compile(scratch.path(), "gcc", strict_flags + " -DWALKER_SELF_TEST", {}, "self"), "");
  EXPECT_EQ(run_shell("'" + (scratch / "self").string() + "'").exit_code, 0);
}

/// A champion without a run: what is exported does not depend on its result.
experiment::Champion simple_champion() {
  static const experiment::Champion champion = evolve(twenty_samples().front());
  return champion;
}

TEST(CSource, IsTheSameEachTime) {
  const TemporaryFolder scratch;
  const auto once = write_walker(scratch.path(), simple_champion());
  const auto again = write_walker(scratch.path(), simple_champion());
  EXPECT_EQ(once.header, again.header);
  EXPECT_EQ(once.source, again.source);
}

TEST(CSource, BearsAnyNames) {
  const TemporaryFolder scratch;
  experiment::Champion champion = simple_champion();
  champion.experiment = "*/ int main /* ?\?/ \\ \n \xc3\xa9";
  for (robot::Joint& joint : champion.problem.robot.joints) joint.name = "*/ same";
  for (robot::Leg& leg : champion.problem.robot.legs) leg.name = "1 leg?\?/";
  write_walker(scratch.path(), champion);
  EXPECT_EQ(compile(scratch.path(), "gcc", strict_flags + " -DWALKER_SELF_TEST", {}, "self"), "");
  EXPECT_EQ(compile(scratch.path(), "clang-14", strict_flags + " -DWALKER_SELF_TEST", {}, "self"), "");
}

TEST(CSource, TellsNamesApartThatDifferInCaseAlone) {
  const TemporaryFolder scratch;
  experiment::Champion champion = simple_champion();
  champion.problem.robot.joints[0].name = "knee";
  champion.problem.robot.joints[1].name = "Knee";
  champion.problem.robot.legs[0].name = "Fore";
  champion.problem.robot.legs[1].name = "FORE";
  write_walker(scratch.path(), champion);
  EXPECT_EQ(compile(scratch.path(), "gcc", strict_flags + " -DWALKER_SELF_TEST", {}, "self"), "");
}

TEST(CSource, SaysWhereItComesFromAndWhatItNeeds) {
  const TemporaryFolder scratch;
  experiment::Champion champion = simple_champion();
  champion.generation = 17, champion.index = 3;
  const std::string header = write_walker(scratch.path(), champion).header;
  for (const std::string& part :
       {std::string("seed 7, generation 17, number 3"), std::string("engine      batch"),
        std::string("100 steps per second, one every 0.01 s. At once."), std::string("touch[leg]"),
        std::string("WALKER_JOINT_FL_KNEE = 0"),
        std::string("'FL_knee', body 'FL_lower', axis 0 1 0: targets from -0.8 to 0 rad"),
        std::string("WALKER_TICK_US 10000")})
    EXPECT_NE(header.find(part), std::string::npos) << part << "\n" << header;
}

constexpr std::string_view rows_main = R"(#include <stdio.h>
#include "walker.h"
#define JOINT(joint, name, leg, least, most, first) printf("%d %s %d %.9g %.9g %.9g\n", joint, name, leg, least, most, first);
#define LEG(leg, name) printf("%d %s\n", leg, name);
int main(void) {
  WALKER_EACH_JOINT(JOINT)
  WALKER_EACH_LEG(LEG)
  return 0;
}
)";

TEST(CSource, HasARowForEachJointAndLegWhateverTheirNames) {
  const TemporaryFolder scratch;
  experiment::Champion champion = simple_champion();
  champion.problem.robot.joints[1].name = "\"*/\\ hip";
  write_walker(scratch.path(), champion);
  io::write_file(scratch / "rows.c", std::string(rows_main));
  ASSERT_EQ(compile(scratch.path(), "gcc", "-std=c99 -Wall -Wextra -Werror", scratch / "rows.c", "rows"), "");
  const auto tables = exporting::controller_tables(champion.problem, champion.genome);
  const Trace trace = trace_of(champion, 1);
  std::string expected;
  for (std::size_t j = 0; j < tables.joints.size(); ++j) {
    const auto& joint = tables.joints[j];
    expected += fmt::format("{} {} {} {:.9g} {:.9g} {:.9g}\n", j, j == 1 ? "\"* /\\ hip" : joint.name,
                            joint.leg, static_cast<float>(joint.lower_rad),
                            static_cast<float>(joint.upper_rad), trace.ticks[0].target_rad[j]);
  }
  for (std::size_t leg = 0; leg < tables.legs.size(); ++leg)
    expected += fmt::format("{} {}\n", leg, tables.legs[leg]);
  EXPECT_EQ(run_shell("'" + (scratch / "rows").string() + "'").out, expected);
}

TEST(CSource, WithoutTriggersReadsNoSensor) {
  for (const Arithmetic arithmetic : {Arithmetic::float32, Arithmetic::fixed}) {
    const TemporaryFolder scratch;
    const auto untriggered = write_walker(scratch.path(), evolve(untriggered_sample), arithmetic);
    EXPECT_EQ(untriggered.header.find("touch["), std::string::npos);
    EXPECT_EQ(untriggered.source.find("touch["), std::string::npos);
    EXPECT_NE(untriggered.header.find("#define WALKER_READS_TOUCH 0"), std::string::npos);
    EXPECT_NE(untriggered.header.find("char none;"), std::string::npos);
    ASSERT_EQ(compile(scratch.path(), "gcc", strict_flags + " -DWALKER_SELF_TEST", {}, "self"), "");
    EXPECT_EQ(run_shell("'" + (scratch / "self").string() + "'").exit_code, 0);
  }
}

constexpr std::string_view told_main = R"(#include <math.h>
#include <stdio.h>
#include "walker.h"
int main(void) {
  static walker_sensors in;
  walker_targets targets;
  walker_state state;
  walker_init(&state);
  walker_set_command(&state, 0.2f, 0.1f);
  walker_step(&state, &in, &targets);
  walker_set_command(&state, NAN, INFINITY);
  walker_set_command(&state, 0.7f, NAN);
  walker_set_command(&state, -INFINITY, 0.7f);
  walker_step(&state, &in, &targets);
  walker_set_command(&state, 1e9f, -1e9f);
  printf("%g %g\n", state.command_speed_m_s, state.command_turn_rad_s);
  walker_set_command(&state, 0.2f, 0.1f);
  walker_step(&state, &in, &targets);
  printf("%.4f %.4f\n", state.heading_error_rad, state.wanted_yaw_rad);
  return 0;
}
)";

TEST(CSource, KeepsItsHeadingWhateverItIsTold) {
  const auto all = modulated_samples();
  const auto obeying = std::ranges::find(all, "obeying", &Sample::name);
  ASSERT_NE(obeying, all.end());
  const TemporaryFolder scratch;
  write_walker(scratch.path(), evolve(*obeying));
  io::write_file(scratch / "told.c", std::string(told_main));
  ASSERT_EQ(compile(scratch.path(), "gcc", "-std=c99 -Wall -Wextra -Werror", scratch / "told.c", "told"), "");
  // Three ticks of 0.1 rad/s: what was not finite changed nothing.
  EXPECT_EQ(run_shell("'" + (scratch / "told").string() + "'").out, "100 -100\n0.0020 0.0030\n");
}

TEST(FixedPoint, HasAsManyFractionBitsAsTheWidestRangeLeaves) {
  exporting::ControllerTables tables;
  tables.joints = {{.name = "a", .leg = 0, .lower_rad = -0.8, .upper_rad = 0.4, .driven = true}};
  EXPECT_EQ(exporting::fraction_bits(tables), 15);
  tables.joints.push_back({.name = "b", .leg = 0, .lower_rad = -3.2, .upper_rad = 0.0, .driven = true});
  EXPECT_EQ(exporting::fraction_bits(tables), 13);
  tables.joints[1].lower_rad = -1e6;
  EXPECT_THROW(exporting::fraction_bits(tables), UserError);
}

TEST(FixedPoint, StaysInsideTheRange) {
  const exporting::CommandedJoint joint{
      .name = "a", .leg = 0, .lower_rad = -0.3, .upper_rad = 0.7, .driven = true};
  for (const float target_rad : {-0.3f, 0.7f, 0.0f, 0.12345f}) {
    const double back_rad = std::ldexp(exporting::fixed_target(joint, target_rad, 15), -15);
    EXPECT_GE(back_rad, joint.lower_rad);
    EXPECT_LE(back_rad, joint.upper_rad);
    EXPECT_NEAR(back_rad, target_rad, std::ldexp(1.0, -15));
  }
}

}  // namespace
}  // namespace amble::tests
