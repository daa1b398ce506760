#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <functional>
#include <limits>
#include <string>

#include "amble/core/error.hpp"
#include "amble/score/behaviour.hpp"
#include "amble/score/score.hpp"

namespace amble::score {
namespace {

/// Whether it holds in a process of its own: what is registered there is not in that of other tests.
void expect_apart(const std::function<bool()>& holds) {
  EXPECT_EXIT(std::exit(holds() ? 0 : 1), testing::ExitedWithCode(0), "");
}

/// Mean speed, more or less, as a quantity of an extension.
Quantity hurry(double factor = 1.0) {
  return {.name = "hurry",
          .unit = "m",
          .range = {0.0, 1e6},
          .measures = {.contacts = true},
          .of = [factor](const record::Trajectory& trajectory, const Context& context) {
            return factor * distance_m(trajectory) / context.duration_s;
          }};
}

record::Trajectory five_metres() {
  record::Trajectory trajectory;
  trajectory.steps = 1500;
  trajectory.timestep_s = 0.01;
  trajectory.com_end_m = {3.0, 4.0, 0.0};
  return trajectory;
}

TEST(RegisterQuantity, AddsOneThatScoresLimitsAndMapsName) {
  expect_apart([] {
    register_quantity(hurry());
    Settings settings;
    settings.terms = {{.quantity = "hurry", .weight = 6.0}};
    settings.validate();
    const Score score(settings, 15.0, 100.0);
    const DescriptorBehaviour behaviour(
        {.descriptors = {{.quantity = "hurry", .leg = ""}}, .duration_s = 10.0, .weight_n = 100.0});
    settings.limits = {{.quantity = "hurry", .most = 0.1}};
    return score.of(five_metres()) == 2.0 && score.measures().contacts && behaviour.measures().contacts &&
           behaviour.of(std::vector{five_metres()}) == std::vector{0.5f} &&
           Score(settings, 15.0, 100.0).of(five_metres()) == 0.0 && with_unit("2", settings) == "2 m";
  });
}

TEST(RegisterQuantity, ListsItAfterAmblesOwn) {
  expect_apart([] {
    const std::size_t own = quantities().size();
    register_quantity(hurry());
    try {
      quantity("speed", "score.terms");
    } catch (const UserError& error) {
      const std::string text = error.what();
      return quantities().size() == own + 1 && quantities().front().name == "distance" &&
             text.ends_with(", tracking, hurry");
    }
    return false;
  });
}

TEST(RegisterQuantity, RefusesANameThatIsTaken) {
  Quantity taken = hurry();
  taken.name = "distance";
  EXPECT_THROW(register_quantity(taken), UserError);
}

TEST(RegisterQuantityDeathTest, EndsTheProcessWhereAValueIsOutOfItsRange) {
  for (const double factor : {-1.0, std::numeric_limits<double>::infinity()})
    EXPECT_DEATH(
        {
          register_quantity(hurry(factor));
          Settings settings;
          settings.terms = {{.quantity = "hurry"}};
          Score(settings, 15.0, 100.0).of(five_metres());
        },
        "a quantity is in its range");
}

}  // namespace
}  // namespace amble::score
