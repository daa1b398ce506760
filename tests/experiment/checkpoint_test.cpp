#include "amble/experiment/checkpoint.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "amble/core/error.hpp"
#include "amble/core/random.hpp"
#include "amble/io/file.hpp"
#include "tests/experiment/fixture.hpp"

namespace amble::experiment {
namespace {

using testing::HasSubstr;

class Checkpoint : public testing::Test {
 protected:
  Checkpoint() {
    for (int i = 0; i < 3; ++i) population_.advance(some_fitness());
    save_checkpoint(path_, config_,
                    {.best_m = 2.5,
                     .best_generation = 1,
                     .evaluations = 120,
                     .steps = 9999,
                     .wall_s = 1.5,
                     .csv_bytes = 321},
                    population_, *search_);
    bytes_ = io::read_file(path_);
  }

  std::vector<neat::Fitness> some_fitness() const {
    std::vector<neat::Fitness> fitness;
    for (std::size_t i = 0; i < population_.genomes().size(); ++i) {
      const auto value = static_cast<double>(i % 7);
      fitness.push_back({value, value});
    }
    return fitness;
  }

  Progress load(neat::Population& population) const {
    return load_checkpoint(path_, config_, population, *search_);
  }

  /// The message when these bytes are loaded; "" if they are accepted.
  std::string complaint(const std::string& bytes) {
    io::write_file(path_, bytes);
    auto population = small_population(problem_);
    try {
      load(population);
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
  neat::Population population_ = small_population(problem_);
  std::unique_ptr<search::Search> search_ = search::make_search(config_.search, config_.behaviour_length());
  std::string bytes_;
};

TEST_F(Checkpoint, RestoresProgressAndPopulation) {
  auto other = small_population(problem_);
  const auto progress = load(other);
  EXPECT_EQ(progress.best_m, 2.5);
  EXPECT_EQ(progress.best_generation, 1);
  EXPECT_EQ(progress.evaluations, 120u);
  EXPECT_EQ(progress.steps, 9999u);
  EXPECT_EQ(progress.csv_bytes, 321u);
  EXPECT_EQ(other.generation(), 3);
  ASSERT_TRUE(std::ranges::equal(other.genomes(), population_.genomes()));
  other.advance(some_fitness());
  population_.advance(some_fitness());
  EXPECT_TRUE(std::ranges::equal(other.genomes(), population_.genomes()));
}

TEST_F(Checkpoint, IsRefusedWhenTruncatedAnywhere) {
  for (std::size_t length = 0; length < bytes_.size(); length += 1 + bytes_.size() / 50)
    EXPECT_THAT(complaint(bytes_.substr(0, length)), HasSubstr("checkpoint.bin")) << length;
}

TEST_F(Checkpoint, IsRefusedWhenAnyByteIsAltered) {
  for (std::size_t at = 0; at < bytes_.size(); at += 1 + bytes_.size() / 50) {
    auto altered = bytes_;
    altered[at] = static_cast<char>(altered[at] ^ 1);
    EXPECT_THAT(complaint(altered), HasSubstr("checkpoint.bin")) << at;
  }
}

TEST_F(Checkpoint, OfAnotherConfigIsRefused) {
  config_.neat.mutation.add_node_share = 0.02;
  EXPECT_THAT(complaint(bytes_), HasSubstr("written under another config.toml"));
}

TEST_F(Checkpoint, MayBeContinuedForMoreGenerations) {
  config_.generations = 500;
  EXPECT_EQ(complaint(bytes_), "");
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
    complaint(io::seal("AMBLECKP", 2, payload));
  }
}

TEST_F(Checkpoint, HoldsTheThresholdOfNoveltySearch) {
  config_ =
      small_novelty_config({"search.novelty.first_members=40", "search.novelty.count_first_members=true"});
  const auto make = [&] { return search::make_search(config_.search, config_.behaviour_length()); };
  const auto search = make();
  const std::vector<float> still(config_.behaviour_length());
  search->judge(std::vector<search::Evaluation>(40, {.objective = 0.0, .behaviour = still}));
  io::write_file(scratch_ / "archive.bin", search->take_archive_growth());
  save_checkpoint(path_, config_, {}, population_, *search);

  const auto again = make();
  auto population = small_population(problem_);
  load_checkpoint(path_, config_, population, *again);
  io::InputFile file(scratch_ / "archive.bin");
  again->restore_archive(file, "archive.bin");
  again->judge(std::vector<search::Evaluation>(1, {.objective = 0.0, .behaviour = still}));
  EXPECT_EQ(again->novelty_statistics()->threshold, 0.5 * 1.2);
  EXPECT_EQ(again->novelty_statistics()->archive_members, 40u);
}

}  // namespace
}  // namespace amble::experiment
