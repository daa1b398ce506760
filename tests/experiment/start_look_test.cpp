#include "amble/experiment/start_look.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <numbers>

#include "amble/experiment/plan/generation_row.hpp"
#include "amble/experiment/problem.hpp"
#include "amble/robot/check.hpp"
#include "tests/experiment/fixture.hpp"

namespace amble::experiment {
namespace {

using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

robot::RobotSpec own_robot(const std::string& name) {
  return load_robot_file(AMBLE_SOURCE_DIR "/robots/" + name + ".toml");
}

class EachEngine : public testing::TestWithParam<const char*> {
 protected:
  std::vector<std::string> odd(const robot::RobotSpec& robot) const {
    return odd_at_start(robot, GetParam(), 0.01);
  }
};
INSTANTIATE_TEST_SUITE_P(StartLook, EachEngine, testing::Values("ode", "batch", "mujoco"));

TEST_P(EachEngine, FindsNothingOddAboutRobotsThatStand) {
  for (const char* name : {"quadruped/authors", "quadruped/paper", "hexapod/hexapod", "octopod/octopod"})
    EXPECT_THAT(odd(own_robot(name)), IsEmpty()) << name;
}

TEST_P(EachEngine, SaysOfARobotThatLiesOnWhatAndOfOneThatCrouches) {
  auto robot = own_robot("quadruped/authors");
  // A belly that reaches below the feet, or nearly.
  robot::Geom belly;
  belly.name = "belly";
  belly.size_m = {0.05, 0.0, 0.0};
  const double torso_m = robot.bodies[0].position_m.z;
  belly.position_m = {0.0, 0.0, 0.04 - torso_m};
  robot.geoms.push_back(belly);
  EXPECT_THAT(odd(robot), Contains(HasSubstr("it lies: '" + robot.bodies[0].name + "'")));
  robot.geoms.back().position_m.z += 0.03;
  EXPECT_THAT(odd(robot), Contains(HasSubstr("it crouches")));
}

TEST_P(EachEngine, SaysOfARobotThatFallsWhen) {
  auto robot = own_robot("quadruped/authors");
  robot.fall_height_m = 0.99 * robot.bodies[0].position_m.z;
  robot.bodies[0].position_m.z += 0.3;  // it drops
  EXPECT_THAT(odd(robot), Contains(testing::ContainsRegex("it falls within 0\\.[0-9]+ s")));
  robot.fall_height_m = 10.0;
  EXPECT_THAT(odd(robot), Contains(HasSubstr("it has fallen before its first step")));
}

TEST_P(EachEngine, SaysOfARobotWithWeakServosThatItSinks) {
  auto robot = own_robot("hexapod/hexapod");  // its legs spread
  for (auto& joint : robot.joints) joint.servo.max_torque_nm = 1e-6;
  robot.fall_height_m = -10.0;
  EXPECT_THAT(odd(robot), Contains(HasSubstr("it sinks by")));
}

TEST_P(EachEngine, SaysWhereLegsPointThatPointAside) {
  auto robot = own_robot("quadruped/authors");
  const double quarter = std::numbers::sqrt2 / 2.0;
  robot.bodies[0].rotation =
      Quat{quarter, quarter, 0.0, 0.0} * robot.bodies[0].rotation;  // about x: -z to +y
  robot.fall_height_m = -10.0;
  EXPECT_THAT(odd(robot), Contains(HasSubstr("legs: they point along +y, not down")));
}

TEST(StartLook, SaysWhichUnitLengthsSeemToHave) {
  const auto scaled = [](double by) {
    auto robot = own_robot("quadruped/authors");
    std::erase_if(robot.geoms, [](const robot::Geom& geom) { return !geom.collides; });
    for (auto& geom : robot.geoms) geom.size_m = by * geom.size_m;
    for (auto& body : robot.bodies) body.mass_kg *= 40.0;  // nearly as heavy as water
    std::vector<std::string> mass;
    for (const auto& line : odd_at_start(robot, "batch", 0.01))
      if (line.starts_with("mass:")) mass.push_back(line);
    return mass;
  };
  EXPECT_THAT(scaled(1.0), IsEmpty());
  EXPECT_THAT(scaled(10.0), ElementsAre(HasSubstr("decimetres")));
  EXPECT_THAT(scaled(100.0), ElementsAre(HasSubstr("centimetres")));
  EXPECT_THAT(scaled(1000.0), ElementsAre(HasSubstr("millimetres")));
  EXPECT_THAT(scaled(0.01), IsEmpty()) << "feet alone may collide";
  auto grams = own_robot("quadruped/authors");
  for (auto& body : grams.bodies) body.mass_kg *= 1e5;
  EXPECT_THAT(odd_at_start(grams, "batch", 0.01), Contains(HasSubstr("are its masses in grams?")));
}

TEST(StartLook, DoubtsARobotThatIsTooLargeWhateverItWeighs) {
  const auto scaled = [](double by, double mass_by) {
    auto robot = own_robot("quadruped/authors");
    for (auto& geom : robot.geoms) {
      geom.size_m = by * geom.size_m;
      geom.position_m = by * geom.position_m;
    }
    for (auto& body : robot.bodies) {
      body.position_m = by * body.position_m;
      body.mass_kg *= mass_by;
    }
    robot.fall_height_m = -1e9;
    std::vector<std::string> lines;
    for (const auto& line : odd_at_start(robot, "batch", 0.01))
      if (line.starts_with("size:") || line.starts_with("mass:")) lines.push_back(line);
    return lines;
  };
  EXPECT_THAT(scaled(1.0, 1.0), IsEmpty());
  // As heavy as its shapes: nothing is lighter than foam.
  EXPECT_THAT(scaled(100.0, 1e6), ElementsAre(testing::AllOf(HasSubstr("size:"), HasSubstr("centimetres"))));
  EXPECT_THAT(scaled(1000.0, 1e9), ElementsAre(testing::AllOf(HasSubstr("size:"), HasSubstr("millimetres"))));
  EXPECT_THAT(scaled(1000.0, 1.0), ElementsAre(HasSubstr("mass:"))) << "said once";
}

TEST(StartLook, SaysWhichCentresOfMassAreFarFromTheirLink) {
  const auto lines_of = [](double com_m) {
    auto robot = own_robot("quadruped/authors");
    robot.bodies[1].com_m = {0.0, 0.0, com_m};
    return odd_at_start(robot, "batch", 0.01);
  };
  EXPECT_THAT(lines_of(-0.3), IsEmpty());
  const auto far = lines_of(-300.0);
  EXPECT_THAT(far, Contains(testing::AllOf(HasSubstr("mass: centres of mass"), HasSubstr("millimetres"),
                                           HasSubstr(own_robot("quadruped/authors").bodies[1].name + " ("))));
  // Its centre of mass is below the ground: shares of that height say nothing.
  EXPECT_THAT(far, testing::Not(Contains(HasSubstr("thrown up"))));
  EXPECT_THAT(far, testing::Not(Contains(HasSubstr("sinks"))));
}

TEST(StartLook, MeasuresMeshesAsItMeasuresBoxes) {
  const auto mass_of = [](robot::Shape shape, double half_m) {
    auto robot = own_robot("quadruped/authors");
    for (auto& geom : robot.geoms) geom.collides = false;
    robot::Geom& trunk = robot.geoms[0];
    trunk = {};
    trunk.shape = shape;
    trunk.size_m = {half_m, half_m, half_m};
    trunk.position_m.z = 100.0;
    if (shape == robot::Shape::mesh) {
      for (const double x : {-half_m, half_m})
        for (const double y : {-half_m, half_m})
          for (const double z : {-half_m, half_m}) trunk.vertices_m.push_back({x, y, z});
      trunk.size_m = {2.0 * half_m, 0.0, 0.0};
      trunk.triangles = {{0, 1, 3}, {0, 3, 2}, {4, 6, 7}, {4, 7, 5}, {0, 4, 5}, {0, 5, 1},
                         {2, 3, 7}, {2, 7, 6}, {0, 2, 6}, {0, 6, 4}, {1, 5, 7}, {1, 7, 3}};
    }
    for (auto& leg : robot.legs) robot.geoms[static_cast<std::size_t>(leg.foot_geoms[0])].collides = true;
    for (const auto& line : odd_at_start(robot, "ode", 0.01))
      if (line.starts_with("mass:")) return line;
    return std::string();
  };
  for (const double half_m : {0.1, 3.0, 30.0, 300.0}) {
    const std::string box = mass_of(robot::Shape::box, half_m), mesh = mass_of(robot::Shape::mesh, half_m);
    EXPECT_EQ(box.substr(box.find("kg/m3") + 1), mesh.substr(mesh.find("kg/m3") + 1)) << half_m;
    EXPECT_EQ(box.empty(), half_m < 1.0) << half_m;
  }
}

TEST(StartLook, SaysThatAHeldRobotDiverges) {
  auto robot = own_robot("quadruped/authors");
  robot.gravity_m_s2.z = -1e6;
  robot.fall_height_m = -1e9;
  EXPECT_THAT(odd_at_start(robot, "batch", 0.01), Contains(HasSubstr("it diverges after")));
}

TEST(StartLook, SaysThatGravityIsTiltedAndWhereTo) {
  auto robot = own_robot("quadruped/authors");
  const auto says = [&](Vec3 gravity_m_s2, const std::string& words) {
    robot.gravity_m_s2 = gravity_m_s2;
    return testing::Matches(Contains(HasSubstr(words)))(odd_at_start(robot, "batch", 0.01));
  };
  EXPECT_TRUE(says({1, 0, -9.7}, "is tilted by 5.9 degrees: it pulls along +x"));
  EXPECT_TRUE(says({0, -0.5, -9.8}, "is tilted by 2.9 degrees: it pulls along -y"));
  EXPECT_FALSE(says({0.01, 0, -9.81}, "tilted"));
  EXPECT_FALSE(says({0, 0, -9.81}, "tilted"));
  EXPECT_FALSE(says({0, 0, 9.81}, "tilted")) << "that is told otherwise";
}

// A run on a model of another world would "walk" by falling.
TEST(Gravity, ThatDoesNotPointDownIsRefusedByEveryRunWithWhatToDo) {
  const auto refusal = [](Vec3 gravity_m_s2) {
    auto robot = own_robot("quadruped/authors");
    robot.gravity_m_s2 = gravity_m_s2;
    try {
      Problem::make(small_config(), robot);
    } catch (const UserError& error) {
      EXPECT_EQ(error.code(), ExitCode::bad_input);
      EXPECT_EQ(error.what(), "robot '" + robot.name + "': " + robot::gravity_fault(gravity_m_s2));
      return std::string(error.what());
    }
    return std::string();
  };
  for (const Vec3 fine : {Vec3{0, 0, -9.81}, Vec3{0, 0, -1.62}, Vec3{3, 0, -9}, Vec3{-2, 2, -9}})
    EXPECT_EQ(refusal(fine), "");
  EXPECT_THAT(refusal({0, -9.81, 0}), HasSubstr("has +y up"));
  EXPECT_THAT(refusal({0, -9.81, 0}), HasSubstr("turned by 90 degrees about x"));
  EXPECT_THAT(refusal({0, 9.81, 0}), HasSubstr("turned by -90 degrees about x"));
  EXPECT_THAT(refusal({-9.81, 0, 0}), HasSubstr("has +x up"));
  EXPECT_THAT(refusal({-9.81, 0, 0}), HasSubstr("turned by -90 degrees about y"));
  EXPECT_THAT(refusal({9.81, 0, 0}), HasSubstr("turned by 90 degrees about y"));
  EXPECT_THAT(refusal({0, 0, 0}), HasSubstr("nothing walks without"));
  EXPECT_THAT(refusal({0, 0, 9.81}), HasSubstr("it points up"));
  EXPECT_THAT(refusal({0, -7, -7}), HasSubstr("has +y up"));
}

TEST(TrialTally, HasAVerdictWhereHardlyAnyTrialIsOne) {
  const auto verdict = [](int walked, int diverged, int fell_at_once, int fell_later) {
    TrialTally tally;
    const auto add = [&](int count, record::Outcome outcome, int steps) {
      record::Trajectory trajectory;
      trajectory.outcome = outcome;
      trajectory.steps = steps;
      tally.add(std::vector<record::Trajectory>(static_cast<std::size_t>(count), trajectory), 1000);
    };
    add(walked, record::Outcome::completed, 1000);
    add(diverged, record::Outcome::diverged, 1000);
    add(fell_at_once, record::Outcome::fell, 5);
    add(fell_later, record::Outcome::fell, 50);
    return tally.verdict();
  };
  EXPECT_EQ(verdict(0, 0, 0, 0), "");
  EXPECT_EQ(verdict(100, 0, 0, 0), "");
  EXPECT_EQ(verdict(0, 0, 0, 180), "") << "falling is what learners do";
  EXPECT_EQ(verdict(20, 160, 0, 0), "");
  EXPECT_THAT(verdict(0, 180, 0, 0), HasSubstr("180 of 180 trials diverged, so the results mean nothing"));
  EXPECT_THAT(verdict(10, 90, 0, 0), HasSubstr("90 of 100 trials diverged"));
  EXPECT_THAT(verdict(5, 0, 175, 0), HasSubstr("175 of 180 fell at once"));
  EXPECT_THAT(verdict(1, 60, 60, 0), HasSubstr("60 of 121 trials diverged and 60 of 121 fell at once"));
}

}  // namespace
}  // namespace amble::experiment
