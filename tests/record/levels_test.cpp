#include "amble/record/levels.hpp"

#include <gtest/gtest.h>

#include <string>

namespace amble::record {
namespace {

TEST(Levels, AreFoundByTheirNamesAlone) {
  ASSERT_NE(find_level("micro"), nullptr);
  EXPECT_EQ(find_level("micro")->start_rad, 1e-6);
  EXPECT_EQ(find_level("milli")->start_rad, 1e-3);
  EXPECT_EQ(find_level("Milli"), nullptr);
  EXPECT_EQ(find_level(""), nullptr);
  EXPECT_NE(find_level(default_level), nullptr);
}

TEST(Levels, BeginWithAControlAndRise) {
  const auto all = levels();
  EXPECT_EQ(all.front().name, "control");
  EXPECT_EQ(all.front().start_rad, 0.0);
  for (std::size_t i = 1; i < all.size(); ++i) EXPECT_GT(all[i].start_rad, all[i - 1].start_rad);
}

TEST(Levels, AreListedForMessages) {
  EXPECT_EQ(level_names(), "control, micro, 100-micro or milli");
}

}  // namespace
}  // namespace amble::record
