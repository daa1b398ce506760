#include "amble/experiment/steering.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "amble/core/error.hpp"

namespace amble::tests {
namespace {

using experiment::parse_steering;

std::string refusal(const std::string& text) {
  try {
    parse_steering(text, "gains");
  } catch (const UserError& error) {
    return error.what();
  }
  return "accepted";
}

TEST(HandSteering, GainsAreReadWithCommasSemicolonsOrLinesBetweenThem) {
  const controllers::DifferentialSettings two{.turn_gain = 1.5, .full_speed_m_s = 0.4};
  for (const char* const text : {"turn_gain = 1.5, full_speed_m_s = 0.4", "turn_gain=1.5;full_speed_m_s=0.4",
                                 " turn_gain = 1.5\nfull_speed_m_s = 0.4 "})
    EXPECT_EQ(parse_steering(text, "gains"), experiment::HandSteering{two}) << text;
}

TEST(HandSteering, WhatIsInBracketsAndQuotesIsOneValue) {
  const auto settings =
      parse_steering("joint_types = [\"a,b\", 'c;d'], turn_gain = 2, about = \"middle\"", "gains").gains;
  EXPECT_THAT(settings.joint_types, testing::ElementsAre("a,b", "c;d"));
  EXPECT_EQ(settings.turn_gain, 2.0);
  EXPECT_EQ(settings.about, controllers::SwingCentre::middle);
}

TEST(HandSteering, TheLeadOfTheHeadingIsGivenWithTheGains) {
  EXPECT_EQ(parse_steering("turn_gain = 1.5, heading_gain = 1, heading_lead_rad = 0.5", "gains"),
            (experiment::HandSteering{{.turn_gain = 1.5, .heading_gain = 1.0}, {.lead_rad = 0.5}}));
  EXPECT_THAT(refusal("turn_gain = 1, heading_lead_rad = 4"),
              testing::StartsWith("gains: 'heading_lead_rad' = 4: expected a number from 0 to 3"));
}

TEST(HandSteering, WhatIsWrongIsNamedWithoutATableThatNobodyWrote) {
  EXPECT_THAT(refusal("foo = 1"), testing::StartsWith("gains: unknown key 'foo'; expected turn_gain, "));
  EXPECT_EQ(refusal("turn_gain = 1001"), "gains: 'turn_gain' = 1001: expected a number from 0 to 1000");
  EXPECT_EQ(refusal("turn_gain = 1; turn_gain = 1"), "gains: turn_gain is given twice; expected it once");
  EXPECT_THAT(refusal("change_s = 1"),
              testing::StartsWith("gains: \"change_s = 1\" steers nothing: expected "));
  for (const std::string text :
       {"", "turn_gain =", "; turn_gain = 1", "turn_gain", "turn_gain = 1 2", "# a = 1"})
    EXPECT_THAT(refusal(text), testing::HasSubstr("expected gains, KEY = VALUE with a comma between two"))
        << text;
}

}  // namespace
}  // namespace amble::tests
