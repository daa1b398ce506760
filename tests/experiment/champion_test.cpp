#include "amble/experiment/champion.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "amble/core/error.hpp"
#include "amble/core/random.hpp"
#include "amble/io/json_file.hpp"
#include "amble/neat/genome_json.hpp"
#include "amble/robot/json.hpp"
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
      .trace = {0, 1, 0xffffffffu, 0x1234abcdu},
      .episodes = {}};
  champion.genome = small_population(champion.problem).genomes()[5];
  return champion;
}

/// The message of the UserError that parsing throws; "" if it throws none.
std::string error_of(const std::string& text) {
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
  EXPECT_EQ(robot::to_json(again.problem.robot), robot::to_json(champion.problem.robot));
  EXPECT_EQ(champion_text(again), text);
}

/// The same, evolved under noise.
Champion noisy_champion() {
  auto champion = some_champion();
  champion.problem.noise.episodes = 2;
  champion.problem.noise.push_m_s = 0.2;
  champion.episodes = {
      {.result = {.distance_m = 0.5, .steps = 2, .seconds = 0.02, .outcome = record::Outcome::completed},
       .trace = {5, 6}},
      {.result = {.distance_m = 0.1, .steps = 1, .seconds = 0.01, .outcome = record::Outcome::diverged},
       .trace = {7}}};
  return champion;
}

TEST(Champion, EvolvedUnderNoiseReadsBackWithItsEpisodes) {
  const auto champion = noisy_champion();
  const auto text = champion_text(champion);
  const auto again = parse_champion(text, "c.json").champion;
  ASSERT_EQ(again.episodes.size(), 2u);
  EXPECT_EQ(again.episodes[0].trace, champion.episodes[0].trace);
  EXPECT_EQ(again.episodes[1].result.outcome, record::Outcome::diverged);
  EXPECT_EQ(again.problem.noise.push_m_s, 0.2);
  EXPECT_EQ(champion_text(again), text);
}

TEST(Champion, CarriesWhatItsRefereesSaidUnderItsSeal) {
  auto champion = some_champion();
  champion.referees = {{"ode", {.distance_m = 0.15, .steps = 100, .seconds = 1.0}},
                       {"mujoco", {.distance_m = 0.7, .steps = 9, .outcome = record::Outcome::diverged}}};
  const auto text = champion_text(champion);
  const auto again = parse_champion(text, "c.json").champion;
  ASSERT_EQ(again.referees.size(), 2u);
  EXPECT_EQ(again.referees[0].engine, "ode");
  EXPECT_EQ(again.referees[0].result.distance_m, 0.15);
  EXPECT_EQ(again.referees[1].result.outcome, record::Outcome::diverged);
  EXPECT_EQ(champion_text(again), text);
  const auto document = io::Json::parse(text);
  EXPECT_EQ(document["referees"][0]["kept"], 0.15 / (0.1 + 0.2));

  auto altered = text;
  altered.replace(altered.find("0.7,"), 3, "0.8");
  EXPECT_THAT(error_of(altered), HasSubstr("checksum"));
}

TEST(Champion, WithoutRefereesSaysNothingOfThem) {
  EXPECT_EQ(champion_text(some_champion()).find("referees"), std::string::npos);
}

TEST(Champion, KeepsAShareOfAnyDistanceButNone) {
  EXPECT_EQ(share_kept(1.5, 3.0), 0.5);
  EXPECT_EQ(share_kept(1.5, 0.0), std::nullopt);
}

TEST(Champion, IsJudgedByWhatItsEpisodesMakeOfIt) {
  auto champion = noisy_champion();
  EXPECT_EQ(champion.objective(), 0.3);
  champion.problem.noise.score = trial::EpisodeScore::worst;
  EXPECT_EQ(champion.objective(), 0.1);
  EXPECT_EQ(some_champion().objective(), 0.1 + 0.2) << "without noise by its distance";
}

TEST(Champion, WithoutNoiseSaysNothingOfIt) {
  EXPECT_EQ(champion_text(some_champion()).find("noise"), std::string::npos);
}

TEST(Champion, WithoutAnEpisodeThatItsNoiseAsksForIsRefused) {
  auto champion = noisy_champion();
  champion.episodes.pop_back();
  EXPECT_THAT(error_of(champion_text(champion)), HasSubstr("as many as settings.episodes"));
}

TEST(Champion, IsRefusedAfterAnyChangeOfItsText) {
  const auto text = champion_text(some_champion());
  auto altered = text;
  const auto digit = altered.find('.', altered.find("\"weight\": ")) + 1;
  altered[digit] = altered[digit] == '3' ? '4' : '3';
  EXPECT_THAT(error_of(altered), StartsWith("c.json: "));
  EXPECT_THAT(error_of(altered), HasSubstr("checksum"));
  EXPECT_TRUE(parse_champion(altered, "c.json", io::Altered::accept).altered);
}

