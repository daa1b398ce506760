#include "amble/morphology/mjcf_schema.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "amble/morphology/robot_guess.hpp"
#include "tests/models/small_models.hpp"
#include "tests/morphology/files.hpp"

namespace amble::morphology {
namespace {

using testing::Contains;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

TEST(MjcfSchema, HasTheAttributesOfAnElementFromAllItsLines) {
  EXPECT_THAT(known_attributes("geom"), Contains("mass"));
  EXPECT_THAT(known_attributes("geom"), Contains("fromto"));
  EXPECT_THAT(known_attributes("geom"), Not(Contains("armature")));
  EXPECT_THAT(known_attributes("joint"), Contains("armature"));
  EXPECT_THAT(known_attributes("robot"), IsEmpty());
}

TEST(MjcfSchema, KnowsSlipsOfThePenAndNoNamesOfNewerVersions) {
  EXPECT_EQ(misspelt_attribute("geom", "mas"), "mass");
  EXPECT_EQ(misspelt_attribute("joint", "rang"), "range");
  EXPECT_EQ(misspelt_attribute("joint", "amrature"), "armature");
  EXPECT_EQ(misspelt_attribute("geom", "actuatorfrcrange"), "");
  EXPECT_EQ(misspelt_attribute("position", "timeconst"), "");
  EXPECT_EQ(misspelt_attribute("option", "integrator"), "") << "known; its value may not be";
  EXPECT_EQ(misspelt_attribute("no_element", "mass"), "");
}

TEST(MjcfSchema, ASlipOfThePenIsAWarningWithItsLine) {
  const Files files;
  std::string text = one_leg_xml;
  text.replace(text.find("mass="), 5, "mas=");
  const auto line =
      1 + std::count(text.begin(), text.begin() + static_cast<std::ptrdiff_t>(text.find("mas=")), '\n');
  const auto guess = guess_robot(compile_model(files.write("r.xml", text)), "r.xml");
  EXPECT_THAT(
      guess.doubts,
      Contains(HasSubstr(fmt::format(
          "r.xml:{}: attribute 'mas' of <geom>, which MuJoCo does not know (did you mean 'mass'?)", line))));
}

}  // namespace
}  // namespace amble::morphology
