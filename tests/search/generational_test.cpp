#include "amble/search/generational.hpp"

#include <gtest/gtest.h>

#include <array>
#include <limits>

namespace amble::search {
namespace {

TEST(ObjectiveSearch, SelectsByTheObjectiveItself) {
  const std::array<Evaluation, 3> generation{{{0.0, {}}, {2.5, {}}, {1.25, {}}}};
  const auto fitness = ObjectiveSearch().fitness_of(generation);
  ASSERT_EQ(fitness.size(), 3u);
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_EQ(fitness[i].selection, generation[i].objective);
    EXPECT_EQ(fitness[i].objective, generation[i].objective);
  }
}

TEST(ObjectiveSearchDeathTest, DoesNotPassOnAnObjectiveThatIsNotANumber) {
  const std::array<Evaluation, 1> generation{{{std::numeric_limits<double>::quiet_NaN(), {}}}};
  EXPECT_DEATH(ObjectiveSearch().fitness_of(generation), "objectives are finite");
}

}  // namespace
}  // namespace amble::search
