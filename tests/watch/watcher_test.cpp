#include "amble/watch/watcher.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <memory>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "amble/core/error.hpp"
#include "amble/io/json_file.hpp"
#include "tests/watch/fake_run.hpp"

namespace amble::watch {
namespace {

using namespace std::chrono_literals;
using testing::ElementsAre;
using testing::HasSubstr;

struct Event {
  std::string name;
  io::Json data;
};

/// What a page hears.
class Page {
 public:
  Page(Watcher& watcher, const std::string& run) : reader_(watcher.read(run)) {}

  /// Reads until an event of that name for which `is_it` holds has come; false if none comes in ten seconds.
  template <typename IsIt>
  bool hears(const std::string& name, IsIt is_it) {
    for (int i = 0; i < 100; ++i) {
      while (at_ < events.size())
        if (const Event& event = events[at_++]; event.name == name && is_it(event.data)) return true;
      if (!read()) return false;
    }
    return false;
  }
  bool hears(const std::string& name) {
    return hears(name, [](const io::Json&) { return true; });
  }
  /// The lines of the table as far as they have come.
  std::vector<std::string> lines() const {
    std::vector<std::string> all;
    for (const Event& event : events) {
      if (event.name == "begin") all = {event.data.at("header").get<std::string>()};
      if (event.name == "rows")
        for (const auto& line : event.data.at("lines")) all.push_back(line);
    }
    return all;
  }
  bool read() {
    const auto text = reader_->next(100ms);
    ended = !text;
    if (ended) return false;
    std::string_view rest = *text;
    while (!rest.empty()) {
      EXPECT_TRUE(rest.starts_with("event: "));
      const std::size_t line = rest.find('\n'), end = rest.find("\n\n");
      events.push_back(
          {std::string(rest.substr(7, line - 7)), io::Json::parse(rest.substr(line + 7, end - line - 7))});
      rest.remove_prefix(end + 2);
    }
    return true;
  }

  std::vector<Event> events;
  bool ended = false;

