#include "amble/damage/text.hpp"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "amble/core/error.hpp"

namespace amble::damage {
namespace {

TEST(DamageText, SaysAllKindsInOneLine) {
  const auto parts =
      parse("missing:FL,numb:BR@2.5,slack:k,locked:k=-0.25@1,weak:h=0.5,payload:torso=2/0.1/-0.2/0").parts;
  ASSERT_EQ(parts.size(), 6u);
  EXPECT_EQ(parts[0].kind, Kind::missing);
  EXPECT_EQ(parts[0].leg, "FL");
  EXPECT_EQ(parts[0].from_s, 0.0);
  EXPECT_EQ(parts[1].kind, Kind::numb);
  EXPECT_EQ(parts[1].leg, "BR");
  EXPECT_EQ(parts[1].from_s, 2.5);
  EXPECT_EQ(parts[2].joint, "k");
  EXPECT_EQ(parts[3].angle_rad, -0.25);
  EXPECT_EQ(parts[3].from_s, 1.0);
  EXPECT_EQ(parts[4].share, 0.5);
  EXPECT_EQ(parts[5].body, "torso");
  EXPECT_EQ(parts[5].mass_kg, 2.0);
  EXPECT_EQ(parts[5].y_m, -0.2);
}

TEST(DamageText, TakesTheLastOfTheCharactersThatEndANameForItsEnd) {
  const auto parts = parse("locked:left=knee=-0.5@2,weak:k@home=0.25@0,numb:a@b@3,missing:c:d").parts;
  ASSERT_EQ(parts.size(), 4u);
  EXPECT_EQ(parts[0].joint, "left=knee");
  EXPECT_EQ(parts[0].angle_rad, -0.5);
  EXPECT_EQ(parts[0].from_s, 2.0);
  EXPECT_EQ(parts[1].joint, "k@home");
  EXPECT_EQ(parts[1].share, 0.25);
  EXPECT_EQ(parts[2].leg, "a@b");
  EXPECT_EQ(parts[2].from_s, 3.0);
  EXPECT_EQ(parts[3].leg, "c:d");
}

TEST(DamageText, IsRefusedInOneLineThatSaysWhatWasExpected) {
  const auto refusal = [](const char* text) -> std::string {
    try {
      parse(text);
    } catch (const UserError& error) {
      return error.what();
    }
    return "accepted";
  };
  EXPECT_EQ(refusal("broken:FL"),
            "damage 'broken:FL': expected KIND:NAME[=NUMBER][@SECONDS], KIND being one of missing, locked, "
            "slack, weak, numb, payload");
  EXPECT_EQ(refusal("locked:k"), "damage 'locked:k': expected an angle in rad after '='");
  EXPECT_EQ(refusal("weak:k=1.5"), "damage 'weak:k=1.5': expected a share from 0 to 1 after '='");
  EXPECT_EQ(refusal("slack:k=1"), "damage 'slack:k=1': expected no number for this kind");
  EXPECT_EQ(refusal("missing:FL@-1"), "damage 'missing:FL@-1': expected a moment of 0 s or later after '@'");
  EXPECT_EQ(refusal("payload:t=2"), "damage 'payload:t=2': expected MASS_KG/X_M/Y_M/Z_M after '='");
  for (const char* text : {"", ",", "missing", "missing:FL,", "locked:k=nan", "locked:k=0x", "weak:k=inf"})
    EXPECT_NE(refusal(text), "accepted") << text;
}

TEST(DamageText, TakesNumbersFromTheLeastToTheMost) {
  const auto accepted = [](const std::string& text) {
    try {
      parse(text);
    } catch (const UserError&) {
      return false;
    }
    return true;
  };
  for (const char* text : {"locked:k=-1000", "locked:k=1000", "weak:k=0", "weak:k=1", "slack:k@0",
                           "slack:k@1e9", "slack:k=", "payload:t=1e-9/0/0/0", "payload:t=1e6/0/0/0",
                           "payload:t=1/-100/-100/-100", "payload:t=1/100/100/100"})
    EXPECT_TRUE(accepted(text)) << text;
  for (const char* text : {"locked:k=-1000.01", "locked:k=1000.01", "weak:k=-0.01", "weak:k=1.01",
                           "slack:k@-0.01", "slack:k@1.01e9", "slack:k@", "payload:t=0.99e-9/0/0/0",
                           "payload:t=1.01e6/0/0/0", "payload:t=1/-100.01/0/0", "payload:t=1/100.01/0/0",
                           "payload:t=1/0/-100.01/0", "payload:t=1/0/100.01/0", "payload:t=1/0/0/-100.01",
                           "payload:t=1/0/0/100.01", "payload:t=1/0/0", "payload:t=1/0/0/0/0", "numb:FL=1"})
    EXPECT_FALSE(accepted(text)) << text;
  const Part part = parse("payload:t=2/0.1/-0.2/0.3@4").parts.at(0);
  EXPECT_EQ((std::vector{part.mass_kg, part.x_m, part.y_m, part.z_m, part.from_s}),
            (std::vector{2.0, 0.1, -0.2, 0.3, 4.0}));
}

}  // namespace
}  // namespace amble::damage
