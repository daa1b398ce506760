#include "amble/search/novelty.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "amble/core/error.hpp"
#include "tests/io/temporary_folder.hpp"
#include "tests/search/naive_novelty.hpp"
#include "tests/search/samples.hpp"

namespace amble::search {
namespace {

using testing::ElementsAre;

/// Candidates are added by the rule under test only, and behaviours are single numbers.
NoveltySettings plain_settings() {
  NoveltySettings settings;
  settings.threshold = 1e9;
  settings.first_members = 0;
  return settings;
}

/// A generation of one-number behaviours: their novelties.
std::vector<double> judge(NoveltySearch& search, const std::vector<float>& positions) {
  Rows rows;
  for (const float position : positions) rows.push_back({position});
  std::vector<double> novelties;
  for (const auto& fitness : search.fitness_of(evaluations(rows))) novelties.push_back(fitness.selection);
  return novelties;
}

TEST(NoveltySearch, AddsTheFirstMembersWhateverTheirNoveltyAndNoneAfterThem) {
  auto settings = plain_settings();
  settings.first_members = 15;
  NoveltySearch search(settings, 1);
  judge(search, std::vector<float>(14, 1.0f));
  EXPECT_EQ(search.archive().rows(), 14u);
  judge(search, {1.0f, 1.0f, 2.0f});
  EXPECT_EQ(search.archive().rows(), 15u);
}

TEST(NoveltySearch, AdmitsCandidatesMoreNovelThanTheThresholdAndNotThoseEqualToIt) {
  auto settings = plain_settings();
  settings.first_members = 1;
  settings.threshold = 9.0;
  NoveltySearch search(settings, 1);
  judge(search, {0.0f, 3.0f});
  EXPECT_EQ(search.archive().rows(), 1u);
  judge(search, {3.001f});
  EXPECT_EQ(search.archive().rows(), 2u);
}

TEST(NoveltySearch, CountsNothingForAbsentNeighbours) {
  auto settings = plain_settings();
  settings.first_members = 3;
  NoveltySearch search(settings, 1);
  EXPECT_THAT(judge(search, {0.0f, 3.0f, 5.0f}), ElementsAre(0.0, 9.0, 25.0 + 4.0));
}

TEST(NoveltySearch, AddsUpTheNearestOnly) {
  auto settings = plain_settings();
  settings.first_members = 4;
  settings.neighbours = 2;
  NoveltySearch search(settings, 1);
  judge(search, {0.0f, 10.0f, 12.0f, 100.0f});
  EXPECT_THAT(judge(search, {11.0f, 0.0f, 13.0f}), ElementsAre(1.0 + 1.0, 0.0 + 100.0, 1.0 + 9.0));
}

TEST(NoveltySearch, AddsUpRootsWhereDistancesAreRooted) {
  auto settings = plain_settings();
  settings.first_members = 2;
  settings.distance = Distance::root;
  NoveltySearch search(settings, 1);
  judge(search, {0.0f, 3.0f});
  EXPECT_THAT(judge(search, {5.0f}), ElementsAre(5.0 + 2.0));
}

TEST(NoveltySearch, ShowsThoseWhoJoinToThoseAfterThem) {
  auto settings = plain_settings();
  settings.first_members = 1;
  settings.threshold = 3.0;
  NoveltySearch search(settings, 1);
  // 0 joins as the first; 1 is too close; 2 joins; the last is compared with 0 and 2.
  EXPECT_THAT(judge(search, {0.0f, 1.0f, 2.0f, 1.0f}), ElementsAre(0.0, 1.0, 4.0, 1.0 + 1.0));
  EXPECT_EQ(search.archive().rows(), 2u);
}

TEST(NoveltySearch, ComparesWithAllOfTheGenerationButOneselfAndCountsMembersOfBothOnce) {
  auto settings = plain_settings();
  settings.compare_with = Neighbours::archive_and_population;
  settings.first_members = 1;
  NoveltySearch search(settings, 1);
  EXPECT_THAT(judge(search, {0.0f, 1.0f, 3.0f}), ElementsAre(1.0 + 9.0, 1.0 + 4.0, 9.0 + 4.0));
  EXPECT_EQ(search.archive().rows(), 1u);
  // Now with the archive, {0}: the same behaviour judged again is one of it, and one of the population.
  EXPECT_THAT(judge(search, {0.0f, 1.0f}), ElementsAre(0.0 + 1.0, 1.0 + 1.0));
}

TEST(NoveltySearch, RaisesTheThresholdAfterMoreThanFourJoined) {
  for (const int joining : {4, 5}) {
    auto settings = plain_settings();
    settings.first_members = joining;
    settings.count_first_members = true;
    settings.threshold = 100.0;
    NoveltySearch search(settings, 1);
    judge(search, std::vector<float>(10, 1.0f));
    EXPECT_EQ(search.threshold(), joining > 4 ? 100.0 * 1.2 : 100.0) << joining;
  }
}

TEST(NoveltySearch, CountsCandidatesAddedBelowTheThresholdOnlyIfSet) {
  for (const bool count : {false, true}) {
    auto settings = plain_settings();
    settings.first_members = 15;
    settings.count_first_members = count;
    settings.threshold = 1000.0;
    NoveltySearch search(settings, 1);
    judge(search, std::vector<float>(20, 1.0f));
    EXPECT_EQ(search.archive().rows(), 15u);
    EXPECT_EQ(search.threshold(), count ? 1000.0 * 1.2 : 1000.0) << "after the first generation";
    // With or without that one, it is the fourth generation in a row without anybody new that lowers it.
    double expected = search.threshold();
    for (int generation = 2; generation <= 5; ++generation) {
      judge(search, {1.0f});
      if (generation >= (count ? 5 : 4)) expected *= 0.8;
      EXPECT_EQ(search.threshold(), expected) << generation;
    }
  }
}

TEST(NoveltySearch, CountsFirstMembersThatExceedTheThreshold) {
  auto settings = plain_settings();
  settings.first_members = 15;
  settings.threshold = 3.0;
  NoveltySearch search(settings, 1);
  // 0 joins uncounted; the others do so with novelties of 4 and more.
  judge(search, {0.0f, 2.0f, 4.0f, 8.0f, 16.0f});
  EXPECT_EQ(search.threshold(), 3.0) << "four are not more than four";
  judge(search, {64.0f, 128.0f, 256.0f, 512.0f, 1024.0f});
  EXPECT_EQ(search.threshold(), 3.0 * 1.2);
}

TEST(NoveltySearch, LowersTheThresholdFromTheFourthEmptyGenerationOnInEach) {
  NoveltySearch search(plain_settings(), 1);
  double expected = 1e9;
  for (int generation = 1; generation <= 7; ++generation) {
    judge(search, {1.0f, 2.0f});
    if (generation >= 4) expected *= 0.8;
    EXPECT_EQ(search.threshold(), expected) << generation;
  }
}

TEST(NoveltySearch, NeverRaisesAThresholdThatBeganBelowTheLowest) {
  auto settings = plain_settings();
  settings.threshold = 5.0;
  settings.lowest_threshold = 9.0;
  settings.first_members = 1;
  NoveltySearch search(settings, 1);
  for (int generation = 1; generation <= 7; ++generation) {
    judge(search, {1.0f, 1.0f});
    EXPECT_EQ(search.threshold(), 5.0) << generation;
  }
}

TEST(NoveltySearch, CountsEmptyGenerationsAnewAfterOneThatWasNot) {
  auto settings = plain_settings();
  settings.first_members = 1;
  settings.count_first_members = true;
  settings.threshold = 10.0;
  NoveltySearch search(settings, 1);
  judge(search, {0.0f});
  for (int i = 0; i < 3; ++i) judge(search, {1.0f});
  judge(search, {4.0f});
  for (int i = 0; i < 3; ++i) judge(search, {1.0f});
  EXPECT_EQ(search.threshold(), 10.0);
  judge(search, {1.0f});
  EXPECT_EQ(search.threshold(), 10.0 * 0.8);
}

TEST(NoveltySearch, FollowsLehmansRulesWithLehmansNumbers) {
  auto settings = plain_settings();
  settings.threshold = 0.27;
  settings.lower_after = 10;
  settings.lowering = Lowering::count_anew;
  settings.lower_factor = 0.95;
  settings.lowest_threshold = 0.25;
  NoveltySearch search(settings, 1);
  for (int generation = 1; generation <= 40; ++generation) {
    judge(search, {1.0f});
    const double expected = generation < 10 ? 0.27 : generation < 20 ? 0.27 * 0.95 : 0.25;
    EXPECT_EQ(search.threshold(), expected) << generation;
  }
}

TEST(NoveltySearch, AddsNoneToAFullArchive) {
  auto settings = plain_settings();
  settings.first_members = 15;
  settings.archive_limit = 3;
  NoveltySearch search(settings, 1);
  judge(search, {0.0f, 1.0f, 2.0f, 1e6f});
  EXPECT_EQ(search.archive().rows(), 3u);
  EXPECT_GT(judge(search, {1e6f})[0], search.threshold());
  EXPECT_EQ(search.archive().rows(), 3u);
}

TEST(NoveltySearch, SelectsByNoveltyAndLeavesTheObjectiveToElitism) {
  auto settings = plain_settings();
  settings.first_members = 1;
  NoveltySearch search(settings, 1);
  const Rows rows{{0.0f}, {2.0f}};
  const auto fitness = search.fitness_of(std::vector<Evaluation>{{7.5, rows[0]}, {0.25, rows[1]}});
  EXPECT_EQ(fitness[0].objective, 7.5);
  EXPECT_EQ(fitness[1].objective, 0.25);
  EXPECT_EQ(fitness[0].selection, 0.0);
  EXPECT_EQ(fitness[1].selection, 4.0);
}

TEST(NoveltySearch, ReportsTheThresholdThatItsGenerationHadToExceed) {
  auto settings = plain_settings();
  settings.first_members = 5;
  settings.count_first_members = true;
  settings.threshold = 50.0;
  NoveltySearch search(settings, 1);
  const auto names = [&search] {
    std::vector<std::string_view> columns;
    for (const Metric& reading : search.metrics()) columns.push_back(reading.name);
    return columns;
  };
  EXPECT_THAT(names(), ElementsAre("archive", "novelty_threshold", "best_novelty"))
      << "columns of a table, known before the first generation";
  judge(search, {0.0f, 1.0f, 2.0f, 3.0f, 4.0f});
  EXPECT_THAT(names(), ElementsAre("archive", "novelty_threshold", "best_novelty"));
  const auto metrics = search.metrics();
  EXPECT_EQ(metrics[0].value, 5.0);
  EXPECT_EQ(metrics[1].value, 50.0);
  EXPECT_EQ(search.threshold(), 60.0);
  EXPECT_EQ(metrics[2].value, 16.0 + 9.0 + 4.0 + 1.0);
}

/// What a process that goes on from `search` and its archive's file has.
NoveltySearch reloaded(NoveltySearch& search, const NoveltySettings& settings) {
  const test::TemporaryFolder folder;
  io::InputFile file(folder.put("archive.bin", search.take_archive_growth()));
  io::BinaryWriter writer;
  search.save(writer);
  const std::string bytes = writer.bytes();
  NoveltySearch loaded(settings, 1);
  io::BinaryReader reader(bytes, "checkpoint.bin");
  loaded.load(reader);
  reader.finish();
  loaded.restore_archive(file, "archive.bin");
  return loaded;
}

TEST(NoveltySearch, ComesBackFromACheckpointWithItsEmptyGenerations) {
  for (const auto lowering : {Lowering::each_generation, Lowering::count_anew})
    for (int empty = 0; empty <= 6; ++empty) {
      auto settings = plain_settings();
      settings.first_members = 3;
      settings.count_first_members = true;
      settings.lowering = lowering;
      NoveltySearch search(settings, 1);
      judge(search, {3.0f, 1.0f, 2.0f});
      for (int generation = 0; generation < empty; ++generation) judge(search, {1.0f});
      const double threshold = search.threshold();
      const std::vector<float> archive{3.0f, 1.0f, 2.0f};

      auto loaded = reloaded(search, settings);
      EXPECT_EQ(loaded.threshold(), threshold);
      ASSERT_EQ(loaded.archive().rows(), archive.size());
      for (std::size_t i = 0; i < archive.size(); ++i) EXPECT_EQ(loaded.archive().row(i)[0], archive[i]);
      // The generations until the threshold is lowered tell how many empty ones are on the count: it is the
      // fourth that lowers it.
      double expected = threshold;
      for (int generation = empty + 1; generation <= empty + 6; ++generation) {
        if (lowering == Lowering::each_generation ? generation >= 4 : generation % 4 == 0) expected *= 0.8;
        judge(loaded, {1.0f});
        EXPECT_EQ(loaded.threshold(), expected) << empty << " before, " << generation;
      }
    }
}

NoveltySettings random_settings(Stream& stream) {
  NoveltySettings settings;
  settings.distance = stream.chance(0.5) ? Distance::squared : Distance::root;
  settings.compare_with = stream.chance(0.5) ? Neighbours::archive : Neighbours::archive_and_population;
  settings.neighbours = 1 + static_cast<int>(stream.below(20));
  settings.threshold = std::pow(10.0, stream.uniform(-2.0, 4.0));
  settings.first_members = static_cast<int>(stream.below(20));
  settings.count_first_members = stream.chance(0.5);
  settings.lower_after = 1 + static_cast<int>(stream.below(4));
  settings.lowering = stream.chance(0.5) ? Lowering::each_generation : Lowering::count_anew;
  settings.archive_limit = stream.chance(0.2) ? 1 + static_cast<int>(stream.below(30)) : 1000;
  return settings;
}

TEST(NoveltySearch, EqualsItsNaiveTwinForBehavioursOfAllShapes) {
  for (std::uint32_t round = 0; round < 400; ++round) {
    Stream stream(1, Purpose::test, 0, round);
    const auto settings = random_settings(stream);
    const Shape shape = shapes[round % shapes.size()];
    const std::size_t length = 1 + stream.below(50);
    NoveltySearch search(settings, length);
    NaiveNovelty twin(settings);
    for (int generation = 0; generation < 6; ++generation) {
      const auto rows = random_rows(shape, 1 + stream.below(25), length, stream);
      const auto fitness = search.fitness_of(evaluations(rows));
      const auto expected = twin.fitness_of(rows);
      for (std::size_t i = 0; i < rows.size(); ++i) {
        const bool exact = shape == Shape::small_whole_numbers;
        ASSERT_NEAR(fitness[i].selection, expected[i], exact ? 0.0 : 1e-13 * expected[i]) << round;
      }
      ASSERT_EQ(search.threshold(), twin.threshold) << round;
      ASSERT_EQ(search.archive().rows(), twin.archive.size()) << round;
    }
    for (std::size_t member = 0; member < twin.archive.size(); ++member)
      ASSERT_TRUE(std::ranges::equal(search.archive().row(member), twin.archive[member])) << round;
  }
}

TEST(NoveltySearch, EqualsItsNaiveTwinOnPathsOfFullLength) {
  NoveltySettings settings;
  settings.threshold = 10.0;
  NoveltySearch search(settings, 1500);
  NaiveNovelty twin(settings);
  Stream stream(2, Purpose::test);
  for (int generation = 0; generation < 4; ++generation) {
    const auto rows = random_rows(Shape::mixed, 40, 1500, stream);
    const auto fitness = search.fitness_of(evaluations(rows));
    const auto expected = twin.fitness_of(rows);
    for (std::size_t i = 0; i < rows.size(); ++i)
      ASSERT_NEAR(fitness[i].selection, expected[i], 1e-13 * expected[i]);
  }
  EXPECT_EQ(search.archive().rows(), twin.archive.size());
}

TEST(NoveltySearch, LoadsNoThresholdOrCountThatCannotBe) {
  const auto refusal = [](double threshold, std::int32_t empty_generations) -> std::string {
    io::BinaryWriter writer;
    writer.put(threshold);
    writer.put(empty_generations);
    writer.put(std::uint64_t{0});
    writer.put(std::uint64_t{0});
    NoveltySearch search(plain_settings(), 1);
    io::BinaryReader reader(writer.bytes(), "checkpoint.bin");
    try {
      search.load(reader);
      reader.finish();
    } catch (const UserError& error) {
      return error.what();
    }
    return "";
  };
  EXPECT_EQ(refusal(0.0, 0), "");
  EXPECT_EQ(refusal(1e300, 7), "");
  for (const double threshold : {-1e-300, HUGE_VAL, std::nan("")})
    EXPECT_NE(refusal(threshold, 0).find("a novelty threshold that cannot be"), std::string::npos)
        << threshold;
  EXPECT_NE(refusal(1.0, -1).find("a novelty threshold that cannot be"), std::string::npos);
}

}  // namespace
}  // namespace amble::search
