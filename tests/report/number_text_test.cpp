#include "amble/report/number_text.hpp"

#include <gtest/gtest.h>

#include "amble/io/json_file.hpp"
#include "amble/report/html.hpp"
#include "amble/report/panels.hpp"

namespace amble::report {
namespace {

TEST(NumberText, HasThreeSignificantDigits) {
  EXPECT_EQ(number_text(0.0), "0");
  EXPECT_EQ(number_text(0.0456), "0.046");
  EXPECT_EQ(number_text(0.8421), "0.842");
  EXPECT_EQ(number_text(0.9996), "1.00");
  EXPECT_EQ(number_text(1.0), "1.00");
  EXPECT_EQ(number_text(-9.994), "\u22129.99");
  EXPECT_EQ(number_text(9.996), "10.0");
  EXPECT_EQ(number_text(99.94), "99.9");
  EXPECT_EQ(number_text(99.96), "100");
  EXPECT_EQ(number_text(10800.0), "10800");
}

TEST(NumberText, GivesAnIntervalTheDigitsOfItsEstimate) {
  EXPECT_EQ(estimate_text(9.8, statistics::Interval{6.14, 13.46}, " m"), "9.8 m [6.1, 13.5]");
  EXPECT_EQ(estimate_text(0.5, statistics::Interval{-0.25, 1.25}, ""), "0.50 [\u22120.25, 1.25]");
  EXPECT_EQ(estimate_text(2.0, std::nullopt, " s"), "2.00 s");
  EXPECT_EQ(share_text(0.25, statistics::Interval{0.0866, 0.491}), "25 % [9, 49]");
}

TEST(NumberText, WritesPValuesAsJournalsDo) {
  EXPECT_EQ(p_text(0.0004), "p < 0.001");
  EXPECT_EQ(p_text(0.001), "p = 0.001");
  EXPECT_EQ(p_text(0.0316), "p = 0.032");
  EXPECT_EQ(p_text(0.2149), "p = 0.21");
  EXPECT_EQ(p_text(0.995), "p > 0.99");
  EXPECT_EQ(p_text(1.0), "p = 1");
}

TEST(NumberText, NeverRoundsAPValueOntoALevel) {
  EXPECT_EQ(p_text(0.0499), "p = 0.0499");
  EXPECT_EQ(p_text(0.0501), "p = 0.0501");
  EXPECT_EQ(p_text(0.05), "p = 0.050");
  EXPECT_EQ(p_text(0.00999), "p = 0.00999");
  EXPECT_EQ(p_text(0.01), "p = 0.010");
}

TEST(NumberText, CountsOnlyOneInTheSingular) {
  EXPECT_EQ(counted(0, "run"), "0 runs");
  EXPECT_EQ(counted(1, "run"), "1 run");
  EXPECT_EQ(counted(2, "run"), "2 runs");
}

TEST(TiedText, BreaksNoIntervalAndNoUnit) {
  EXPECT_EQ(tied("2.0 m [1.5, 2.5] of 20 runs"), "2.0\u00A0m [1.5,\u00A02.5] of 20 runs");
  EXPECT_EQ(tied("at 95 %. Then 3 s"), "at 95\u00A0%. Then 3\u00A0s");
  EXPECT_EQ(tied("20 seeds"), "20 seeds");
}

TEST(Labels, AreCutWhereThereIsNoRoom) {
  EXPECT_EQ(fitted("short", 100.0), "short");
  const std::string cut = fitted("a label that is longer than that", 100.0);
  EXPECT_LE(label_width_px(cut), 100.0);
  EXPECT_TRUE(cut.starts_with("a la") && cut.ends_with("…that")) << cut;
  EXPECT_NE(fitted("SUPG, solid torso, 1 kg, friction 0.5", 150.0),
            fitted("SUPG, solid torso, 1 kg, friction 1.0", 150.0))
      << "what tells them apart is at the end";
  EXPECT_EQ(two_lines("one two", 200.0).size(), 1u);
  const auto lines = two_lines("friction infinite, torso heavy", 150.0);
  ASSERT_EQ(lines.size(), 2u);
  EXPECT_EQ(lines[0] + " " + lines[1], "friction infinite, torso heavy");
  for (double width = 1.0; width < 300.0; width += 1.0) {  // never inside a character
    const std::string text = fitted("größere Füße", width);
    EXPECT_NO_THROW(io::Json(text).dump()) << width;
  }
}

TEST(NumberText, ChangesItsDecimalsWhereRoundingReachesThePowersOfTen) {
  for (const double sign : {-1.0, 1.0}) {
    EXPECT_EQ(decimals_for({sign * 99.95}), 0);
    EXPECT_EQ(decimals_for({sign * 99.94}), 1);
    EXPECT_EQ(decimals_for({sign * 9.995}), 1);
    EXPECT_EQ(decimals_for({sign * 9.994}), 2);
    EXPECT_EQ(decimals_for({sign * 0.9995}), 2);
    EXPECT_EQ(decimals_for({sign * 0.9994}), 3);
    EXPECT_EQ(decimals_for({0.1, sign * 50.0, 3.0}), 1) << "of the largest";
  }
}

TEST(NumberText, WritesPValuesAtTheEndsOfTheirRanges) {
  EXPECT_EQ(p_text(0.00099), "p < 0.001");
  EXPECT_EQ(p_text(0.99), "p = 0.99");
  EXPECT_EQ(p_text(0.9901), "p > 0.99");
  EXPECT_EQ(p_text(0.0994), "p = 0.099");
  EXPECT_EQ(p_text(0.0995), "p = 0.10");
  EXPECT_EQ(p_text(0.0100000001), "p = 0.01000000") << "no more than eight decimals";
}

}  // namespace
}  // namespace amble::report
