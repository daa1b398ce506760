#include "amble/io/settings_text.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

namespace amble::io {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr std::int64_t largest = std::numeric_limits<std::int64_t>::max();

TEST(Expectation, SaysBoundsAndWhetherInfinityIsAValue) {
  EXPECT_EQ(expected_number({0.0, 1.0}), "a number from 0 to 1");
  EXPECT_EQ(expected_number({0.5}), "a number from 0.5 to inf");
  EXPECT_EQ(expected_number({-infinity, 3.0}), "a number from -inf to 3");
  EXPECT_EQ(expected_number({}), "a number");
  EXPECT_EQ(expected_number({0.0, std::numeric_limits<double>::max()}), "a finite number of at least 0");
  EXPECT_EQ(expected_integer({2, 1000000}), "a whole number from 2 to 1000000");
  EXPECT_EQ(expected_integer({1}), "a whole number of at least 1");
  EXPECT_EQ(expected_integer({-infinity, 9}), "a whole number of at most 9");
  EXPECT_EQ(expected_integer({}), "a whole number");
  EXPECT_EQ(expected_numbers({0.0, 1e-9}), "a list of numbers from 0 to 1e-09");
  constexpr std::array<std::string_view, 2> names{"absolute", "identity"};
  EXPECT_EQ(expected_choice(names), "one of \"absolute\", \"identity\"");
}

TEST(Expectation, BoundsBelongToTheRange) {
  EXPECT_TRUE(in_range({0.0, 1.0}, 0.0));
  EXPECT_TRUE(in_range({0.0, 1.0}, 1.0));
  EXPECT_FALSE(in_range({0.0, 1.0}, std::nextafter(1.0, 2.0)));
  EXPECT_FALSE(in_range({0.0, 1.0}, infinity));
  EXPECT_TRUE(in_range({0.0}, infinity));
  EXPECT_FALSE(in_range({0.0}, -infinity));
  EXPECT_FALSE(in_range({}, std::nan("")));
}

TEST(Expectation, ComparesWholeNumbersExactly) {
  EXPECT_TRUE(in_range({}, largest));
  EXPECT_TRUE(in_range({0.0, 9007199254740992.0}, std::int64_t{9007199254740992}));
  EXPECT_FALSE(in_range({0.0, 9007199254740992.0}, std::int64_t{9007199254740993}));
}

TEST(Expectation, SaysAFiniteNumberWhereEitherEndIsTheLargestOne) {
  constexpr double most = std::numeric_limits<double>::max();
  EXPECT_EQ(expected_number({-most, 3.0}), "a finite number of at most 3");
  EXPECT_EQ(expected_number({-most, most}), "a finite number");
  EXPECT_EQ(expected_number({-most, infinity}), "a finite number");
  EXPECT_EQ(expected_numbers({2.0}), "a list of numbers from 2 to inf");
  EXPECT_EQ(expected_numbers({}), "a list of numbers");
}

TEST(Expectation, BoundsOfWholeNumbersBelongToTheRange) {
  EXPECT_TRUE(in_range({-3.0, 5.0}, std::int64_t{-3}));
  EXPECT_TRUE(in_range({-3.0, 5.0}, std::int64_t{5}));
  EXPECT_FALSE(in_range({-3.0, 5.0}, std::int64_t{-4}));
  EXPECT_FALSE(in_range({-3.0, 5.0}, std::int64_t{6}));
  EXPECT_FALSE(in_range({0.5, 1.5}, std::int64_t{0}));
  EXPECT_TRUE(in_range({-infinity, infinity}, std::numeric_limits<std::int64_t>::min()));
}

}  // namespace
}  // namespace amble::io
