#include "amble/statistics/proportions.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "amble/core/random.hpp"
#include "tests/statistics/oracles.hpp"

namespace amble::statistics {
namespace {

using tests::agrees;
using tests::is_near;
using tests::oracles;

TEST(FisherExact, IsThatOfScipyAndOfR) {
  ASSERT_GE(oracles()["tables"].size(), 20u);
  for (const auto& table : oracles()["tables"]) {
    const std::vector<std::uint64_t> n = table["counts"];
    SCOPED_TRACE(table["counts"].dump());
    const auto test = fisher_exact({n[0], n[1]}, {n[2], n[3]});
    ASSERT_TRUE(test);
    EXPECT_TRUE(is_near(test->p, table["p"]));
    EXPECT_TRUE(is_near(test->p, table["r"]["p"][0]));
    EXPECT_TRUE(agrees(test->odds_ratio, table["odds_ratio"]));
  }
}

TEST(ClopperPearson, IsThatOfScipyAndOfR) {
  for (const auto& table : oracles()["tables"]) {
    const std::vector<std::uint64_t> n = table["counts"];
    SCOPED_TRACE(table["counts"].dump());
    const auto interval = *clopper_pearson({n[0], n[1]});
    EXPECT_TRUE(is_near(interval, table["clopper_pearson"][0], table["clopper_pearson"][1]));
    EXPECT_TRUE(is_near(interval, table["r"]["clopper_pearson"][0], table["r"]["clopper_pearson"][1]));
  }
}

TEST(Wilson, IsThatOfScipy) {
  for (const auto& table : oracles()["tables"]) {
    const std::vector<std::uint64_t> n = table["counts"];
    SCOPED_TRACE(table["counts"].dump());
    EXPECT_TRUE(is_near(*wilson({n[0], n[1]}), table["wilson"][0], table["wilson"][1], 1e-15));
  }
}

double log_choose(double n, double k) {
  return std::lgamma(n + 1.0) - std::lgamma(k + 1.0) - std::lgamma(n - k + 1.0);
}

/// How often the interval of a binomial count has the true probability inside, exactly.
template <class Method>
double coverage(Method method, std::uint64_t trials, double probability) {
  double covered = 0.0;
  const auto n = static_cast<double>(trials);
  for (std::uint64_t k = 0; k <= trials; ++k) {
    const auto successes = static_cast<double>(k);
    if (method(Count{k, trials}, 0.95)->contains(probability))
      covered += std::exp(log_choose(n, successes) + successes * std::log(probability) +
                          (n - successes) * std::log1p(-probability));
  }
  return covered;
}

TEST(ClopperPearson, CoversAtLeastAsOftenAsItSays) {
  for (const std::uint64_t trials : {1ull, 2ull, 5ull, 20ull, 60ull})
    for (double p = 0.01; p < 1.0; p += 0.01)
      EXPECT_GE(coverage(clopper_pearson, trials, p), 0.95 - 1e-12) << trials << " " << p;
}

TEST(Wilson, CoversAsOftenAsItSaysOnAverage) {
  double sum = 0.0;
  int count = 0;
  for (double p = 0.005; p < 1.0; p += 0.01, ++count) sum += coverage(wilson, 20, p);
  EXPECT_NEAR(sum / count, 0.95, 0.01);
}

TEST(FisherExact, AgreesWithTheSumOverAllTables) {
  Stream stream(7, Purpose::test);
  for (int i = 0; i < 2000; ++i) {
    const std::uint64_t n1 = 1 + stream.below(25), n2 = 1 + stream.below(25);
    const std::uint64_t k1 = stream.below(static_cast<std::uint32_t>(n1) + 1);
    const std::uint64_t k2 = stream.below(static_cast<std::uint32_t>(n2) + 1);
    const auto log_weight = [&](std::uint64_t k) {
      return log_choose(static_cast<double>(n1), static_cast<double>(k)) +
             log_choose(static_cast<double>(n2), static_cast<double>(k1 + k2 - k));
    };
    double all = 0.0, as_extreme = 0.0;
    for (std::uint64_t k = 0; k <= std::min(n1, k1 + k2); ++k) {
      if (k1 + k2 - k > n2) continue;
      const double relative = std::exp(log_weight(k) - log_weight(k1));
      all += relative;
      if (relative <= 1.0 + 1e-7) as_extreme += relative;
    }
    const auto test = *fisher_exact({k1, n1}, {k2, n2});
    EXPECT_NEAR(test.p, as_extreme / all, 1e-11);
    const double difference = static_cast<double>(k1 * n2) - static_cast<double>(k2 * n1);
    EXPECT_EQ(test.direction, direction_of(difference));
  }
}

TEST(Proportions, SayNothingWithoutTrials) {
  EXPECT_FALSE(clopper_pearson({0, 0}));
  EXPECT_FALSE(wilson({0, 0}));
  EXPECT_FALSE(fisher_exact({0, 0}, {3, 5}));
  EXPECT_FALSE(fisher_exact({3, 5}, {0, 0}));
}

TEST(Proportions, EndExactlyWhereNothingElseIsPossible) {
  for (const auto method : {clopper_pearson, wilson}) {
    EXPECT_EQ(method({0, 20}, 0.95)->lower, 0.0);
    EXPECT_EQ(method({20, 20}, 0.95)->upper, 1.0);
  }
  EXPECT_EQ(fisher_exact({0, 20}, {0, 15})->p, 1.0);
  EXPECT_FALSE(fisher_exact({0, 20}, {0, 15})->odds_ratio);
}

TEST(ProportionsDeathTest, RefuseMoreSuccessesThanTrials) {
  EXPECT_DEATH(wilson({3, 2}), "no more successes than trials");
}

}  // namespace
}  // namespace amble::statistics
