#include "amble/cppn/activation.hpp"

#include <gtest/gtest.h>

#include <limits>

#include "amble/core/hash.hpp"
#include "amble/core/random.hpp"
#include "tests/cppn/plain_twin.hpp"
#include "tests/cppn/targets.hpp"

namespace amble::cppn {
namespace {

using neat::Activation;

constexpr float infinity = std::numeric_limits<float>::infinity();
constexpr std::uint32_t bits_of_infinity = 0x7f800000;

/// Every `stride`-th float from zero (or from `first`) to infinity (not included), positive and negative.
std::vector<float> floats(std::uint32_t stride, float first = 0.0f) {
  std::vector<float> values;
  for (std::uint32_t b = plain::bits(first); b < bits_of_infinity; b += stride) {
    values.push_back(std::bit_cast<float>(b));
    values.push_back(-values.back());
  }
  return values;
}

std::vector<float> activated(Activation function, std::vector<float> values,
                             Linear linear = Linear::absolute) {
  activate(function, linear, values);
  return values;
}

float activated(Activation function, float x, Linear linear = Linear::absolute) {
  return activated(function, std::vector<float>{x}, linear)[0];
}

template <typename Exact>
void expect_error_below(double bound, Activation function, const std::vector<float>& arguments, Exact exact) {
  const std::vector<float> values = activated(function, arguments);
  double worst = 0.0;
  float worst_at = 0.0f;
  for (std::size_t i = 0; i < values.size(); ++i) {
    const double error = std::fabs(static_cast<double>(values[i]) - exact(static_cast<double>(arguments[i])));
    if (error <= worst) continue;
    worst = error;
    worst_at = arguments[i];
  }
  EXPECT_LT(worst, bound) << "at " << worst_at;
  EXPECT_GT(worst, bound / 5) << "the stated bound is needlessly loose";
}

TEST(BipolarSigmoid, KeepsItsStatedErrorOverAllFloats) {
  const auto exact = [](double x) { return 2.0 / (1.0 + std::exp(-x)) - 1.0; };
  expect_error_below(1e-7, Activation::bipolar_sigmoid, floats(9973), exact);
  expect_error_below(1e-7, Activation::bipolar_sigmoid, floats(997, 0.01f), exact);
}

TEST(Gaussian, KeepsItsStatedErrorOverAllFloats) {
  const auto exact = [](double x) { return 2.0 * std::exp(-6.25 * x * x) - 1.0; };
  expect_error_below(2e-7, Activation::gaussian, floats(9973), exact);
  expect_error_below(2e-7, Activation::gaussian, floats(997, 0.01f), exact);
}

TEST(Sine, KeepsItsStatedErrorOverAllFloatsEvenHuge) {
  const auto exact = [](double x) { return std::sin(2.0 * x); };
  expect_error_below(1.5e-7, Activation::sine, floats(9973), exact);
  expect_error_below(1.5e-7, Activation::sine, floats(4999, 100.0f), exact);
}

TEST(Sine, IsMorePreciseStillNearItsZeros) {
  // The floats next to multiples of π/2 are where a careless reduction of the range fails.
  std::vector<float> arguments;
  for (int k = 1; k < 200000; k += 7) {
    const float x = static_cast<float>(k * 1.5707963267948966);
    for (const float y : {std::nextafter(x, 0.0f), x, std::nextafter(x, infinity)}) arguments.push_back(y);
  }
  expect_error_below(2e-8, Activation::sine, arguments, [](double x) { return std::sin(2.0 * x); });
}

TEST(Activations, StayWithinMinusOneAndOne) {
  std::vector<float> arguments = floats(997, 0.1f);
  arguments.insert(arguments.end(), {infinity, -infinity, 0.0f, -0.0f});
  for (const auto function : {Activation::bipolar_sigmoid, Activation::gaussian, Activation::sine})
    for (const float value : activated(function, arguments))
      ASSERT_TRUE(value >= -1.0f && value <= 1.0f) << value;
}

TEST(Activations, AreOddOrEvenExactly) {
  const std::vector<float> arguments = floats(9973);
  const auto sigmoid = activated(Activation::bipolar_sigmoid, arguments),
             sine = activated(Activation::sine, arguments),
             gaussian = activated(Activation::gaussian, arguments);
  for (std::size_t i = 0; i < arguments.size(); i += 2) {
    ASSERT_EQ(sigmoid[i], -sigmoid[i + 1]) << arguments[i];
    ASSERT_EQ(sine[i], -sine[i + 1]) << arguments[i];
    ASSERT_EQ(gaussian[i], gaussian[i + 1]) << arguments[i];
  }
}

TEST(Activations, HaveExactValuesWhereTheyMust) {
  EXPECT_EQ(activated(Activation::bipolar_sigmoid, 0.0f), 0.0f);
  EXPECT_EQ(activated(Activation::bipolar_sigmoid, infinity), 1.0f);
  EXPECT_EQ(activated(Activation::bipolar_sigmoid, -infinity), -1.0f);
  EXPECT_EQ(activated(Activation::gaussian, 0.0f), 1.0f);
  EXPECT_EQ(activated(Activation::gaussian, infinity), -1.0f);
  EXPECT_EQ(activated(Activation::gaussian, 1e30f), -1.0f);
  EXPECT_EQ(activated(Activation::sine, 0.0f), 0.0f);
  EXPECT_EQ(activated(Activation::sine, infinity), 0.0f);
  EXPECT_EQ(activated(Activation::sine, -infinity), 0.0f);
  EXPECT_EQ(activated(Activation::linear, -3.25f), 3.25f);
  EXPECT_EQ(activated(Activation::linear, -3.25f, Linear::identity), -3.25f);
}

TEST(Linear, IsClampedToTwoToTheSixtyFour) {
  for (const float x : {0x1p64f, 0x1.000002p64f, 1e38f, infinity}) {
    EXPECT_EQ(activated(Activation::linear, x), 0x1p64f);
    EXPECT_EQ(activated(Activation::linear, -x), 0x1p64f);
    EXPECT_EQ(activated(Activation::linear, x, Linear::identity), 0x1p64f);
    EXPECT_EQ(activated(Activation::linear, -x, Linear::identity), -0x1p64f);
  }
}

TEST(SineAngleOfLarge, AgreesWithTheLibraryOverItsRange) {
  for (const float x : floats(99991, 4096.5f)) {
    const float angle = sine_angle_of_large(x);
    ASSERT_LE(std::fabs(angle), 1.5707964f);
    ASSERT_NEAR(std::sin(static_cast<double>(angle)), std::sin(2.0 * static_cast<double>(x)), 1e-7) << x;
  }
}

TEST(Activations, GiveTheBitsOfThePlainTwinOnEveryInstructionSet) {
  std::vector<float> arguments = floats(65521);
  const std::vector<float> middle = floats(4999, 1e-3f);
  arguments.insert(arguments.end(), middle.begin(), middle.end());
  arguments.insert(arguments.end(), {infinity, -infinity, 4096.0f, std::nextafter(4096.0f, infinity)});
  ASSERT_NE(arguments.size() % 16, 0u);  // so that an incomplete vector is among them
  for (int f = 0; f < 4; ++f) {
    for (const Linear linear : {Linear::absolute, Linear::identity}) {
      const auto function = static_cast<Activation>(f);
      std::vector<float> expected;
      for (const float x : arguments) expected.push_back(plain::activated(function, linear, x));
      for_each_target([&] {
        const std::vector<float> values = activated(function, arguments, linear);
        for (std::size_t i = 0; i < values.size(); ++i)
          ASSERT_EQ(plain::bits(values[i]), plain::bits(expected[i]))
              << "function " << f << " of " << arguments[i];
      });
    }
  }
}

TEST(Activations, GiveTheSameBitsForEver) {
  // The plain twin shares the constants; these numbers do not. A change of one of them is a change of every
  // run: it needs a reason and an entry in the changelog.
  std::vector<float> arguments = floats(65521);
  for (const float first : {1e-3f, 0.1f}) {
    const std::vector<float> middle = floats(4999, first);
    arguments.insert(arguments.end(), middle.begin(), middle.end());
  }
  arguments.insert(arguments.end(), {infinity, -infinity});
  const auto hash_of = [&](Activation function, Linear linear) {
    return hex(hash_span<float>(activated(function, arguments, linear)));
  };
  for_each_target([&] {
    EXPECT_EQ(hash_of(Activation::bipolar_sigmoid, Linear::absolute), "15cb5b59585e91f4");
    EXPECT_EQ(hash_of(Activation::gaussian, Linear::absolute), "fb59e0c44fbf6ece");
    EXPECT_EQ(hash_of(Activation::sine, Linear::absolute), "7fd554d9bf82676d");
    EXPECT_EQ(hash_of(Activation::linear, Linear::absolute), "dcb96b3579842f12");
    EXPECT_EQ(hash_of(Activation::linear, Linear::identity), "d8a31574dfc7d8dd");
  });
}

}  // namespace
}  // namespace amble::cppn
