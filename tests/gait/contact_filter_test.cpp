#include "amble/gait/meter.hpp"

#include <gtest/gtest.h>

#include <string>

#include "amble/core/random.hpp"

namespace amble::gait {
namespace {

std::vector<bool> bits(const std::string& text) {
  std::vector<bool> bits;
  for (const char c : text) bits.push_back(c == '1');
  return bits;
}

std::string text(const std::vector<bool>& bits) {
  std::string text;
  for (const bool bit : bits) text += bit ? '1' : '0';
  return text;
}

TEST(ContactFilter, PassesTheSensorAsItIsWithoutDebouncing) {
  const std::string touch = "0101100110111010000110";
  for (const int none : {0, 1}) EXPECT_EQ(text(debounced(bits(touch), none)), touch);
}

TEST(ContactFilter, ClosesGapsThatAreTooShortAndLeavesLongerOnes) {
  EXPECT_EQ(text(debounced(bits("0111011100111000111"), 3)), "0111111111111000111");
}

TEST(ContactFilter, DropsTouchesThatAreTooShort) {
  EXPECT_EQ(text(debounced(bits("0001000011000011100"), 3)), "0000000000000011100");
}

TEST(ContactFilter, TakesChatterForAStanceOfTheSameLength) {
  EXPECT_EQ(text(debounced(bits("0000101010101010000"), 3)), "0000111111111110000");
}

TEST(ContactFilter, JudgesUnfinishedStancesAtTheEndByWhatIsThere) {
  EXPECT_EQ(text(debounced(bits("00011"), 3)), "00000");
  EXPECT_EQ(text(debounced(bits("00111"), 3)), "00111");
  EXPECT_EQ(text(debounced(bits("11100"), 3)), "11100");
  EXPECT_EQ(text(debounced(bits(""), 3)), "");
  EXPECT_EQ(text(debounced(bits("1"), 1)), "1");
}

/// The rule in its own words, with the whole record at hand.
std::vector<bool> slow_twin(std::vector<bool> touch, std::size_t shortest) {
  const auto replace_short_runs = [&](bool value, bool inside_only) {
    for (std::size_t begin = 0; begin < touch.size();) {
      std::size_t end = begin;
      while (end < touch.size() && touch[end] == touch[begin]) ++end;
      const bool inside = begin > 0 && end < touch.size();
      if (touch[begin] == value && end - begin < shortest && (inside || !inside_only))
        for (std::size_t k = begin; k < end; ++k) touch[k] = !value;
      begin = end;
    }
  };
  replace_short_runs(false, true);
  replace_short_runs(true, false);
  return touch;
}

TEST(ContactFilter, DoesFrameByFrameWhatItsRuleDoesToAWholeRecord) {
  Stream stream(5, Purpose::test);
  for (int n = 0; n < 3000; ++n) {
    const int shortest = 1 + static_cast<int>(stream.uniform(0.0, 9.0));
    const double stay = stream.uniform(0.3, 0.98);
    std::vector<bool> touch{stream.uniform(0.0, 1.0) < 0.5};
    const auto frames = static_cast<std::size_t>(stream.uniform(1.0, 120.0));
    while (touch.size() < frames)
      touch.push_back(stream.uniform(0.0, 1.0) < stay ? touch.back() : !touch.back());
    ASSERT_EQ(text(debounced(touch, shortest)), text(slow_twin(touch, static_cast<std::size_t>(shortest))))
        << text(touch) << " " << shortest;
  }
}

}  // namespace
}  // namespace amble::gait
