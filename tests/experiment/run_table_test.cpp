#include "amble/experiment/checkpoint.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <map>
#include <sstream>

#include "amble/experiment/champion.hpp"
#include "amble/experiment/checkpoint.hpp"
#include "amble/experiment/plan/generation_row.hpp"
#include "amble/io/binary.hpp"
#include "amble/robot/json.hpp"
#include "tests/experiment/fixture.hpp"

// Files of a run folder that somebody, or a program of somebody's, has touched before the run goes on.
namespace amble::experiment {
namespace {

using testing::HasSubstr;

using Change = std::function<std::string(std::string)>;

std::string replaced(std::string text, const std::string& what, const std::string& by) {
  for (std::size_t at = 0; (at = text.find(what, at)) != std::string::npos; at += by.size())
    text.replace(at, what.size(), by);
  return text;
}

/// The text with its line `number`, from 0, changed; without its end.
std::string with_line(const std::string& text, int number, const Change& change) {
  std::istringstream lines(text);
  std::string all;
  std::string line;
  for (int i = 0; std::getline(lines, line); ++i) all += (i == number ? change(line) : line) + "\n";
  return all;
}

/// A cell of a line, from 0.
Change cell(int number, const std::string& value) {
  return [=](const std::string& line) {
    std::istringstream cells(line);
    std::string all, one;
    for (int i = 0; std::getline(cells, one, ','); ++i)
      all += (i > 0 ? "," : "") + (i == number ? value : one);
    return all;
  };
}

TEST(RunDigest, IsThatOfWhatWasFoundAndOfNothingElse) {
  const TemporaryFolder scratch;
  const Config config = small_config({"engine=batch", "population.size=10"});
  const auto digest_of = [&](const char* name, const Config& run, int workers, int first_stop) {
    const auto folder = scratch / name;
    Listener stopped(first_stop);
    Run::start(folder, run, workers).execute(stopped, stopped.stop);
    if (first_stop < run.generations) {
      Listener rest;
      Run::resume(folder, {}, workers).execute(rest, rest.stop);
    }
    return run_digest(RunPaths(folder));
  };
  const std::uint64_t digest = digest_of("one", config, 1, 3);
  EXPECT_EQ(digest_of("two", config, 2, 3), digest);
  EXPECT_EQ(digest_of("stopped", config, 1, 2), digest);
  Config other = config;
  other.seed = 2;
  EXPECT_NE(digest_of("other", other, 1, 3), digest);
  const RunPaths paths(scratch / "one");
  io::write_file(paths.champion_files().back(), io::read_file(paths.champion_files().back()) + " ");
  EXPECT_NE(run_digest(paths), digest);
}

class TouchedRun : public testing::Test {
 protected:
  /// Three generations of more.
  TouchedRun() {
    Listener listener(3);
    Run::start(paths_.folder, small_novelty_config({"engine=batch", "population.size=10"}), 1)
        .execute(listener, listener.stop);
    table_ = io::read_file(paths_.generations);
  }

  std::map<std::string, std::string> files() const {
    std::map<std::string, std::string> all;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(paths_.folder))
      if (entry.is_regular_file()) all[entry.path().string()] = io::read_file(entry.path());
    return all;
  }

  /// With what message resuming fails; "" if it goes on. When it fails, no file is other than before.
  std::string refusal(const std::optional<int>& generations = 6) const {
    const auto before = files();
    try {
      Run::resume(paths_.folder, generations, 1);
    } catch (const UserError& error) {
      EXPECT_EQ(error.code(), ExitCode::bad_file);
      EXPECT_EQ(files(), before) << "something was changed";
      return error.what();
    }
    return "";
  }
  std::string refusal_of(const std::string& table) const {
    io::write_file(paths_.generations, table);
    return refusal();
  }

