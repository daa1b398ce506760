#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <sstream>
#include <string>
#include <vector>

#include "tests/cli/process.hpp"

namespace amble::tests {
namespace {

using testing::StartsWith;

const std::string evolve_small = "'" AMBLE_PROGRAM "' evolve '" AMBLE_SOURCE_DIR
                                 "/configs/authors/supg-objective.toml' --set population.size=20 --set "
                                 "trial.duration_s=0.2 --generations 6 ";

/// What a run of a few generations writes on a terminal so wide, one text for each time it writes its line.
std::vector<std::string> lines_on_terminal(int columns) {
  const TemporaryFolder scratch;
  // `script` runs its command on a terminal of its own.
  const std::string command = "stty cols " + std::to_string(columns) + "; " + evolve_small + "--out '" +
                              (scratch / "run").string() + "' >/dev/null";
  spill(scratch / "command", command);
  const std::string transcript = scratch / "transcript";
  EXPECT_EQ(std::system(("script -qec \"sh '" + (scratch / "command").string() + "'\" '" + transcript +
                         "' >/dev/null </dev/null")
                            .c_str()),
            0);
  std::string text = slurp(transcript);
  std::vector<std::string> lines;
  const std::string begin = "\r\033[K";
  for (auto at = text.find(begin); at != std::string::npos; at = text.find(begin, at)) {
    at += begin.size();
    lines.push_back(text.substr(at, text.find_first_of("\r\n", at) - at));
  }
  return lines;
}

std::size_t characters(const std::string& text) {
  std::size_t count = 0;
  for (const char c : text) count += (static_cast<unsigned char>(c) & 0xc0) != 0x80;
  return count;
}

TEST(Progress, IsNoLongerThanTheTerminalIsWide) {
  for (const int columns : {12, 40, 60, 100, 300}) {
    const auto lines = lines_on_terminal(columns);
    ASSERT_GE(lines.size(), 2U);
    for (const std::string& line : lines)
      EXPECT_LT(characters(line), static_cast<std::size_t>(columns)) << line;
    EXPECT_EQ(lines.back().starts_with("generation 6/6  typically "), columns >= 40);
    EXPECT_EQ(lines.back().ends_with(" species"), columns >= 100) << lines.back();
  }
}

TEST(Progress, BeginsBeforeTheFirstGenerationEnds) {
  EXPECT_EQ(lines_on_terminal(100).front(), "generation 1/6  20 genomes × 0.2 s in ode");
  const TemporaryFolder scratch;
  const std::string err = scratch / "err";
  ASSERT_EQ(
      std::system(
          (evolve_small + "--out '" + (scratch / "run").string() + "' >/dev/null 2>'" + err + "'").c_str()),
      0);
  EXPECT_THAT(slurp(err), StartsWith("generation 1/6  20 genomes × 0.2 s in ode\n"));
}

}  // namespace
}  // namespace amble::tests
