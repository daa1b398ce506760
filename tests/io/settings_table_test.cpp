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

}  // namespace
}  // namespace amble::io