TEST(Champion, IsRefusedWhenTruncatedAnywhere) {
  const auto text = champion_text(some_champion());
  for (std::size_t length = 0; length + 2 < text.size(); length += 97)
    EXPECT_THAT(error_of(text.substr(0, length)), StartsWith("c.json"));
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
  EXPECT_THAT(error_of(champion_text(champion)), StartsWith("c.json: "));
  champion = some_champion();
  champion.genome.nodes.pop_back();
  EXPECT_THAT(error_of(champion_text(champion)), StartsWith("c.json: "));
}

TEST(Champion, OfAnUnknownEngineIsRefused) {
  auto champion = some_champion();
  champion.problem.engine = "newton";
  EXPECT_THAT(error_of(champion_text(champion)), HasSubstr("newton"));
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

TEST(Champion, OfTheFirstGenerationIsTheGenomeOfItsIndex) {
  int not_first = 0;
  for (const int seed : {1, 2, 3, 4}) {
    const TemporaryFolder scratch;
    Listener listener(1);
    Config config = small_config({"engine=batch", "trial.duration_s=0.3"});
    config.seed = seed;
    Run::start(scratch / "run", config, 1).execute(listener, listener.stop);
    const Champion champion = load_champion(RunPaths(scratch / "run").champion_files().front());
    const auto population = small_population(champion.problem, static_cast<std::uint64_t>(seed));
    ASSERT_LT(champion.index, static_cast<int>(population.genomes().size()));
    EXPECT_EQ(neat::to_json(champion.genome),
              neat::to_json(population.genomes()[static_cast<std::size_t>(champion.index)]));
    not_first += champion.index > 0 ? 1 : 0;
  }
  EXPECT_GT(not_first, 0);
}

/// What parsing says of a champion's file in which a value was replaced, under a checksum that fits.
std::string error_with(const std::string& pointer, const io::Json& value) {
  io::Json document = io::unseal_json("amble-champion", 4, champion_text(some_champion()), "c.json").document;
  document[io::Json::json_pointer(pointer)] = value;
  return error_of(io::sealed_json("amble-champion", 4, document));
}

TEST(Champion, HasCountsFromNoughtToTheLargestInt) {
  for (const char* pointer : {"/generation", "/index", "/result/steps"}) {
    EXPECT_EQ(error_with(pointer, 0), "") << pointer;
    EXPECT_EQ(error_with(pointer, 2147483647), "") << pointer;
    EXPECT_THAT(error_with(pointer, -1), HasSubstr("a whole number from 0 to 2147483647")) << pointer;
    EXPECT_THAT(error_with(pointer, 2147483648), HasSubstr("a whole number from 0 to 2147483647")) << pointer;
  }
}

TEST(Champion, HasATraceOfEightHexadecimalDigitsPerStep) {
  for (const char* trace : {"", "00000000", "0123abcdffffffff"})
    EXPECT_EQ(error_with("/trace", trace), "") << trace;
  for (const char* trace :
       {"0", "0000000", "000000000", "0000000g", "00000000 1234567", "-0000001", "0x000000"})
    EXPECT_THAT(error_with("/trace", trace), HasSubstr("eight hexadecimal digits per step")) << trace;
}

TEST(Champion, EndsInOneOfTheThreeWays) {
  for (const char* outcome : {"completed", "fell", "diverged"})
    EXPECT_EQ(error_with("/result/outcome", outcome), "") << outcome;
  EXPECT_THAT(error_with("/result/outcome", "flew"), HasSubstr("completed, fell or diverged"));
  for (const char* pointer : {"/result/distance_m", "/result/seconds"})
    EXPECT_THAT(error_with(pointer, "inf"), HasSubstr("a finite number")) << pointer;
}

TEST(Champion, KeepsNoShareOfADistanceBackwards) {
  EXPECT_EQ(share_kept(1.5, -3.0), std::nullopt);
  EXPECT_EQ(share_kept(-1.5, 1e-300), -1.5e300);
}

TEST(Champion, HasTheGroundAndTheTrialsOfItsOwnSeedAndGeneration) {
  const auto champion = some_champion();
  EXPECT_EQ(champion.ground_key().seed, 7u);
  EXPECT_EQ(champion.ground_key().generation, 12u);
  const auto key = champion.scenario_key(5), unseen = champion.unseen_scenario_key(5);
  EXPECT_EQ(key.seed, 7u);
  EXPECT_EQ(key.generation, 12u);
  EXPECT_EQ(key.episode, 5u);
  EXPECT_EQ(unseen.seed, 7u);
  EXPECT_EQ(unseen.generation, 12u);
  EXPECT_EQ(unseen.episode, 1005u) << "an evaluation has at most a thousand episodes";
}

}  // namespace
}  // namespace amble::experiment
