#include "amble/experiment/champion.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "amble/core/error.hpp"
#include "amble/core/random.hpp"
#include "amble/morphology/robot_json.hpp"
#include "tests/experiment/fixture.hpp"

namespace amble::experiment {
namespace {

using testing::HasSubstr;
using testing::StartsWith;

Champion some_champion() {
  Champion champion{
      .experiment = "test",
      .seed = 7,
      .generation = 12,
      .index = 3,
      .problem = small_problem(),
      .genome = {},
      .result = {.distance_m = 0.1 + 0.2, .steps = 77, .seconds = 0.77, .outcome = record::Outcome::fell},
      .referees = {{"mujoco", {.distance_m = 0.7, .steps = 100, .seconds = 1.0}}},
      .trace = {0, 1, 0xffffffffu, 0x1234abcdu}};
  champion.genome = small_population(champion.problem).genomes()[5];
  return champion;
}

/// The message of the UserError that parsing throws; "" if it throws none.
std::string complaint(const std::string& text) {
  try {
    parse_champion(text, "c.json");
  } catch (const UserError& error) {
    EXPECT_EQ(error.code(), ExitCode::bad_file);
    return error.what();
  }
  return "";
}

TEST(Champion, ReadsBackToTheBit) {
  const auto champion = some_champion();
  const auto text = champion_text(champion);
  const auto [again, altered] = parse_champion(text, "c.json");
  EXPECT_FALSE(altered);
  EXPECT_EQ(again.genome, champion.genome);
  EXPECT_EQ(again.trace, champion.trace);
  EXPECT_EQ(again.seed, 7);
  EXPECT_EQ(again.generation, 12);
  EXPECT_EQ(again.result.distance_m, champion.result.distance_m);
  EXPECT_EQ(again.result.outcome, record::Outcome::fell);
  ASSERT_EQ(again.referees.size(), 1u);
  EXPECT_EQ(again.referees[0].engine, "mujoco");
  EXPECT_EQ(again.referees[0].result.distance_m, 0.7);
  EXPECT_EQ(again.referees[0].result.outcome, record::Outcome::completed);
  EXPECT_EQ(morphology::to_json(again.problem.robot), morphology::to_json(champion.problem.robot));
  EXPECT_EQ(champion_text(again), text);
}

TEST(Champion, OfAnEarlierVersionHasNoReferees) {
  auto champion = some_champion();
  champion.referees.clear();
  auto text = champion_text(champion);
  const std::string empty = "  \"referees\": [],\n";
  const auto at = text.find(empty);
  ASSERT_NE(at, std::string::npos);
  text.erase(at, empty.size());
  const auto [again, altered] = parse_champion(text, "c.json", io::Altered::accept);
  EXPECT_TRUE(altered) << "what referees say is under the seal";
  EXPECT_TRUE(again.referees.empty());
  EXPECT_EQ(again.genome, champion.genome);
}

TEST(Champion, IsRefusedAfterAnyChangeOfItsText) {
  const auto text = champion_text(some_champion());
  auto altered = text;
  const auto digit = altered.find('.', altered.find("\"weight\": ")) + 1;
  altered[digit] = altered[digit] == '3' ? '4' : '3';
  EXPECT_THAT(complaint(altered), StartsWith("c.json: "));
  EXPECT_THAT(complaint(altered), HasSubstr("checksum"));
  EXPECT_TRUE(parse_champion(altered, "c.json", io::Altered::accept).altered);
}

TEST(Champion, IsRefusedWhenTruncatedAnywhere) {
  const auto text = champion_text(some_champion());
  for (std::size_t length = 0; length + 2 < text.size(); length += 97)
    EXPECT_THAT(complaint(text.substr(0, length)), StartsWith("c.json"));
}

TEST(Champion, WithAWeightThatIsNoFiniteNumberIsRefused) {
  for (const char* bad : {"1e999", "\"inf\"", "null", "NaN"}) {
    auto text = champion_text(some_champion());
    const auto start = text.find("\"weight\": ") + 10;
    const auto end = text.find_first_of(",}\n", start);
    text.replace(start, end - start, bad);
    try {
      parse_champion(text, "c.json", io::Altered::accept);
      ADD_FAILURE() << bad << " was accepted";
    } catch (const UserError& error) {
      EXPECT_THAT(error.what(), StartsWith("c.json")) << bad;
    }
  }
}

TEST(Champion, OfAnUnsoundGenomeIsRefusedEvenIfTheChecksumFits) {
  auto champion = some_champion();
  champion.genome.links.front().to = 12345;
  EXPECT_THAT(complaint(champion_text(champion)), StartsWith("c.json: "));
  champion = some_champion();
  champion.genome.nodes.pop_back();
  EXPECT_THAT(complaint(champion_text(champion)), StartsWith("c.json: "));
}

TEST(Champion, OfAnUnknownEngineIsRefused) {
  auto champion = some_champion();
  champion.problem.engine = "newton";
  EXPECT_THAT(complaint(champion_text(champion)), HasSubstr("newton"));
}

TEST(Champion, ReaderThrowsNothingButUserErrorsUnderRandomDamage) {
  const auto text = champion_text(some_champion());
  for (std::uint32_t round = 0; round < 300; ++round) {
    Stream stream(1, Purpose::test, 0, round);
    auto damaged = text;
    for (std::uint32_t i = 0; i < 1 + stream.below(8); ++i) {
      const std::size_t at = stream.below(static_cast<std::uint32_t>(damaged.size()));
      switch (stream.below(3)) {
        case 0:
          damaged[at] = static_cast<char>(stream.below(256));
          break;
        case 1:
          damaged.erase(at, 1 + stream.below(40));
          break;
        default:
          damaged.insert(at, text.substr(stream.below(1000), stream.below(40)));
      }
    }
    try {
      parse_champion(damaged, "c.json", io::Altered::accept);
    } catch (const UserError&) {
    }
  }
}

}  // namespace
}  // namespace amble::experiment
