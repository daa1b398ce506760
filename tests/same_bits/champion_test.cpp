#include <gtest/gtest.h>

#include <algorithm>

#include "amble/core/hash.hpp"
#include "tests/same_bits/walker.hpp"

// Champions of the gallery evolved on x86-64, and the files of those that did so without noise have the state
// after every step. They must walk so on every processor.
namespace amble::tests {
namespace {

std::vector<std::uint32_t> recorded_trace(const Walker& walker) {
  const std::string digits = walker.root.at("trace").text();
  std::vector<std::uint32_t> trace;
  for (std::size_t i = 0; i < digits.size(); i += 8)
    trace.push_back(static_cast<std::uint32_t>(std::stoul(digits.substr(i, 8), nullptr, 16)));
  return trace;
}

class ChampionOf : public testing::TestWithParam<std::string> {};

TEST_P(ChampionOf, WalksStepByStepAsItsFileSays) {
  const Walker walker(GetParam());
  const auto recorded = recorded_trace(walker), here = walker.trace();
  ASSERT_EQ(recorded.size(), 1500u);
  ASSERT_EQ(here.size(), recorded.size());
  const auto differs = std::ranges::mismatch(here, recorded).in1;
  EXPECT_EQ(differs - here.begin(), 1500) << "the first step that differs, from 0";
}

INSTANTIATE_TEST_SUITE_P(SameBits, ChampionOf, testing::Values("biped", "octopod", "servo"),
                         [](const auto& robot) { return robot.param; });

}  // namespace
}  // namespace amble::tests
