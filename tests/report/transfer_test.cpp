#include "amble/report/transfer.hpp"

#include <gtest/gtest.h>

#include <optional>
#include <string>
#include <vector>

#include "tests/report/fixture.hpp"

namespace amble::report {
namespace {

TEST(Transfers, CompareWithTheSameLengthAtHome) {
  StudyData data = small_study();
  auto found = transfers(data);
  ASSERT_EQ(found.size(), 2u) << "test ode in both conditions";
  EXPECT_EQ(found[0].reference, "train_m");
  EXPECT_EQ(found[0].engine, "ode");
  EXPECT_DOUBLE_EQ(*found[0].share, 0.5);
  EXPECT_DOUBLE_EQ(found[0].median_m, 2.5);

  data.study.tests.push_back(data.study.tests[0]);
  data.study.tests.back().name = "long-ode";
  for (ledger::Record& run : data.records)
    add_test(run, "long-ode", 1.5 * run.best_objective, 300.0, 300.0, 300.0, "trot", "ode");
  found = transfers(data);
  ASSERT_EQ(found.size(), 4u);
  EXPECT_EQ(found[2].test, "long-ode");
  EXPECT_EQ(found[2].reference, "long.distance_m");
  EXPECT_DOUBLE_EQ(*found[2].share, 0.5) << "of 3 × the distance in evolution";
}

TEST(Transfers, CompareOnlyWithATestAtHomeThatIsTheSameInAllElse) {
  struct AtHome {
    std::string engine, noise;
    double seconds;
    int episodes;
    std::string ground = "rough.toml", damage = "limp.toml";
  };
  const AtHome same{"batch", "hills.toml", 60.0, 5};
  const std::vector<AtHome> others{{"mujoco", "hills.toml", 60.0, 5},
                                   {"batch", "", 60.0, 5},
                                   {"batch", "wind.toml", 60.0, 5},
                                   {"batch", "hills.toml", 59.0, 5},
                                   {"batch", "hills.toml", 60.0, 1},
                                   {"batch", "hills.toml", 60.0, 6},
                                   {"batch", "hills.toml", 60.0, 5, "", "limp.toml"},
                                   {"batch", "hills.toml", 60.0, 5, "stones.toml", "limp.toml"},
                                   {"batch", "hills.toml", 60.0, 5, "rough.toml", ""},
                                   {"batch", "hills.toml", 60.0, 5, "rough.toml", "slack.toml"}};
  StudyData data = small_study();
  data.study.tests.clear();
  for (ledger::Record& run : data.records) run.tests.clear();
  const auto add = [&](const std::string& name, const AtHome& how, double distance_m) {
    ledger::TestSpec test;
    test.name = name;
    test.engine = how.engine;
    test.noise = how.noise;
    test.ground = how.ground;
    test.damage = how.damage;
    test.seconds = how.seconds;
    test.episodes = how.episodes;
    data.study.tests.push_back(test);
    for (ledger::Record& run : data.records)
      add_test(run, name, distance_m, how.seconds, how.seconds, how.seconds, "trot", how.engine);
  };
  const auto share_of_abroad = [&]() -> std::optional<double> {
    for (const Transfer& transfer : transfers(data))
      if (transfer.test == "abroad") return transfer.share;
    return {};
  };
  add("abroad", {"ode", "hills.toml", 60.0, 5}, 3.0);
  for (std::size_t i = 0; i < others.size(); ++i) {
    add("other" + std::to_string(i), others[i], 100.0);
    EXPECT_FALSE(share_of_abroad()) << i;
  }
  add("same", same, 4.0);
  ASSERT_TRUE(share_of_abroad());
  EXPECT_DOUBLE_EQ(*share_of_abroad(), 0.75);
}

TEST(Transfers, WithoutAReferenceHaveNoShare) {
  StudyData data = small_study();
  for (ledger::Record& run : data.records) run.champion = io::Json::object();
  EXPECT_FALSE(transfers(data)[0].share) << "how long evolution’s trials were is unknown";
  data = small_study();
  data.study.tests[1].noise = "noise.toml";
  EXPECT_FALSE(transfers(data)[0].share) << "there is no such noise at home";
  data = small_study();
  data.study.tests[1].ground = "hills.toml";
  EXPECT_FALSE(transfers(data)[0].share) << "nor such a ground";
  data = small_study();
  data.study.tests[1].damage = "limp.toml";
  EXPECT_FALSE(transfers(data)[0].share) << "nor such damage";
}

TEST(Transfers, AreNotComparedWithAScoreThatIsNoDistance) {
  for (const char* quantity : {"speed_kept", "heading"}) {
    const auto found = transfers(scored_study(quantity));
    ASSERT_EQ(found.size(), 2u);
    EXPECT_EQ(found[0].reference, "") << quantity;
    EXPECT_FALSE(found[0].share) << quantity;
  }
}

TEST(Transfers, AreOnlyTestsInOtherEngines) {
  StudyData data = small_study();
  for (ledger::Record& run : data.records) run.engine = "ode";
  for (const Transfer& transfer : transfers(data)) EXPECT_EQ(transfer.test, "long");
}

TEST(Transfers, HaveNoShareOfARunThatGotNowhereAtHome) {
  StudyData data = small_study();
  for (ledger::Record& run : data.records)
    if (run.condition == "a") run.best_objective = run.seed == 1 ? 0.0 : run.seed == 2 ? -1.0 : 5.0;
  const auto found = transfers(data);
  ASSERT_EQ(found.size(), 2u);
  EXPECT_EQ(found[0].n, 3u);
  EXPECT_EQ(found[0].n_share, 1u);
  EXPECT_DOUBLE_EQ(found[0].share.value(), 3.0 / 5.0) << "3 m abroad";
  for (ledger::Record& run : data.records)
    if (run.condition == "a") run.best_objective = 0.0;
  EXPECT_EQ(transfers(data)[0].n_share, 0u);
  EXPECT_FALSE(transfers(data)[0].share);
}

}  // namespace
}  // namespace amble::report
