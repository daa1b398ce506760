#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <iomanip>
#include <sstream>

#include "tests/cli/process.hpp"

namespace amble::tests {
namespace draw_test {

using testing::AllOf;
using testing::EndsWith;
using testing::HasSubstr;
using testing::StartsWith;

const std::string source = AMBLE_SOURCE_DIR;

/// A run of one generation; gives its folder.
std::string make_run(const TemporaryFolder& scratch, const std::string& config = "supg-objective") {
  const auto run = scratch / config;
  const auto evolved =
      amble({"evolve", source + "/configs/authors/" + config + ".toml", "--set", "population.size=40",
             "--set", "trial.duration_s=0.5", "--generations", "1", "--out", run});
  EXPECT_EQ(evolved.exit_code, 0) << evolved.err;
  return run;
}

TEST(DrawCommand, PrintsDotOrWritesFilesByTheirNames) {
  const TemporaryFolder scratch;
  const auto run = make_run(scratch), champion = run + "/champions/00000.json";
  const auto printed = amble({"draw", champion});
  EXPECT_EQ(printed.exit_code, 0) << printed.err;
  EXPECT_THAT(printed.out,
              AllOf(StartsWith("digraph cppn {\n"), HasSubstr("[label=\"joint_type\", shape=plaintext]"),
                    HasSubstr("[label=\"pattern\\n"), EndsWith("}\n")));

  const auto written =
      amble({"draw", run, "-o", scratch / "cppn.svg", "--patterns", scratch / "patterns.svg"});
  EXPECT_EQ(written.exit_code, 0) << written.err;
  EXPECT_EQ(written.out, "");
  EXPECT_THAT(slurp(scratch / "cppn.svg"), AllOf(StartsWith("<svg "), HasSubstr(">joint_type</text>")));
  EXPECT_THAT(slurp(scratch / "patterns.svg"), AllOf(StartsWith("<svg "), HasSubstr(">hip_io</text>")));

  EXPECT_EQ(amble({"draw", run, "-o", scratch / "cppn.dot"}).exit_code, 0);
  EXPECT_EQ(slurp(scratch / "cppn.dot"), printed.out) << "the run's best champion is its only one";
  EXPECT_EQ(amble({"draw", run, "-o", scratch / "cppn.svg"}).exit_code, 0) << "its own drawings it replaces";
}

TEST(DrawCommand, SaysWhatALinearNodeComputes) {
  // An absolute value in the authors' preset, the identity in the paper's.
  const TemporaryFolder scratch;
  const std::pair<std::string, std::string> functions[] = {{"authors", "|x|"}, {"paper", "linear"}};
  for (const auto& [preset, function] : functions) {
    const std::string run = scratch / preset;
    const auto evolved = amble({"evolve", source + "/configs/" + preset + "/supg-objective.toml", "--set",
                                "population.size=40", "--set", "trial.duration_s=0.1", "--set",
                                "genome.output_activation=linear", "--generations", "1", "--out", run});
    ASSERT_EQ(evolved.exit_code, 0) << evolved.err;
    EXPECT_THAT(amble({"draw", run}).out, HasSubstr("[label=\"pattern\\n" + function + "\", shape=ellipse]"));
    EXPECT_EQ(amble({"draw", run, "-o", run + ".svg"}).exit_code, 0);
    EXPECT_THAT(slurp(run + ".svg"), AllOf(HasSubstr("<title>pattern: " + function + "</title>"),
                                           HasSubstr(">" + function + "</text>")));
  }
}

TEST(DrawCommand, DrawsCppnsOfOtherControllersButNoPatterns) {
  const TemporaryFolder scratch;
  const auto run = make_run(scratch, "ctrnn-objective");
  EXPECT_THAT(amble({"draw", run}).out, HasSubstr("[label=\"source.module_x\""));
  const auto refused = amble({"draw", run, "--patterns", scratch / "patterns.svg"});
  EXPECT_EQ(refused.exit_code, 2);
  EXPECT_THAT(refused.err, HasSubstr("is of kind ctrnn: expected supg, which has them\n"));
  EXPECT_FALSE(std::filesystem::exists(scratch / "patterns.svg"));
}

/// The commands of the documentation that draw this picture; words in quotes are one.
std::vector<std::string> drawing_of(const std::string& picture) {
  std::istringstream lines(slurp(source + "/docs/STEERING.md"));
  for (std::string line; std::getline(lines, line);) {
    if (!line.starts_with("amble trial ") ||
        line.find("--draw docs/pictures/" + picture) == std::string::npos)
      continue;
    std::istringstream rest(line);
    std::vector<std::string> words;
    for (std::string word; rest >> std::quoted(word) && word != "#";) words.push_back(word);
    return {words.begin() + 1, words.end()};
  }
  return {};
}

TEST(TrialCommand, DrawsThePicturesOfSteeringThatTheDocumentationShows) {
  const TemporaryFolder scratch;
  for (const std::string picture : {"eight.svg", "eight-by-hand.svg"}) {
    auto words = drawing_of(picture);
    ASSERT_GT(words.size(), 8u) << picture;
    words[1] = source + "/" + words[1];
    words.back() = scratch / picture;
    const auto drawn = amble(words);
    ASSERT_EQ(drawn.exit_code, 0) << drawn.err;
    const std::string svg = slurp(scratch / picture);
    EXPECT_THAT(svg, AllOf(StartsWith("<svg "), HasSubstr(">Turn to the left, rad/s</text>")));
    EXPECT_EQ(svg, slurp(source + "/docs/pictures/" + picture)) << "made again by its command in STEERING.md";
    const auto said = drawn.out.find("followed to ");
    const std::string note = drawn.out.substr(said, drawn.out.find('\n', said) - said);
    EXPECT_THAT(svg, HasSubstr(">" + note + "</text>")) << "the picture says how well";
  }
}

TEST(TrialCommand, DrawsOnlyWhatWasToldSomething) {
  const TemporaryFolder scratch;
  const std::string walker = source + "/robots/hexapod/champion.json", out = scratch / "told.svg";
  const auto untold = amble({"trial", walker, "--undisturbed", "--draw", out});
  EXPECT_NE(untold.exit_code, 0);
  EXPECT_THAT(untold.err, HasSubstr("was told nothing in its evolution; expected --command as well"));
  spill(out, "mine");
  const auto others = amble({"trial", walker, "--undisturbed", "--command", "0.2,0", "--draw", out});
  EXPECT_THAT(others.err, HasSubstr("is not a drawing"));
  EXPECT_EQ(slurp(out), "mine");
  const std::string recording = scratch / "walk.rec";
  const auto both = amble({"trial", walker, "--undisturbed", "--command", "0.2,0", "--seconds", "2",
                           "--record", recording, "--draw", scratch / "a.svg"});
  EXPECT_EQ(both.exit_code, 0) << both.err;
  EXPECT_THAT(slurp(scratch / "a.svg"), StartsWith("<svg "));
  EXPECT_THAT(amble({"info", recording}).out, HasSubstr("command.speed"));
}

}  // namespace draw_test
}  // namespace amble::tests
