#include "amble/presentation/walkers_page.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <atomic>
#include <utility>

#include "tests/presentation/champion.hpp"

namespace amble::presentation {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

const std::atomic<bool> going_on{false}, stopped{true};

experiment::Champion standing(int generation) {
  experiment::Champion champion = champion_of({});
  champion.experiment = "test";
  champion.generation = generation;
  return champion;
}

std::string page_of(WalkersPage page, std::initializer_list<std::pair<int, const char*>> champions) {
  for (const auto& [generation, file] : champions)
    EXPECT_NE(page.add_champion(standing(generation), file, {}, 1, going_on), nullptr);
  return std::move(page).html();
}

TEST(WalkersPage, OfOneWalkerIsCalledAsItAndOfSeveralByTheirNumber) {
  const WalkersPageOptions briefly{.walk = {.seconds = 0.1},
                                   .disturbance = {.level = {}, .undisturbed = true}};
  EXPECT_THAT(page_of(WalkersPage(briefly), {{3, "a.json"}}), HasSubstr("<title>test, generation 3</title>"));
  EXPECT_THAT(page_of(WalkersPage(briefly), {{3, "a.json"}, {4, "b.json"}}),
              AllOf(HasSubstr("<title>2 walkers</title>"), HasSubstr("a.json, generation 3"),
                    HasSubstr("b.json, generation 4")));
}

TEST(WalkersPage, TellsRunsOfTheSameNameFromEachOtherByTheirFolders) {
  const WalkersPageOptions briefly{.walk = {.seconds = 0.1},
                                   .disturbance = {.level = {}, .undisturbed = true}};
  const std::string page =
      page_of(WalkersPage(briefly), {{3, "one/run/champions/3.json"}, {3, "two/run/champions/3.json"}});
  EXPECT_THAT(page, AllOf(HasSubstr("one/run, generation 3"), HasSubstr("two/run, generation 3")));
}

TEST(WalkersPage, OfAHistoryCallsWalkersByTheirGenerations) {
  const WalkersPageOptions history{
      .walk = {.seconds = 0.1}, .disturbance = {.level = {}, .undisturbed = true}, .history = true};
  EXPECT_THAT(page_of(WalkersPage(history), {{0, "a.json"}, {9, "b.json"}}),
              AllOf(HasSubstr("<title>test: its history</title>"), HasSubstr("gen 0"), HasSubstr("gen 9"),
                    Not(HasSubstr("a.json, "))));
}

TEST(WalkersPage, GivesUpWhenStopped) {
  WalkersPage page({});
  EXPECT_EQ(page.add_champion(standing(0), "a.json", {}, 1, stopped), nullptr);
}

TEST(WalkersPageOptions, NameTheFirstThatARecordingCannotHave) {
  EXPECT_EQ(WalkersPageOptions{}.not_for_recordings(), "");
  EXPECT_EQ(WalkersPageOptions{.walk = {.seconds = 1.0}}.not_for_recordings(), "seconds");
  EXPECT_EQ((WalkersPageOptions{.walk = {.engine = "ode"}}.not_for_recordings()), "engine");
  EXPECT_EQ((WalkersPageOptions{.disturbance = {.level = "micro"}}.not_for_recordings()), "level");
  EXPECT_EQ((WalkersPageOptions{.disturbance = {.level = {}, .trials = 3}}.not_for_recordings()), "trials");
  EXPECT_EQ((WalkersPageOptions{.disturbance = {.level = {}, .undisturbed = true}}.not_for_recordings()),
            "undisturbed");
}

}  // namespace
}  // namespace amble::presentation
