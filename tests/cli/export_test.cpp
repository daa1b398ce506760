#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>

#include "tests/cli/process.hpp"

namespace amble::tests {
namespace export_test {

using testing::AllOf;
using testing::EndsWith;
using testing::HasSubstr;
using testing::StartsWith;

const std::string source_folder = AMBLE_SOURCE_DIR;

std::string run_of_kind(const TemporaryFolder& scratch, const std::string& kind) {
  const auto run = scratch / kind;
  const auto evolved =
      amble({"evolve", source_folder + "/configs/authors/" + kind + "-objective.toml", "--set",
             "population.size=40", "--set", "trial.duration_s=0.5", "--generations", "1", "--out", run});
  EXPECT_EQ(evolved.exit_code, 0) << evolved.err;
  return run;
}

TEST(ExportCommand, WritesCThatPassesItsSelfTest) {
  const TemporaryFolder scratch;
  const auto run = run_of_kind(scratch, "supg");
  const std::vector<std::vector<std::string>> ways{
      {}, {"--fixed"}, {"--steering", "turn_gain = 2, full_speed_m_s = 0.3"}};
  for (const auto& way : ways) {
    std::vector<std::string> arguments{"export", run, "--format", "c", "-o", scratch / "my_robot.c"};
    arguments.insert(arguments.end(), way.begin(), way.end());
    const auto written = amble(arguments);
    ASSERT_EQ(written.exit_code, 0) << written.err;
    EXPECT_EQ(written.out, "");
    EXPECT_EQ(slurp(scratch / "my_robot.h").find("void my_robot_set_command(") != std::string::npos,
              way.size() == 2);
    EXPECT_THAT(slurp(scratch / "my_robot.h"),
                AllOf(StartsWith("/* Controller exported by amble "), HasSubstr("#define MY_ROBOT_JOINTS 12"),
                      HasSubstr("void my_robot_step(")));
    const std::string program = scratch / "self_test";
    EXPECT_EQ(std::system(("gcc -std=c99 -pedantic -Wall -Wextra -Werror -DMY_ROBOT_SELF_TEST '" +
                           std::string(scratch / "my_robot.c") + "' -o '" + program + "' && '" + program +
                           "' > '" + program + ".txt'")
                              .c_str()),
              0);
    EXPECT_THAT(slurp(program + ".txt"), EndsWith("ticks, largest error 0 rad\n"));
  }
}

TEST(ExportCommand, PrintsJsonAndMjcfOrWritesThem) {
  const TemporaryFolder scratch;
  const auto run = run_of_kind(scratch, "sine"), champion = run + "/champions/00000.json";
  const auto json = amble({"export", champion, "--format", "json"});
  EXPECT_EQ(json.exit_code, 0) << json.err;
  EXPECT_THAT(json.out, AllOf(StartsWith("{\n  \"format\": \"amble-export\""), HasSubstr("\"neural\"")));
  const auto mjcf = amble({"export", run, "--format", "mjcf"});
  EXPECT_EQ(mjcf.exit_code, 0) << mjcf.err;
  EXPECT_THAT(mjcf.out, AllOf(StartsWith("<!-- Written by amble. -->\n<mujoco model="),
                              HasSubstr("<actuator>"), EndsWith("</mujoco>\n")));
  EXPECT_EQ(amble({"export", run, "--format", "json", "-o", scratch / "a.json"}).exit_code, 0);
  EXPECT_EQ(slurp(scratch / "a.json"), json.out);
  EXPECT_EQ(amble({"export", run, "--format", "mjcf", "-o", scratch / "a.xml"}).exit_code, 0);
  EXPECT_EQ(slurp(scratch / "a.xml"), mjcf.out);
}

/// Without the line that names version and commit.
std::string from_second_line(const std::string& text) {
  return text.substr(std::min(text.find('\n'), text.size()));
}

TEST(ExportCommand, WroteTheControllerOfTheExampleFirmware) {
  const TemporaryFolder scratch;
  const std::string example = source_folder + "/examples/firmware/walker";
  const auto written = amble({"export", source_folder + "/robots/servo/walker.json", "--format", "c",
                              "--fixed", "-o", scratch / "walker.c"});
  ASSERT_EQ(written.exit_code, 0) << written.err;
  for (const char* extension : {".h", ".c"})
    EXPECT_EQ(from_second_line(slurp(scratch / ("walker" + std::string(extension)))),
              from_second_line(slurp(example + extension)))
        << "amble export robots/servo/walker.json --format c --fixed -o examples/firmware/walker.c";
}

TEST(ExportCommand, RefusesInOneLine) {
  const TemporaryFolder scratch;
  const auto run = run_of_kind(scratch, "ctrnn");
  spill(scratch / "mine.c", "int main(void) { return 0; }\n");
  const std::pair<std::vector<std::string>, std::string> wrong[] = {
      {{"--format", "c"}, "--format c: expected -o FILE.c"},
      {{"--format", "c", "-o", scratch / "a.cpp"}, "--format c: expected -o FILE.c"},
      {{"--format", "c", "-o", scratch / "2 legs.c"},
       "expected a letter, then letters, digits and underscores"},
      {{"--format", "c", "-o", scratch / "mine.c"}, "mine.c"},
      {{"--format", "c", "-o", scratch / "read.c"},
       "read_sensors is that of a helper; expected another name"},
      {{"--format", "c", "--fixed", "-o", scratch / "a.c"}, "of kind ctrnn: expected supg"},
      {{"--format", "json", "--fixed"}, "--fixed: only with --format c"},
      {{"--format", "python"}, "--format"},
      {{}, "--format is required"}};
  for (auto [arguments, message] : wrong) {
    arguments.insert(arguments.begin(), {"export", run});
    const auto refused = amble(arguments);
    EXPECT_EQ(refused.exit_code, 2) << refused.err;
    EXPECT_THAT(refused.err, AllOf(StartsWith("amble: "), HasSubstr(message)));
  }
  EXPECT_THAT(amble({"export", AMBLE_SOURCE_DIR "/robots/hexapod/steered.json", "--format", "c", "--fixed",
                     "-o", scratch / "a.c"})
                  .err,
              HasSubstr("of kind mixed"))
      << "not of its modulation, which nobody set";
  EXPECT_EQ(slurp(scratch / "mine.c"), "int main(void) { return 0; }\n");
  EXPECT_FALSE(std::filesystem::exists(scratch / "a.c"));
}

}  // namespace export_test
}  // namespace amble::tests
