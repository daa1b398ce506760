#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>

#include "amble/core/random.hpp"
#include "tests/statistics/lifetimes.hpp"

namespace amble::statistics {
namespace {

using tests::is_near;
using tests::oracles;

using Groups = std::vector<std::vector<Lifetime>>;

Groups random_groups(Stream& stream, std::size_t k, double chance_of_end) {
  Groups groups(k);
  for (auto& group : groups) {
    group.resize(3 + stream.below(20));
    for (auto& life : group) life = {static_cast<double>(stream.below(40)), stream.chance(chance_of_end)};
  }
  return groups;
}

TEST(LogRank, IsThatOfR) {
  int compared = 0;
  for (const auto& set : oracles()["lifetimes"]) {
    SCOPED_TRACE(set["name"]);
    const auto& expected = set["log_rank"];
    if (expected.is_null()) continue;
    ++compared;
    const auto groups = tests::lifetimes_of(set["groups"]);
    const auto test = log_rank(groups);
    ASSERT_TRUE(test);
    EXPECT_TRUE(is_near(test->chi_square, expected["chi_square"][0]));
    EXPECT_EQ(test->degrees_of_freedom, expected["degrees_of_freedom"][0].get<double>());
    EXPECT_TRUE(is_near(test->p, expected["p"][0]));
    // R drops groups that are empty.
    std::size_t row = 0;
    for (std::size_t g = 0; g < groups.size(); ++g) {
      if (groups[g].empty()) continue;
      EXPECT_EQ(test->observed[g], expected["observed"][row].get<double>());
      EXPECT_TRUE(is_near(test->expected[g], expected["expected"][row++]));
    }
  }
  EXPECT_GE(compared, 20);
}

TEST(LogRank, SaysNothingIfNothingEndsOrOneGroupIsLeft) {
  EXPECT_FALSE(log_rank({}));
  EXPECT_FALSE(log_rank(Groups{{{1.0, true}}}));
  EXPECT_FALSE(log_rank(Groups{{{1.0, true}}, {}}));
  EXPECT_FALSE(log_rank(Groups{{{300.0, false}}, {{300.0, false}}}));
  // The first group is gone before anything ends.
  EXPECT_FALSE(log_rank(Groups{{{0.5, false}}, {{1.0, true}, {2.0, true}}}));
}

TEST(LogRank, FindsNothingIfAllEndAtOnce) {
  const auto test = log_rank(Groups{{{4.0, true}, {4.0, true}}, {{4.0, true}}, {{4.0, true}}});
  ASSERT_TRUE(test);
  EXPECT_EQ(test->chi_square, 0.0);
  EXPECT_EQ(test->p, 1.0);
  EXPECT_EQ(test->degrees_of_freedom, 2u);
}

TEST(LogRank, DependsNeitherOnTheOrderOfGroupsNorOnTheScaleOfTime) {
  Stream stream(10, Purpose::test);
  for (int i = 0; i < 300; ++i) {
    auto groups = random_groups(stream, 2 + stream.below(5), 0.7);
    const auto test = log_rank(groups);
    if (!test) continue;
    const double observed = std::accumulate(test->observed.begin(), test->observed.end(), 0.0);
    EXPECT_NEAR(std::accumulate(test->expected.begin(), test->expected.end(), 0.0), observed, 1e-10);
    std::rotate(groups.begin(), groups.begin() + 1, groups.end());
    for (auto& group : groups) {
      std::ranges::reverse(group);
      for (auto& life : group) life.time_s *= life.time_s;
    }
    EXPECT_NEAR(log_rank(groups)->chi_square, test->chi_square, 1e-9 * (1.0 + test->chi_square));
  }
}

TEST(LogRank, RejectsTrueHypothesesAboutAsOftenAsItSays) {
  Stream stream(11, Purpose::test);
  int rejected = 0;
  constexpr int tests = 4000;
  for (int i = 0; i < tests; ++i) {
    Groups groups(3, std::vector<Lifetime>(20));
    for (auto& group : groups) {
      for (auto& life : group) {
        const double time_s = -std::log(1.0 - stream.uniform()) * 100.0;
        life = {std::min(time_s, 150.0), time_s < 150.0};
      }
    }
    if (log_rank(groups)->p < 0.05) ++rejected;
  }
  // 4.6 standard errors of a share of 0.05 in 4000.
  EXPECT_NEAR(rejected / static_cast<double>(tests), 0.05, 0.016);
}

}  // namespace
}  // namespace amble::statistics
