#include <gtest/gtest.h>

#include "amble/io/toml_settings.hpp"
#include "tests/io/sample_settings.hpp"

namespace amble::io {
namespace {

TEST(SettingsTable, HasARowPerKeyAndAColumnPerPreset) {
  test::Inner authors, paper;
  paper.rate = 0.5;
  std::string extra = "a|b";
  const std::vector<SettingsColumn> columns{
      {"authors", [&](SettingsVisitor& visitor) { visitor.table("neat", authors, {"Neat."}); }},
      {"paper",
       [&](SettingsVisitor& visitor) {
         visitor.table("neat", paper, {"Neat."});
         visitor.text("extra", extra, {"Only | here."});
       }},
  };
  EXPECT_EQ(settings_to_markdown(columns),
            "| key | what it means | allowed | authors | paper | source |\n"
            "|---|---|---|---|---|---|\n"
            "| `neat.rate` | Share of offspring, 0 to 1. | a number from 0 to 1 | `0.25` | `0.5` | Somebody "
            "2013 |\n"
            "| `neat.seed` | Seed of all randomness. | a whole number | `1` | `1` |  |\n"
            "| `extra` | Only \\| here. | text in quotes |  | `\"a\\|b\"` |  |\n");
}

TEST(SettingsTable, ShowsTheKeysOfAListOnceAndHowManyItemsThereAre) {
  std::vector<test::Knot> none, two(2);
  two[0].length = 0.75;
  const auto column = [](std::vector<test::Knot>& knots) {
    return [&knots](SettingsVisitor& visitor) { visitor.tables("knots", knots, {"Knots."}); };
  };
  const auto table = settings_to_markdown({{"default", column(none)}, {"mine", column(two)}});
  EXPECT_NE(table.find("| `knots` | Knots. | a list of tables in braces | 0 items | 2 items |  |\n"),
            std::string::npos)
      << table;
  EXPECT_NE(table.find("| `knots[].length` | Length, m. | a number from 0 to 1 | `0.5` |  |  |\n"),
            std::string::npos)
      << table;
}

TEST(SettingsTable, NamesAKeyByAllTablesThatItIsIn) {
  test::Inner inner;
  const auto table = settings_to_markdown({{"default", [&inner](SettingsVisitor& visitor) {
                                              visitor.begin("neat", {"Neat."});
                                              visitor.begin("mutation", {"Mutation."});
                                              visitor.table("links", inner, {"Links."});
                                              visitor.end();
                                              visitor.end();
                                            }}});
  EXPECT_NE(table.find("| `neat.mutation.links.seed` |"), std::string::npos) << table;
}

TEST(SettingsTable, ShowsOnlyRowsThatDifferIfAsked) {
  test::Inner defaults, one, other;
  defaults.seed = 5;
  one.rate = other.rate = 0.75;
  other.seed = 3;
  const auto column = [](test::Inner& inner) {
    return [&inner](SettingsVisitor& visitor) { inner.describe(visitor); };
  };
  const auto table =
      settings_to_markdown({{"default", column(defaults)}, {"one", column(one)}, {"other", column(other)}},
                           SettingsRows::differing);
  EXPECT_EQ(table.find("`rate`"), std::string::npos) << table;
  EXPECT_NE(table.find("| `seed` | Seed of all randomness. | a whole number | `5` | `1` | `3` |  |"),
            std::string::npos)
      << table;
}

}  // namespace
}  // namespace amble::io
