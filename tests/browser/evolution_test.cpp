#include "amble/browser/evolution.hpp"

#include <gtest/gtest.h>

#include <fstream>
#include <string>
#include <vector>

#include "amble/browser/session.hpp"
#include "amble/core/error.hpp"
#include "tests/browser/champion.hpp"

namespace amble::browser {
namespace {

std::string settings(int seed = 1, bool feels_its_feet = true) {
  return "{\"seed\": " + std::to_string(seed) +
         ", \"population\": 20, \"seconds\": 2.0, \"add_node_share\": 0.05, \"add_link_share\": 0.15, "
         "\"feels_its_feet\": " +
         (feels_its_feet ? "true}" : "false}");
}

/// What is told after each of some generations, in pieces of so many steps.
std::vector<std::string> generations(Evolution& evolution, int count, int piece) {
  std::vector<std::string> told;
  while (static_cast<int>(told.size()) < count)
    if (evolution.advance(piece)) told.push_back(evolution.progress_json());
  return told;
}

std::vector<std::string> generations(const std::string& chosen, int count, int piece) {
  Evolution evolution(tests::champion_text(), chosen);
  return generations(evolution, count, piece);
}

TEST(Evolution, IsTheSameInPiecesOfAnySize) {
  EXPECT_EQ(generations(settings(), 3, 7), generations(settings(), 3, 100000));
}

/// What WebAssembly gives, too (evolution.test.mjs). If evolution is meant to change, write what the test
/// says to the file.
TEST(Evolution, IsTheSameAsInWebAssembly) {
  std::ifstream file(std::string(AMBLE_SOURCE_DIR) + "/tests/browser/evolution.txt");
  const auto told = generations(settings(), 3, 1000);
  std::vector<std::string> known;
  for (std::string line; std::getline(file, line);) known.push_back(line);
  EXPECT_EQ(told, known);
}

TEST(Evolution, DependsOnSeedAndOnWhatTheControllerFeels) {
  const auto first = generations(settings(), 2, 1000);
  EXPECT_NE(generations(settings(2), 2, 1000), first);
  EXPECT_NE(generations(settings(1, false), 2, 1000), first);
}

TEST(Evolution, ItsBestIsAChampionsFileThatRepeatsAndWalksAsFarAsWasTold) {
  Evolution evolution(tests::champion_text(), settings());
  generations(evolution, 3, 1000);
  const Session session(evolution.champion());
  const auto champion = experiment::parse_champion(evolution.champion(), "champion").champion;
  EXPECT_EQ(session.steps_as_recorded(), static_cast<int>(champion.trace.size()));
  EXPECT_EQ(champion.objective(), evolution.progress().best_so_far);
  EXPECT_EQ(champion.generation, evolution.progress().best_generation);
  EXPECT_EQ(champion.seed, 1);
}

TEST(Evolution, EachGenomeBelongsToASpecies) {
  Evolution evolution(tests::champion_text(), settings());
  generations(evolution, 2, 1000);
  int members = 0;
  for (const auto& [id, size] : evolution.species()) members += size;
  EXPECT_EQ(members, 20);
  EXPECT_EQ(evolution.progress().generation, 1);
}

TEST(Evolution, RefusesWhatCannotBe) {
  EXPECT_THROW(Evolution(tests::champion_text(), "{\"seed\": 1}"), UserError);
  std::string none = settings();
  none.replace(none.find("20"), 2, "1");
  EXPECT_THROW(Evolution(tests::champion_text(), none), UserError);
}

}  // namespace
}  // namespace amble::browser
