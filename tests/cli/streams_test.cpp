#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/wait.h>

#include <cstdlib>
#include <string>

#include "amble/core/error.hpp"
#include "tests/cli/process.hpp"

namespace amble::tests {
namespace streams_test {

constexpr int ok = static_cast<int>(ExitCode::ok), bad_input = static_cast<int>(ExitCode::bad_input),
              io = static_cast<int>(ExitCode::io);

/// What the shell's last command returns when `amble` is called in it; −1 if a signal ended it.
int shell(const std::string& arguments) {
  const int status = std::system(("'" AMBLE_PROGRAM "' " + arguments).c_str());
  return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

std::string evolve(const std::string& out) {
  return "evolve '" AMBLE_SOURCE_DIR
         "/configs/authors/supg-objective.toml' --set population.size=40 --set trial.duration_s=0.2 "
         "--generations 3 --jobs 2 --out '" +
         out + "' ";
}

// Files that are opened get the numbers of closed streams, and would get what is meant for these.
TEST(StandardStreams, ThatAreClosedTakeNothingFromARunsFiles) {
  const TemporaryFolder scratch;
  ASSERT_EQ(shell(evolve(scratch / "open") + ">/dev/null 2>&1"), ok);
  const std::string closed[] = {"2>&-", "0<&- 2>&-", "0<&- 1>&- 2>&-", "1>&- 2>/dev/null"};
  for (std::size_t i = 0; i < std::size(closed); ++i) {
    const auto run = scratch.path() / std::to_string(i);
    const bool no_output = closed[i].find("1>&-") != std::string::npos;
    EXPECT_EQ(shell(evolve(run) + (no_output ? "" : ">/dev/null ") + closed[i]), no_output ? io : ok)
        << closed[i];
    EXPECT_EQ(without_times(slurp(run / "generations.csv")),
              without_times(slurp(scratch / "open/generations.csv")));
    EXPECT_EQ(all_champions(run), all_champions(scratch / "open"));
    EXPECT_THAT(slurp(run / ".lock"), testing::MatchesRegex("[0-9]+\n"));
    EXPECT_EQ(shell("resume '" + run.string() + "' --generations 4 >/dev/null " + closed[i]),
              no_output ? io : ok);
    EXPECT_EQ(shell("verify '" + run.string() + "' >/dev/null 2>&1"), ok);
  }
}

TEST(StandardStreams, ThatCannotBeWrittenDoNotStopARun) {
  const TemporaryFolder scratch;
  EXPECT_EQ(shell(evolve(scratch / "full") + ">/dev/null 2>/dev/full"), ok);
  EXPECT_EQ(shell(evolve(scratch / "output") + ">/dev/full 2>/dev/null"), io);
  // A reader that goes away.
  const auto code = (scratch / "code").string();
  const auto run = "'" AMBLE_PROGRAM "' " + evolve(scratch / "pipe");
  ASSERT_EQ(std::system(("{ " + run + "2>&1 >/dev/null; echo $? > '" + code + "'; } | true").c_str()), 0);
  EXPECT_EQ(slurp(code), "0\n");
  for (const auto* name : {"full", "output", "pipe"})
    EXPECT_EQ(shell("verify '" + (scratch / name).string() + "' >/dev/null 2>&1"), ok) << name;
}

TEST(StandardStreams, ThatCannotBeWrittenLeaveTheExitCodeAsItIs) {
  EXPECT_EQ(shell("dance 2>/dev/full"), bad_input);
  EXPECT_EQ(shell("dance 2>&-"), bad_input);
  EXPECT_EQ(shell("info /nowhere 2>/dev/full"), io);
}

}  // namespace streams_test
}  // namespace amble::tests