  TemporaryFolder scratch_;
  RunPaths paths_{scratch_ / "a run"};
  std::string table_;
};

TEST_F(TouchedRun, GoesOnWithATableThatNobodyTouched) {
  EXPECT_EQ(refusal_of(table_), "");
}

TEST_F(TouchedRun, SaysThatItsTableWasSavedByASpreadsheet) {
  const std::map<std::string, Change> saved{
      {"CRLF", [](auto t) { return replaced(t, "\n", "\r\n"); }},
      {"semicolons", [](auto t) { return replaced(t, ",", ";"); }},
      {"tabulators", [](auto t) { return replaced(t, ",", "\t"); }},
      {"blanks", [](auto t) { return replaced(t, ",", ", "); }},
      {"quotes", [](auto t) { return "\"" + replaced(replaced(t, ",", "\",\""), "\n", "\"\n\"") + "\""; }},
      {"a mark of byte order", [](auto t) { return "\xef\xbb\xbf" + t; }},
      {"UTF-16",
       [](auto t) {
         std::string wide = "\xff\xfe";
         for (const char c : t) wide += std::string{c, '\0'};
         return wide;
       }},
      {"decimal commas", [](auto t) { return replaced(t, ".", ","); }},
      {"one more column", [](auto t) { return replaced(t, "\n", ",1\n"); }},
      {"an empty column", [](auto t) { return replaced(t, "\n", ",\n"); }},
      {"one column less", [](auto t) { return replaced(t, "generation,", ""); }},
      {"another name", [](auto t) { return with_line(t, 0, cell(1, "BEST")); }},
      {"quotes in the rows alone",
       [](auto t) { return with_line(t, 2, [](auto l) { return "\"" + l + "\""; }); }},
      {"CR in one row", [](auto t) { return with_line(t, 2, [](auto l) { return l + "\r"; }); }},
      {"fewer digits", [](auto t) { return with_line(t, 3, cell(3, "0.5")); }},
      {"a date", [](auto t) { return with_line(t, 1, cell(4, "Jan 5")); }},
      {"an empty cell", [](auto t) { return with_line(t, 1, cell(4, "")); }},
  };
  for (const auto& [how, change] : saved) {
    const std::string changed = change(table_);
    ASSERT_NE(changed, table_) << how;
    const std::string said = refusal_of(changed);
    EXPECT_THAT(said, HasSubstr("generations.csv")) << how;
    EXPECT_THAT(said, HasSubstr("was changed since the run wrote it; nothing has been done now")) << how;
    EXPECT_THAT(said, HasSubstr("amble evolve '" + paths_.config.string() + "' --out")) << how;
  }
  EXPECT_EQ(refusal_of(table_), "") << "once a copy is back";
}

TEST_F(TouchedRun, SaysThatRowsOfItsTableAreGoneOrOthersAreThere) {
  const std::map<std::string, Change> edited{
      {"no file", [](auto) { return std::string(); }},
      {"only names", [](auto t) { return t.substr(0, t.find('\n') + 1); }},
      {"no last end", [](auto t) { return t.substr(0, t.size() - 1); }},
      {"a row less", [](auto t) { return t.substr(0, t.rfind('\n', t.size() - 2) + 1); }},
      {"a row twice", [](auto t) { return with_line(t, 2, [](auto l) { return l + "\n" + l; }); }},
      {"a row in between gone",
       [](auto t) { return t.substr(0, t.find("\n1,") + 1) + t.substr(t.find("\n2,") + 1); }},
      {"a comment", [](auto t) { return t + "# a good run\n"; }},
      {"an empty line", [](auto t) { return t + "\n"; }},
      {"a sum", [](auto t) { return t + ",=AVERAGE(B2:B4)\n"; }},
      {"a row of another run", [](auto t) { return t + "7,0.5,0.5\n"; }},
      {"a row that is too long", [](auto t) { return t + "3" + std::string(100, ',') + "\n"; }},
      {"two rows that break off", [](auto t) { return t + "3,0.5\n4"; }},
  };
  for (const auto& [how, change] : edited)
    EXPECT_THAT(refusal_of(change(table_)), HasSubstr("nothing has been done now")) << how;
}

TEST_F(TouchedRun, SaysThatANumberOfItsTableIsAnother) {
  const std::string header = table_.substr(0, table_.find('\n'));
  const auto columns = static_cast<int>(std::ranges::count(header, ',')) + 1;
  const int times = static_cast<int>(std::ranges::count(header.substr(0, header.find(",wall_s")), ',') + 1);
  ASSERT_GT(times, 10);
  for (int column = 1; column < columns; ++column) {
    const std::string changed = with_line(table_, 2, [&](const std::string& line) {
      std::istringstream cells(line);
      std::string value;
      for (int i = 0; i <= column; ++i) std::getline(cells, value, ',');
      value.back() = value.back() == '7' ? '8' : '7';  // as many bytes
      return cell(column, value)(line);
    });
    ASSERT_EQ(changed.size(), table_.size());
    if (column < times)
      EXPECT_THAT(refusal_of(changed), HasSubstr("a number is not the one that the run wrote")) << column;
    else
      EXPECT_EQ(refusal_of(changed), "") << "of times there is no digest, as they differ between runs";
  }
}

TEST_F(TouchedRun, GoesOnWhereAKilledProcessLeftOneRowOrItsBeginning) {
  const std::string row = "3" + table_.substr(table_.rfind("\n2,") + 2);
  for (std::size_t bytes = 0; bytes <= row.size();
       bytes +=
       bytes < 3 || bytes + 1 == row.size() ? 1 : std::min<std::size_t>(40, row.size() - 1 - bytes)) {
    io::write_file(paths_.generations, table_ + row.substr(0, bytes));
    EXPECT_EQ(refusal({}), "") << bytes;
    EXPECT_EQ(io::read_file(paths_.generations), table_);
  }
  EXPECT_EQ(refusal_of(table_ + row + std::string(100, '\0')), "") << "zeros after a power cut";
}

TEST_F(TouchedRun, OfAnEarlierBuildWithoutADigestIsCheckedByItsRows) {
  const auto config = load_config(paths_.config, {});
  RunState state(config, small_problem(config));
  state.progress = load_checkpoint(paths_.checkpoint, config, *state.strategy);
  io::InputFile archive(paths_.folder / "archive.bin");
  state.strategy->restore_log(0, archive, "archive.bin");
  ASSERT_NE(state.progress.csv_digest, 0u);
  state.progress.csv_digest = 0;
  save_checkpoint(paths_.checkpoint, config, state.progress, *state.strategy);
  EXPECT_THAT(refusal_of(replaced(table_, "\n", "\r\n")), HasSubstr("nothing has been done now"));
  EXPECT_THAT(refusal_of(with_line(table_, 2, cell(3, "0.5"))), HasSubstr("nothing has been done now"));
  EXPECT_EQ(refusal_of(table_), "");
  Listener listener(1);
  Run::resume(paths_.folder, 6, 1).execute(listener, listener.stop);
  const std::string longer = io::read_file(paths_.generations);
  EXPECT_THAT(refusal_of(with_line(longer, 2, cell(11, "9"))), HasSubstr("a number is not the one"))
      << "from then on it has one";
}

TEST_F(TouchedRun, SaysThatItsRobotIsAnother) {
  auto robot = load_robot_file(paths_.robot);
  robot.bodies[0].mass_kg += 1e-9;
  const std::string own = io::read_file(paths_.robot);
  io::write_file(paths_.robot, robot_file_text(robot));
  EXPECT_THAT(refusal(), HasSubstr("robot.json: not the robot that the run had"));
  io::write_file(paths_.robot, own);
  EXPECT_EQ(refusal(), "");
}

TEST_F(TouchedRun, KeepsCommentsInItsConfigWhenItIsMadeLonger) {
  const std::string text = io::read_file(paths_.config);
  const std::string noted =
      "# generations = 5 were too few\n" + replaced(text, "generations = ", "generations  =  ");
  io::write_file(paths_.config, noted);
  EXPECT_EQ(refusal(12), "");
  EXPECT_EQ(io::read_file(paths_.config), replaced(noted, "generations  =  3", "generations  =  12"));
  EXPECT_EQ(load_config(paths_.config, {}).generations, 12);
  // Written otherwise, it is still understood, and then written anew.
  io::write_file(paths_.config, replaced(text, "generations = 3", "'generations' = 3"));
  EXPECT_EQ(refusal(13), "");
  EXPECT_EQ(load_config(paths_.config, {}).generations, 13);
}

TEST(TableDigest, IsOfAllColumnsButTimesAndOfTheirOrder) {
  const std::string header = "generation,best,wall_s,outside_s\n";
  const auto digest = [&](const std::string& one, const std::string& other) {
    return table_digest(table_digest(table_digest(0, header, header), header, one), header, other);
  };
  const auto first = digest("0,1.5,0.1,0.2\n", "1,2.5,0.1,0.2\n");
  EXPECT_EQ(first, digest("0,1.5,9,9\n", "1,2.5,8,8\n"));
  EXPECT_NE(first, digest("0,1.6,0.1,0.2\n", "1,2.5,0.1,0.2\n"));
  EXPECT_NE(first, digest("1,2.5,0.1,0.2\n", "0,1.5,0.1,0.2\n"));
  EXPECT_NE(first, 0u);
}

}  // namespace
}  // namespace amble::experiment
