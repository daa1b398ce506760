#include "amble/score/score.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "amble/core/error.hpp"
#include "amble/core/random.hpp"
#include "amble/io/file.hpp"
#include "amble/io/settings_text.hpp"

namespace amble::score {
namespace {

TEST(Distance, CountsTheHorizontalShiftInAnyDirectionAndNoHeight) {
  record::Trajectory trajectory;
  trajectory.com_start_m = {1.0, 2.0, 0.8};
  trajectory.com_end_m = {-2.0, -2.0, 0.3};
  EXPECT_DOUBLE_EQ(distance_m(trajectory), 5.0);
}

TEST(Distance, IsNothingWhereTheSimulationBrokeDown) {
  record::Trajectory trajectory;
  trajectory.com_end_m = {60.0, 0.0, 0.3};
  trajectory.outcome = record::Outcome::diverged;
  EXPECT_EQ(distance_m(trajectory), 0.0);
  trajectory.outcome = record::Outcome::fell;
  EXPECT_EQ(distance_m(trajectory), 60.0);
}

TEST(Distance, CountsForItsShareOnlyIfTheRobotFell) {
  EXPECT_EQ(credited(4.0, record::Outcome::fell, 0.25), 1.0);
  EXPECT_EQ(credited(0.1 + 0.2, record::Outcome::fell, 1.0), 0.1 + 0.2);
  EXPECT_EQ(credited(4.0, record::Outcome::completed, 0.25), 4.0);
}

/// 15 s in which the robot went 3 m along x and 4 m along y, leant over by 60 degrees, and spent 200 J.
record::Trajectory walk() {
  record::Trajectory trajectory;
  trajectory.steps = 1500;
  trajectory.timestep_s = 0.01;
  trajectory.com_end_m = {3.0, 4.0, 0.0};
  trajectory.energy_j = 200.0;
  trajectory.upright_steps = 750.0;
  return trajectory;
}

/// What a score of this quantity alone makes of the walk of a robot that weighs 100 N.
double of_walk(const std::string& quantity, Settings settings = {}) {
  settings.terms = {{.quantity = quantity}};
  return Score(settings, 15.0, 100.0).of(walk());
}

// What the tasks of configs/tasks are made of.
TEST(Score, AddsUpRewardsOfStepsFromTheRootsWayAndTheEffort) {
  record::Trajectory trajectory = walk();
  trajectory.steps = 600;
  trajectory.root_start_m = {0.5, 1.0, 0.7};
  trajectory.root_end_m = {2.5, 9.0, 0.2};
  trajectory.effort_steps = 40.0;
  Settings settings;
  settings.terms = {{.quantity = "root_forward", .weight = 100.0},
                    {.quantity = "upright_time", .weight = 1500.0},
                    {.quantity = "effort", .weight = -0.5}};
  settings.validate();
  const Score score(settings, 15.0, 100.0);
  EXPECT_DOUBLE_EQ(score.of(trajectory), 200.0 + 600.0 - 20.0);
  EXPECT_TRUE(score.measures().root && score.measures().effort && score.measures().need_torques());
  EXPECT_FALSE(score.measures().energy);
  trajectory.forward_x = 0.0;
  trajectory.forward_y = 1.0;
  EXPECT_DOUBLE_EQ(score.of(trajectory), 800.0 + 600.0 - 20.0) << "along its own forward axis";
}

TEST(Score, IsTheDistanceByDefaultToTheBit) {
  EXPECT_TRUE(Settings().is_distance());
  EXPECT_EQ(Score({}, 15.0, 100.0).of(walk()), distance_m(walk()));
  EXPECT_FALSE(Score({}, 15.0, 100.0).measures().energy);
  EXPECT_EQ(with_unit("3.5", {}), "3.5 m");
}

TEST(Score, KnowsEachOfItsQuantities) {
  EXPECT_EQ(of_walk("distance"), 5.0);
  EXPECT_EQ(of_walk("forward"), 3.0);
  EXPECT_EQ(of_walk("heading"), 3.0);
  EXPECT_DOUBLE_EQ(of_walk("economy"), 100.0 * 5.0 / 200.0);
  EXPECT_EQ(of_walk("uprightness"), 0.5);
  EXPECT_EQ(of_walk("upright_time"), 1.0);
}

TEST(Heading, IsExactForMultiplesOfAQuarterTurn) {
  EXPECT_EQ(of_walk("heading", {.heading_deg = 90.0}), 4.0) << "to the left";
  EXPECT_EQ(of_walk("heading", {.heading_deg = -270.0}), 4.0);
  EXPECT_EQ(of_walk("heading", {.heading_deg = 360.0}), 3.0);
  for (const double backwards_deg : {180.0, -180.0}) {
    Settings settings{.terms = {{.quantity = "heading", .weight = -1.0}}, .heading_deg = backwards_deg};
    EXPECT_EQ(Score(settings, 15.0, 100.0).of(walk()), 3.0);
  }
}

TEST(Heading, AgreesWithTheLibrarysSineAndCosineAtEveryAngle) {
  Settings settings{.terms = {{.quantity = "distance", .weight = 2.0}, {.quantity = "heading"}}};
  for (double angle_deg = -360.0; angle_deg <= 360.0; angle_deg += 0.37) {
    settings.heading_deg = angle_deg;
    const double angle_rad = angle_deg * std::numbers::pi / 180.0;
    EXPECT_NEAR(Score(settings, 15.0, 100.0).of(walk()),
                10.0 + 3.0 * std::cos(angle_rad) + 4.0 * std::sin(angle_rad), 1e-14)
        << angle_deg;
  }
}

TEST(Heading, IsCountedFromTheRobotsOwnForwardAxisAtTheStart) {
  auto trajectory = walk();
  trajectory.forward_x = 0.0;
  trajectory.forward_y = 1.0;
  Settings settings{.terms = {{.quantity = "forward"}}};
  EXPECT_EQ(Score(settings, 15.0, 100.0).of(trajectory), 4.0);
  settings = {.terms = {{.quantity = "heading"}}, .heading_deg = -90.0};
  EXPECT_EQ(Score(settings, 15.0, 100.0).of(trajectory), 3.0) << "to the right of a robot that faces +y";
}

/// What speed_kept makes of so many metres along x in each second of a trial that may have been longer.
double kept(const std::vector<double>& metres, double wanted_m_s, double duration_s,
            double heading_deg = 0.0) {
  record::Trajectory trajectory;
  double x_m = 0.0;
  for (const double m : metres) {
    x_m += m;
    trajectory.com_by_second_m.insert(trajectory.com_by_second_m.end(), {x_m, 0.1});
  }
  trajectory.com_end_m = {x_m, 0.1, 0.0};
  const Settings settings{
      .terms = {{.quantity = "speed_kept"}}, .heading_deg = heading_deg, .speed_m_s = wanted_m_s};
  return Score(settings, duration_s, 100.0).of(trajectory);
}

TEST(SpeedKept, IsAMeanOverSecondsOfHowCloseToTheOneWantedTheSpeedIs) {
  EXPECT_DOUBLE_EQ(kept({0.5, 0.5, 0.5, 0.5}, 0.5, 4.0), 1.0);
  EXPECT_DOUBLE_EQ(kept({0.25, 0.75}, 0.5, 2.0), 0.5) << "too slow costs what too fast costs";
  EXPECT_DOUBLE_EQ(kept({1.0, 0.0, 1.0, 0.0}, 0.5, 4.0), 0.0) << "although its mean speed is right";
  EXPECT_DOUBLE_EQ(kept({2.0, 0.5}, 0.5, 2.0), 0.5) << "a second costs no more than itself";
  EXPECT_DOUBLE_EQ(kept({-0.5, 0.5}, 0.5, 2.0), 0.5);
  EXPECT_DOUBLE_EQ(kept({-0.5, -0.5}, 0.5, 2.0, 180.0), 1.0);
}

TEST(SpeedKept, CountsNothingForSecondsAfterAFall) {
  EXPECT_DOUBLE_EQ(kept({0.5}, 0.5, 4.0), 0.25);
  EXPECT_DOUBLE_EQ(kept({}, 0.5, 4.0), 0.0);
}

TEST(SpeedKept, IsOfWholeSecondsAndOfTheWholeOfAShorterTrial) {
  EXPECT_DOUBLE_EQ(kept({0.5, 0.5}, 0.5, 2.9), 1.0);
  EXPECT_DOUBLE_EQ(kept({0.5, 0.5, 0.5}, 0.5, 300 * 0.01), 1.0) << "3 s, with or without a rounding error";
  record::Trajectory trajectory;
  trajectory.com_end_m = {0.2, 0.0, 0.0};
  const Settings settings{.terms = {{.quantity = "speed_kept"}}, .speed_m_s = 0.8};
  EXPECT_DOUBLE_EQ(Score(settings, 0.5, 100.0).of(trajectory), 0.5);
  EXPECT_TRUE(Score(settings, 0.5, 100.0).measures().seconds);
}

/// A trial as wild as numbers allow.
record::Trajectory wild_trial(Stream& stream) {
  record::Trajectory trajectory;
  trajectory.steps = 1 + static_cast<int>(stream.below(1500));
  trajectory.timestep_s = 0.01;
  const auto far_m = [&stream] {
    return stream.uniform(-1.0, 1.0) * std::pow(10.0, stream.uniform(-3.0, 3.0));
  };
  trajectory.com_start_m = {far_m(), far_m(), far_m()};
  trajectory.com_end_m = {far_m(), far_m(), far_m()};
  const double yaw_rad = stream.uniform(-std::numbers::pi, std::numbers::pi);
  trajectory.forward_x = std::cos(yaw_rad);
  trajectory.forward_y = std::sin(yaw_rad);
  const double end_yaw_rad = stream.uniform(-std::numbers::pi, std::numbers::pi);
  trajectory.forward_end_x = std::cos(end_yaw_rad);
  trajectory.forward_end_y = std::sin(end_yaw_rad);
  for (int leg = 0; leg < 4; ++leg)
    trajectory.contact_steps.push_back(
        static_cast<int>(stream.below(1u + static_cast<std::uint32_t>(trajectory.steps))));
  trajectory.height_steps_m = trajectory.steps * far_m();
  for (int i = 0; i < 2 * record::second_count(trajectory.seconds()); ++i)
    trajectory.com_by_second_m.push_back(far_m());
  trajectory.energy_j = std::max(0.0, far_m());
  trajectory.upright_steps = trajectory.steps * stream.uniform(-1.0, 1.0);
  return trajectory;
}

TEST(Score, OfEachQuantityStaysInItsRange) {
  Stream stream(20, Purpose::test);
  for (int i = 0; i < 5000; ++i) {
    const auto trajectory = wild_trial(stream);
    const Settings settings{.heading_deg = stream.uniform(-360.0, 360.0),
                            .speed_m_s = stream.uniform(0.01, 10.0)};
    for (const Quantity& quantity : quantities()) {
      const double value =
          quantity.of(trajectory, {.settings = settings, .duration_s = 15.0, .weight_n = 100.0});
      EXPECT_TRUE(std::isfinite(value) && io::in_range(quantity.range, value))
          << quantity.name << " = " << value;
    }
  }
}

/// A quantity of a trajectory, of a leg or of all.
double quantity_of(const std::string& name, const record::Trajectory& trajectory, int leg = -1) {
  const Settings settings;
  return quantity(name, "it")
      .of(trajectory, {.settings = settings, .duration_s = 15.0, .weight_n = 100.0, .leg = leg});
}

TEST(Score, TurnIsTheAngleBetweenTheForwardAxes) {
  for (int start_deg = -180; start_deg < 180; start_deg += 45)
    for (int turn_deg = -179; turn_deg <= 180; ++turn_deg) {
      const double start_rad = start_deg * std::numbers::pi / 180.0;
      const double end_rad = (start_deg + turn_deg) * std::numbers::pi / 180.0;
      record::Trajectory trajectory;
      trajectory.forward_x = std::cos(start_rad), trajectory.forward_y = std::sin(start_rad);
      trajectory.forward_end_x = std::cos(end_rad), trajectory.forward_end_y = std::sin(end_rad);
      const double error_deg = std::abs(quantity_of("turn", trajectory) - turn_deg);
      EXPECT_LT(std::min(error_deg, 360.0 - error_deg), 1e-12 * 180.0) << start_deg << ", " << turn_deg;
    }
  EXPECT_EQ(quantity_of("turn", {}), 0.0);
}

TEST(Score, SidewaysIsToTheLeftOfTheForwardAxis) {
  record::Trajectory trajectory = walk();
  EXPECT_DOUBLE_EQ(quantity_of("sideways", trajectory), 4.0);
  trajectory.forward_x = 0.0, trajectory.forward_y = 1.0;
  EXPECT_DOUBLE_EQ(quantity_of("sideways", trajectory), -3.0);
}

TEST(Score, DutyFactorIsTheShareOfStepsInContactOfALegOrOfAll) {
  record::Trajectory trajectory = walk();
  trajectory.contact_steps = {1500, 750, 0, 300};
  EXPECT_EQ(quantity_of("duty_factor", trajectory, 0), 1.0);
  EXPECT_EQ(quantity_of("duty_factor", trajectory, 3), 0.2);
  EXPECT_DOUBLE_EQ(quantity_of("duty_factor", trajectory), 0.425);
}

TEST(Score, PhaseIsTheCircularMeanOverTheFirstLegsWholeStrides) {
  record::Trajectory trajectory = walk();
  trajectory.footfall_steps = {
      {100, 200, 300, 400},      // strides of a second
      {50, 150, 250, 350, 450},  // half of one later; before and after whole strides does not count
      {195, 205, 305},           // around 0: 0.95 and 0.05 twice
      {}};
  EXPECT_EQ(quantity_of("phase", trajectory, 0), 0.0);
  EXPECT_DOUBLE_EQ(quantity_of("phase", trajectory, 1), 0.5);
  const double tenth = 0.1 * std::numbers::pi;
  EXPECT_NEAR(quantity_of("phase", trajectory, 2),
              std::atan(std::tan(tenth) / 3.0) / (2.0 * std::numbers::pi), 1e-12);
  EXPECT_EQ(quantity_of("phase", trajectory, 3), 0.0);
  trajectory.footfall_steps[3] = {370, 390};
  EXPECT_NEAR(quantity_of("phase", trajectory, 3), 0.8, 1e-12);
  trajectory.footfall_steps.resize(2);
  EXPECT_DOUBLE_EQ(quantity_of("phase", trajectory), 0.25);
  trajectory.footfall_steps[0] = {100};
  EXPECT_EQ(quantity_of("phase", trajectory, 1), 0.0) << "no whole stride";
}

TEST(Score, HeightAndEnergyAreAsMeasured) {
  record::Trajectory trajectory = walk();
  trajectory.height_steps_m = 600.0;
  EXPECT_EQ(quantity_of("height", trajectory), 0.4);
  EXPECT_EQ(quantity_of("energy", trajectory), 200.0);
}

TEST(Score, HasEachOfItsQuantitiesInTheDocsWithUnitAndRange) {
  const std::string page = io::read_file(AMBLE_SOURCE_DIR "/docs/SCORES.md");
  for (const Quantity& quantity : quantities()) {
    const auto bound = [](double value) {
      const std::string size = std::isfinite(value) ? fmt::format("{}", std::abs(value)) : "∞";
      return (value < 0.0 ? "−" : "") + size;
    };
    const std::string lowest = bound(quantity.range.lowest);
    const auto row =
        fmt::format("| `{}` | {} | {} … {} |", quantity.name, quantity.unit.empty() ? "–" : quantity.unit,
                    lowest, bound(quantity.range.highest));
    EXPECT_THAT(page, testing::HasSubstr(row));
  }
}

TEST(Score, IsASumOfWeightedTermsAndNeverNegative) {
  Settings settings;
  settings.terms = {{"distance", 2.0}, {"uprightness", 4.0}, {"forward", -1.0}};
  EXPECT_DOUBLE_EQ(Score(settings, 15.0, 100.0).of(walk()), 10.0 + 2.0 - 3.0);
  EXPECT_EQ(with_unit("3.5", settings), "3.5");
  EXPECT_TRUE(Score(settings, 15.0, 100.0).measures().uprightness);
  settings.terms = {{"forward", -1.0}};
  EXPECT_EQ(Score(settings, 15.0, 100.0).of(walk()), 0.0);
}

TEST(Score, OfATrialThatBreaksALimitIsItsShare) {
  Settings settings;
  settings.limits = {{.quantity = "uprightness", .least = 0.5}};
  EXPECT_EQ(Score(settings, 15.0, 100.0).of(walk()), 5.0) << "a limit may be reached";
  settings.limits = {{.quantity = "uprightness", .least = 0.6}};
  EXPECT_EQ(Score(settings, 15.0, 100.0).of(walk()), 0.0);
  settings.breach_factor = 0.5;
  EXPECT_EQ(Score(settings, 15.0, 100.0).of(walk()), 2.5);
  settings.limits = {{.quantity = "economy", .most = 2.0}};
  EXPECT_EQ(Score(settings, 15.0, 100.0).of(walk()), 2.5);
  EXPECT_TRUE(Score(settings, 15.0, 100.0).measures().energy) << "limits are measured, too";
}

TEST(Score, IsNothingWhereTheSimulationBrokeDown) {
  Settings settings;
  settings.terms = {{.quantity = "upright_time"}};
  auto trajectory = walk();
  trajectory.outcome = record::Outcome::diverged;
  EXPECT_EQ(Score(settings, 15.0, 100.0).of(trajectory), 0.0);
}

TEST(Score, IsFiniteForARobotThatDidNothing) {
  for (const Quantity& quantity : quantities()) {
    Settings settings;
    settings.terms = {{.quantity = std::string(quantity.name)}};
    EXPECT_TRUE(std::isfinite(Score(settings, 15.0, 100.0).of({}))) << quantity.name;
  }
}

/// The message of the error; "" if the settings are valid.
std::string error_of(const Settings& settings) {
  try {
    settings.validate();
  } catch (const UserError& error) {
    return error.what();
  }
  return "";
}

TEST(ScoreSettings, AreRefusedWhereTheyNameNothingOrCannotBeKept) {
  EXPECT_EQ(error_of({}), "");
  EXPECT_EQ(error_of({.terms = {}}), "score.terms: expected at least one term");
  EXPECT_THAT(
      error_of({.terms = {{.quantity = "joy"}}}),
      testing::StartsWith(
          "score.terms: quantity \"joy\": expected distance, forward, heading, sideways, turn, "
          "speed_kept, energy, economy, uprightness, upright_time, duty_factor, phase, height, root_forward, "
          "effort, constant, yaw_rate, own_speed, speed_error, turn_error, heading_error, tracking"));
  EXPECT_THAT(error_of({.limits = {{.quantity = "joy"}}}), testing::HasSubstr("score.limits: quantity"));
  EXPECT_EQ(error_of({.limits = {{.quantity = "uprightness", .least = 0.9, .most = 0.5}}}),
            "score.limits: uprightness: least = 0.9 is above most = 0.5");
}

TEST(ScoreSettings, AreTheDistanceOnlyWithoutLimitsAndWithThatTermAlone) {
  EXPECT_TRUE((Settings{.terms = {{"distance", 1.0}}}).is_distance());
  EXPECT_FALSE((Settings{.terms = {{"distance", 2.0}}}).is_distance());
  EXPECT_FALSE((Settings{.terms = {{"forward", 1.0}}}).is_distance());
  EXPECT_FALSE((Settings{.terms = {{"distance", 1.0}, {"forward", 1.0}}}).is_distance());
  EXPECT_FALSE((Settings{.terms = {{"distance", 1.0}}, .limits = {{.quantity = "forward"}}}).is_distance());
  EXPECT_FALSE((Settings{.terms = {}}).is_distance());
}

TEST(ScoreSettings, TakeALimitOfOneValueAndKeepATrialThatReachesEitherEnd) {
  Settings settings{.limits = {{.quantity = "uprightness", .least = 0.5, .most = 0.5}}};
  EXPECT_EQ(error_of(settings), "");
  EXPECT_EQ(Score(settings, 15.0, 100.0).of(walk()), 5.0);
  settings.limits[0].least = settings.limits[0].most = 0.51;
  EXPECT_EQ(Score(settings, 15.0, 100.0).of(walk()), 0.0);
  settings.limits[0].least = settings.limits[0].most = 0.49;
  EXPECT_EQ(Score(settings, 15.0, 100.0).of(walk()), 0.0);
  settings.breach_factor = 0.5;
  settings.limits = {{.quantity = "uprightness", .least = 0.6}, {.quantity = "economy", .most = 2.0}};
  EXPECT_EQ(Score(settings, 15.0, 100.0).of(walk()), 1.25) << "once for each limit";
}

TEST(ScoreSettings, HaveAUnitWhereAllTermsHaveIt) {
  Settings settings{.terms = {{"distance", 2.0}, {"forward", 1.0}}};
  EXPECT_EQ(with_unit("3", settings), "3 m");
  settings.terms[0].quantity = "energy";
  EXPECT_EQ(with_unit("3", settings), "3");
}

}  // namespace
}  // namespace amble::score
