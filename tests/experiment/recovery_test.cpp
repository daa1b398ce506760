#include "amble/experiment/run_files.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <string>

#include "amble/experiment/champion.hpp"
#include "amble/io/file.hpp"
#include "tests/experiment/fixture.hpp"

// What a run does not go on without.
namespace amble::experiment {
namespace {

class Recovered : public testing::Test {
 protected:
  /// A run of this many generations that may go on for more.
  void run(int generations) {
    Listener listener(generations);
    ASSERT_EQ(Run::start(folder(), small_config({"engine=batch"}), 1).execute(listener, listener.stop),
              RunStatus::interrupted);
    best_ = paths().champion_files().back();
  }
  std::filesystem::path folder() const { return scratch_ / "run"; }
  RunPaths paths() const { return RunPaths(folder()); }

  /// The message with which resuming fails, or "".
  std::string refusal() const {
    try {
      Run::resume(folder(), {}, 1);
    } catch (const UserError& error) {
      EXPECT_EQ(error.code(), ExitCode::bad_file);
      return error.what();
    }
    return "";
  }

  TemporaryFolder scratch_;
  std::filesystem::path best_;
};

TEST_F(Recovered, RunNeedsItsBestChampionWhicheverGenerationItIsOf) {
  for (const int generations : {1, 2}) {
    std::filesystem::remove_all(folder());
    run(generations);
    EXPECT_EQ(refusal(), "");
    std::filesystem::rename(best_, scratch_ / "away");
    EXPECT_NE(refusal().find("missing, and it is the best of the run so far"), std::string::npos)
        << generations;
    std::filesystem::rename(scratch_ / "away", best_);
    EXPECT_EQ(refusal(), "");
  }
}

TEST_F(Recovered, RunNeedsItsOwnBestChampionAndNoOther) {
  run(2);
  const Champion own = load_champion(best_);
  const auto refused_with = [&](auto change) {
    Champion other = own;
    change(other);
    io::write_file(best_, champion_text(other));
    const std::string found = refusal();
    io::write_file(best_, champion_text(own));
    return found.find("not the champion that the run had there") != std::string::npos;
  };
  EXPECT_FALSE(refused_with([](Champion&) {}));
  EXPECT_TRUE(refused_with([](Champion& other) { ++other.seed; }));
  EXPECT_TRUE(refused_with([](Champion& other) { ++other.generation; }));
  EXPECT_TRUE(refused_with([](Champion& other) { other.result.distance_m += 1e-12; }));
  EXPECT_EQ(refusal(), "");
}

}  // namespace
}  // namespace amble::experiment
