#include "amble/neat/threshold.hpp"

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

TEST(Threshold, RisesWhileThereAreTooManySpecies) {
  Threshold threshold(5);
  threshold.steer(31, {});
  EXPECT_DOUBLE_EQ(threshold.value(), 5.1);  // 0.1 is more than 1 % of 5
  threshold.steer(31, {});
  EXPECT_DOUBLE_EQ(threshold.value(), 5.205);
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
    EXPECT_NE(complaint([&] { threshold.load(reader); }), "");
  }
}

}  // namespace
}  // namespace amble::neat
