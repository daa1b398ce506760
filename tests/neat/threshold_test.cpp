#include "amble/neat/speciation.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/neat/samples.hpp"

namespace amble::neat {
namespace {

TEST(Threshold, StaysWhileTheNumberOfSpeciesIsInTheRange) {
  Threshold threshold(100);
  for (const int species : {28, 29, 30}) EXPECT_FALSE(threshold.steer(species, {}));
  EXPECT_EQ(threshold.value(), 100.0);
}

TEST(Threshold, FallsFasterAndFasterWhileThereAreTooFewSpecies) {
  Threshold threshold(100);
  EXPECT_TRUE(threshold.steer(27, {}));
  EXPECT_DOUBLE_EQ(threshold.value(), 99.0);  // 1 % of 100
  threshold.steer(1, {});
  EXPECT_DOUBLE_EQ(threshold.value(), 99.0 - 1.05);
  threshold.steer(1, {});
  EXPECT_DOUBLE_EQ(threshold.value(), 99.0 - 1.05 - 1.05 * 1.05);
}

TEST(Threshold, RisesByHalfOfItselfWhileThereAreTooManySpecies) {
  Threshold threshold(5);
  threshold.steer(31, {});
  EXPECT_DOUBLE_EQ(threshold.value(), 7.5);
  threshold.steer(31, {});
  EXPECT_DOUBLE_EQ(threshold.value(), 7.5 + 2.5 * 1.05);
  threshold.steer(27, {});
  EXPECT_DOUBLE_EQ(threshold.value(), 7.5 + 2.5 * 1.05 - 1.25 * 1.05);
}

TEST(Threshold, TakesFirstStepsOfTheSizeThatIsSetButNeverBelowATenth) {
  SpeciationSettings settings;
  settings.first_step_up = 0.01;
  settings.first_step_down = 0.2;
  Threshold small(5), large(50), falling(50), falling_slowly(0.3);
  small.steer(31, settings);
  EXPECT_DOUBLE_EQ(small.value(), 5.1) << "0.1 is more than 1 % of 5";
  small.steer(31, settings);
  EXPECT_DOUBLE_EQ(small.value(), 5.205);
  large.steer(31, settings);
  EXPECT_DOUBLE_EQ(large.value(), 50.5);
  falling.steer(27, settings);
  EXPECT_DOUBLE_EQ(falling.value(), 40.0);
  falling_slowly.steer(27, settings);
  EXPECT_DOUBLE_EQ(falling_slowly.value(), 0.2);
}

TEST(Threshold, FollowsTheClosedFormOfAGeometricSeries) {
  // After n steps on one side: start × (1 ± share × (1.05^n − 1) / 0.05).
  Threshold up(10), down(1000);
  for (int n = 1; n <= 12; ++n) {
    up.steer(31, {});
    down.steer(1, {});
    const double steps = (std::pow(1.05, n) - 1.0) / 0.05;
    EXPECT_NEAR(up.value(), 10 * (1 + 0.5 * steps), 1e-9);
    EXPECT_NEAR(down.value(), 1000 * (1 - 0.01 * steps), 1e-9);
  }
}

TEST(Threshold, TurnsRoundByHalfAStepAfterSteppingOver) {
  Threshold threshold(100);
  threshold.steer(10, {});  // − 1
  threshold.steer(50, {});
  EXPECT_DOUBLE_EQ(threshold.value(), 99.5);
  threshold.steer(50, {});
  EXPECT_DOUBLE_EQ(threshold.value(), 99.5 + 0.525);
  threshold.steer(10, {});
  EXPECT_DOUBLE_EQ(threshold.value(), 99.5 + 0.525 - 0.2625);
}

TEST(Threshold, BeginsAnewAfterARest) {
  Threshold threshold(100);
  threshold.steer(10, {});
  threshold.steer(29, {});
  threshold.steer(10, {});
  EXPECT_DOUBLE_EQ(threshold.value(), 99.0 - 0.99);
}

TEST(Threshold, StopsAtTheLowestValueAndLeavesItByASmallStep) {
  Threshold threshold(100);
  for (int i = 0; i < 200; ++i) threshold.steer(1, {});
  EXPECT_EQ(threshold.value(), Threshold::lowest);
  EXPECT_FALSE(threshold.steer(1, {})) << "nothing changed";
  threshold.steer(300, {});
  EXPECT_DOUBLE_EQ(threshold.value(), Threshold::lowest + 0.1);
}

TEST(Threshold, ContinuesAfterSaveAndLoad) {
  Threshold threshold(100), loaded(7);
  for (int i = 0; i < 5; ++i) threshold.steer(1, {});
  io::BinaryWriter writer;
  threshold.save(writer);
  io::BinaryReader reader(writer.bytes(), "file");
  loaded.load(reader);
  reader.finish();
  EXPECT_EQ(loaded.value(), threshold.value());
  threshold.steer(1, {});
  loaded.steer(1, {});
  EXPECT_EQ(loaded.value(), threshold.value());
}

TEST(Threshold, RefusesValuesThatCannotBe) {
  for (const auto& [value, step] :
       {std::pair{0.0, 0.0}, std::pair{std::nan(""), 0.0}, std::pair{1.0, std::nan("")}}) {
    io::BinaryWriter writer;
    writer.put(value);
    writer.put(step);
    io::BinaryReader reader(writer.bytes(), "file");
    Threshold threshold(1);
    EXPECT_NE(error_of([&] { threshold.load(reader); }), "");
  }
}

TEST(Threshold, LoadsItsLowestValueAndNothingBelowOrBeyondNumbers) {
  const auto refused = [](double value, double step) {
    io::BinaryWriter writer;
    writer.put(value);
    writer.put(step);
    io::BinaryReader reader(writer.bytes(), "file");
    Threshold threshold(1);
    return !error_of([&] { threshold.load(reader); }).empty();
  };
  EXPECT_FALSE(refused(Threshold::lowest, -1.0));
  EXPECT_TRUE(refused(std::nextafter(Threshold::lowest, 0.0), 0.0));
  EXPECT_TRUE(refused(HUGE_VAL, 0.0));
  EXPECT_TRUE(refused(1.0, HUGE_VAL));
  EXPECT_TRUE(refused(1.0, -HUGE_VAL));
}

TEST(Threshold, ForgetsItsStepAtTheLowestValue) {
  SpeciationSettings settings;
  settings.first_step_up = 0.5;
  Threshold threshold(0.05);
  EXPECT_TRUE(threshold.steer(1, settings));
  EXPECT_EQ(threshold.value(), Threshold::lowest);
  EXPECT_TRUE(threshold.steer(300, settings));
  EXPECT_DOUBLE_EQ(threshold.value(), Threshold::lowest + 0.1) << "not half a step back";
}

}  // namespace
}  // namespace amble::neat