 private:
  std::unique_ptr<Watcher::Reader> reader_;
  std::size_t at_ = 0;
};

TEST(Watcher, TellsGenerationsInOrderAsTheyCome) {
  const test::TemporaryFolder scratch;
  FakeRun run(scratch / "run", 1000);
  run.grow(0.0);
  Watcher watcher(scratch / "run");
  Page page(watcher, ".");
  ASSERT_TRUE(page.hears("rows"));
  for (int i = 1; i < 700; ++i) run.grow(0.01 * i);
  ASSERT_TRUE(page.hears("runs", [](const io::Json& data) { return data["runs"][0]["done"] == 700; }));
  while (page.lines().size() < 701) ASSERT_TRUE(page.read());
  const auto lines = page.lines();
  for (int i = 0; i < 700; ++i)
    ASSERT_TRUE(lines[static_cast<std::size_t>(i) + 1].starts_with(std::to_string(i) + ",")) << i;
}

TEST(Watcher, APageThatComesLateHearsTheSame) {
  const test::TemporaryFolder scratch;
  FakeRun run(scratch / "run", 1000);
  for (int i = 0; i < 1200; ++i) run.grow(0.01 * i);
  Watcher watcher(scratch / "run");
  Page first(watcher, "."), second(watcher, ".");
  for (Page* page : {&first, &second})
    while (page->lines().size() < 1201) ASSERT_TRUE(page->read());
  EXPECT_EQ(first.lines(), second.lines());
  EXPECT_EQ(watcher.readers(), 2);
}

TEST(Watcher, ATableThatIsCutBackBeginsAnew) {
  const test::TemporaryFolder scratch;
  FakeRun run(scratch / "run", 10);
  run.grow(0.5);
  const auto bytes = std::filesystem::file_size(scratch / "run/generations.csv");
  run.grow(0.6);
  Watcher watcher(scratch / "run");
  Page page(watcher, ".");
  ASSERT_TRUE(page.hears("rows"));
  std::filesystem::resize_file(scratch / "run/generations.csv", bytes);
  ASSERT_TRUE(page.hears("begin"));
  while (page.lines().size() < 2) ASSERT_TRUE(page.read());
  EXPECT_EQ(page.lines().size(), 2U);
}

TEST(Watcher, AFolderThatVanishesIsToldAndItsReturnToo) {
  const test::TemporaryFolder scratch;
  FakeRun run(scratch / "run", 10);
  run.grow(0.5);
  Watcher watcher(scratch / "run");
  Page page(watcher, ".");
  ASSERT_TRUE(page.hears("rows"));
  std::filesystem::rename(scratch / "run", scratch / "elsewhere");
  ASSERT_TRUE(page.hears("runs", [](const io::Json& data) { return data["runs"][0]["stage"] == "gone"; }));
  ASSERT_TRUE(watcher.is_gone());
  const auto gone = [&page](bool value) {
    return std::ranges::any_of(page.events, [value](const Event& event) {
      return event.name == "folder" && event.data["gone"] == value;
    });
  };
  EXPECT_TRUE(gone(true));
  page.events.clear();
  std::filesystem::rename(scratch / "elsewhere", scratch / "run");
  for (int i = 0; i < 100 && !gone(false); ++i) ASSERT_TRUE(page.read());
  EXPECT_TRUE(gone(false));
}

TEST(Watcher, TheEndComesAfterAllThatWasBefore) {
  const test::TemporaryFolder scratch;
  FakeRun run(scratch / "run", 2);
  run.grow(0.5);
  Watcher watcher(scratch / "run");
  Page page(watcher, ".");
  ASSERT_TRUE(page.hears("rows"));
  run.grow(0.6);
  watcher.end("The run has ended");
  EXPECT_FALSE(page.hears("nothing"));
  EXPECT_TRUE(page.ended);
  EXPECT_EQ(page.events.back().name, "end");
  EXPECT_EQ(page.events.back().data.at("text"), "The run has ended");
  EXPECT_EQ(page.lines().size(), 3U);
}

TEST(Watcher, OfAFolderOfRunsTellsOfAllAndFindsNewOnes) {
  const test::TemporaryFolder scratch;
  FakeRun first(scratch / "runs/supg-001", 10), second(scratch / "runs/sine-001", 10);
  first.grow(0.5);
  Watcher watcher(scratch.path());
  Page page(watcher, "runs/supg-001");
  ASSERT_TRUE(page.hears("rows"));
  EXPECT_EQ(page.lines().size(), 2U);
  FakeRun third(scratch / "runs/ctrnn-001", 10);
  ASSERT_TRUE(
      page.hears("runs", [](const io::Json& data) { return data["runs"][0]["id"] == "runs/ctrnn-001"; }));
  std::vector<std::string> ids;
  const io::Json overview = io::Json::parse(watcher.overview());
  for (const auto& run : overview["runs"]) ids.push_back(run["id"]);
  EXPECT_THAT(ids, ElementsAre("runs/ctrnn-001", "runs/sine-001", "runs/supg-001"));
}

TEST(Watcher, ARunThatBeginsInAFolderThatWasEmptyIsTold) {
  const test::TemporaryFolder scratch;
  Watcher watcher(scratch.path());
  Page page(watcher, ".");
  ASSERT_TRUE(page.hears("folder"));
  FakeRun run(scratch.path(), 10);
  run.grow(0.5);
  ASSERT_TRUE(page.hears("folder", [](const io::Json& data) { return data["single"] == true; }));
  while (page.lines().size() < 2) ASSERT_TRUE(page.read());
  EXPECT_EQ(watcher.summaries().size(), 1U);
}

TEST(Watcher, GivesChampionsAndTablesOfItsRunsAndNothingElse) {
  const test::TemporaryFolder scratch;
  FakeRun run(scratch / "run", 10);
  run.grow(0.5);
  run.champion(0, "the first");
  run.champion(3, "the fourth");
  std::ofstream(scratch / "secret.json") << "secret";
  const Watcher watcher(scratch / "run");
  EXPECT_EQ(watcher.champion(".", std::nullopt), "the fourth");
  EXPECT_EQ(watcher.champion(".", 0), "the first");
  EXPECT_THAT(watcher.table("."), HasSubstr("\n0,"));
  EXPECT_EQ(watcher.champion(".", 1), "");
  EXPECT_EQ(watcher.champion(".", -1), "");
  for (const char* id : {"", "..", "../run", "./", "/", "run"}) {
    EXPECT_EQ(watcher.champion(id, 0), "") << id;
    EXPECT_EQ(watcher.table(id), "") << id;
  }
}

TEST(Watcher, AFolderThatIsNotThereIsRefused) {
  try {
    const Watcher watcher("/no/such/folder");
    FAIL();
  } catch (const UserError& error) {
    EXPECT_THAT(error.what(), HasSubstr("/no/such/folder: no such folder"));
  }
}

TEST(Watcher, WritesNothing) {
  const test::TemporaryFolder scratch;
  FakeRun run(scratch / "run", 10);
  run.grow(0.5);
  {
    Watcher watcher(scratch / "run");
    Page page(watcher, ".");
    ASSERT_TRUE(page.hears("rows"));
  }
  std::set<std::string> names;
  for (const auto& entry : std::filesystem::directory_iterator(scratch / "run"))
    names.insert(entry.path().filename());
  EXPECT_THAT(names, ElementsAre("champions", "config.toml", "generations.csv", "robot.json"));
}

}  // namespace
}  // namespace amble::watch
