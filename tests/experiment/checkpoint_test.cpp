#include "amble/experiment/checkpoint.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "amble/core/error.hpp"
#include "amble/core/random.hpp"
#include "amble/experiment/run_files.hpp"
#include "amble/io/file.hpp"
#include "tests/experiment/fixture.hpp"

namespace amble::experiment {
namespace {

using testing::HasSubstr;

/// A score for each candidate, the same in every generation.
void advance(search::Strategy& strategy) {
  std::vector<search::Evaluation> evaluations;
  for (std::size_t i = 0; i < strategy.ask().size(); ++i)
    evaluations.push_back({.objective = static_cast<double>(i % 7), .behaviour = {}});
  strategy.tell(evaluations);
}

class Checkpoint : public testing::Test {
 protected:
  Checkpoint() {
    for (int i = 0; i < 3; ++i) advance(*state_.strategy);
    state_.progress = {.best = 2.5,
                       .best_generation = 1,
                       .evaluations = 120,
                       .steps = 9999,
                       .wall_s = 1.5,
                       .csv_bytes = 321};
    save_checkpoint(path_, config_, state_.progress, *state_.strategy);
    bytes_ = io::read_file(path_);
  }

  /// The message when these bytes are loaded; "" if they are accepted.
  std::string error_of(const std::string& bytes) {
    io::write_file(path_, bytes);
    const RunState other(config_, problem_);
    try {
      load_checkpoint(path_, config_, *other.strategy);
    } catch (const UserError& error) {
      EXPECT_EQ(error.code(), ExitCode::bad_file);
      return error.what();
    }
    return "";
  }

  TemporaryFolder scratch_;
  std::filesystem::path path_ = scratch_ / "checkpoint.bin";
  Config config_ = small_config();
  Problem problem_ = small_problem();
  RunState state_ = RunState(config_, problem_);
  std::string bytes_;
};

TEST_F(Checkpoint, RestoresProgressAndPopulation) {
  const RunState other(config_, problem_);
  const auto progress = load_checkpoint(path_, config_, *other.strategy);
  EXPECT_EQ(progress.best, 2.5);
  EXPECT_EQ(progress.best_generation, 1);
  EXPECT_EQ(progress.evaluations, 120u);
  EXPECT_EQ(progress.steps, 9999u);
  EXPECT_EQ(progress.wall_s, 1.5);
  EXPECT_EQ(progress.csv_bytes, 321u);
  EXPECT_EQ(other.strategy->round(), 3);
  ASSERT_TRUE(std::ranges::equal(other.strategy->ask(), state_.strategy->ask()));
  advance(*other.strategy);
  advance(*state_.strategy);
  EXPECT_TRUE(std::ranges::equal(other.strategy->ask(), state_.strategy->ask()));
}

TEST_F(Checkpoint, OfTheVersionBeforeIsReadAsOneWithoutADigestOfTheTable) {
  constexpr std::size_t header = 28, digest_at = header + 8 + 8 + 4 + 8 + 8 + 8 + 8;
  const std::string payload =
      bytes_.substr(header, digest_at - header) + bytes_.substr(digest_at + sizeof(std::uint64_t));
  EXPECT_EQ(error_of(io::seal("AMBLECKP", undigested_checkpoint_version, payload)), "");
  const RunState other(config_, problem_);
  const Progress progress = load_checkpoint(path_, config_, *other.strategy);
  EXPECT_EQ(progress.csv_bytes, state_.progress.csv_bytes);
  EXPECT_EQ(progress.csv_digest, 0u);
  EXPECT_NE(error_of(io::seal("AMBLECKP", 2, payload)), "");
}

TEST_F(Checkpoint, IsRefusedWhenTruncatedAnywhere) {
  for (std::size_t length = 0; length < bytes_.size(); length += 1 + bytes_.size() / 50)
    EXPECT_THAT(error_of(bytes_.substr(0, length)), HasSubstr("checkpoint.bin")) << length;
}

TEST_F(Checkpoint, IsRefusedWhenAnyByteIsAltered) {
  for (std::size_t at = 0; at < bytes_.size(); at += 1 + bytes_.size() / 50) {
    auto altered = bytes_;
    altered[at] = static_cast<char>(altered[at] ^ 1);
    EXPECT_THAT(error_of(altered), HasSubstr("checkpoint.bin")) << at;
  }
}

TEST_F(Checkpoint, OfAnotherConfigIsRefused) {
  config_.neat.mutation.add_node_share = 0.02;
  EXPECT_THAT(error_of(bytes_), HasSubstr("written under another config.toml"));
}

TEST_F(Checkpoint, MayBeContinuedForMoreGenerations) {
  config_.generations = 500;
  EXPECT_EQ(error_of(bytes_), "");
}

TEST_F(Checkpoint, ReaderThrowsNothingButUserErrorsForDamageUnderAValidChecksum) {
  // Seal damaged payloads anew, so that the reader itself is met.
  constexpr std::size_t header = 28;
  for (std::uint32_t round = 0; round < 300; ++round) {
    Stream stream(1, Purpose::test, 1, round);
    std::string payload = bytes_.substr(header);
    for (std::uint32_t i = 0; i < 1 + stream.below(6); ++i)
      payload[8 + stream.below(static_cast<std::uint32_t>(payload.size() - 8))] =
          static_cast<char>(stream.below(256));
    if (stream.chance(0.3)) payload.resize(stream.below(static_cast<std::uint32_t>(payload.size())));
    error_of(
        io::seal("AMBLECKP", round % 2 == 0 ? checkpoint_version : undigested_checkpoint_version, payload));
  }
}

TEST_F(Checkpoint, HoldsTheThresholdOfNoveltySearch) {
  config_ =
      small_novelty_config({"search.novelty.first_members=40", "search.novelty.count_first_members=true"});
  const RunState first(config_, problem_), second(config_, problem_);
  const std::vector<float> still(config_.make_behaviour()->length());
  const std::vector<search::Evaluation> evaluations(40, {.objective = 0.0, .behaviour = still});
  first.strategy->tell(evaluations);
  io::write_file(scratch_ / "archive.bin", first.strategy->take_log_growth(0));
  save_checkpoint(path_, config_, {}, *first.strategy);

  load_checkpoint(path_, config_, *second.strategy);
  io::InputFile file(scratch_ / "archive.bin");
  second.strategy->restore_log(0, file, "archive.bin");
  second.strategy->tell(evaluations);
  const auto metrics = second.strategy->metrics();
  const auto value = [&metrics](std::string_view name) {
    return std::ranges::find(metrics, name, &search::Metric::name)->value;
  };
  EXPECT_EQ(value("novelty_threshold"), 0.5 * 1.2);
  EXPECT_EQ(value("archive"), 40.0);
}

TEST_F(Checkpoint, HasNumbersThatAreFinite) {
  const auto refusal = [&](double best, double wall_s) {
    Progress progress = state_.progress;
    progress.best = best;
    progress.wall_s = wall_s;
    return error_of(checkpoint_bytes(config_, progress, *state_.strategy));
  };
  EXPECT_EQ(refusal(-1e300, 1e300), "");
  for (const double number : {HUGE_VAL, -HUGE_VAL, std::nan("")}) {
    EXPECT_NE(refusal(number, 1.0).find("a number that is not finite"), std::string::npos) << number;
    EXPECT_NE(refusal(1.0, number).find("a number that is not finite"), std::string::npos) << number;
  }
}

}  // namespace
}  // namespace amble::experiment
