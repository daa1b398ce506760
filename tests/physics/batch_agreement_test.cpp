#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "amble/core/error.hpp"
#include "amble/core/index.hpp"
#include "amble/core/random.hpp"
#include "tests/physics/ode_rig.hpp"

namespace amble::physics {
namespace {

using robot::RobotSpec;

/// Without motors, weight or stops in reach, and with joints that ODE keeps together.
RobotSpec passive(RobotSpec robot) {
  robot = weightless(std::move(robot));
  robot.contact.cfm_s_per_kg = 1e-10;
  for (robot::Joint& joint : robot.joints) {
    joint.servo = {.mode = robot::ServoMode::torque, .max_torque_nm = 0.0};
    joint.lower_rad = -3.0;
    joint.upper_rad = 3.0;
  }
  return robot;
}

/// A torso with two legs of six hinges each, about all kinds of axes.
RobotSpec biped() {
  RobotSpec robot = quadruped("paper");
  RobotSpec result = robot;
  result.bodies.resize(1);
  result.geoms.clear();
  result.joints.clear();
  result.legs.clear();
  result.joint_types = {"a", "b", "c", "d", "e", "f"};
  const std::vector<Vec3> axes{{0, 0, 1}, {1, 0, 0}, {0, -1, 0}, {0, 0.6, 0.8}, {0, 1, 0}, {-1, 0, 0}};
  for (int leg = 0; leg < 2; ++leg) {
    for (int j = 0; j < 6; ++j) {
      robot::Body body = robot.bodies[2];
      body.parent = j == 0 ? 0 : static_cast<int>(result.bodies.size()) - 1;
      body.position_m = j == 0 ? Vec3{0.05, leg == 0 ? 0.2 : -0.2, -0.1} : Vec3{0.01, 0.02, -0.1};
      body.rotation = axis_angle({0.0, 0.0, 1.0}, 0.3 * j);
      body.com_m = {0.01, -0.01, -0.05};
      body.mass_kg = 0.3 + 0.05 * j;
      body.inertia_kg_m2 = {0.004, 0.005, 0.003};
      body.inertia_rotation = axis_angle({0.6, 0.0, 0.8}, 0.4);
      result.bodies.push_back(body);
      result.joints.push_back({.name = "j",
                               .body = static_cast<int>(result.bodies.size()) - 1,
                               .chain_index = 0,
                               .anchor_m = {0.0, 0.01, 0.0},
                               .axis = axes[static_cast<std::size_t>(j)],
                               .lower_rad = -3.0,
                               .upper_rad = 3.0,
                               .servo = {}});
    }
  }
  return result;
}

FullState thrown(const RobotSpec& robot, std::uint64_t seed) {
  Stream stream(seed, Purpose::test);
  const auto around = [&](double most) { return stream.uniform(-most, most); };
  FullState state{{robot.bodies[0].position_m, axis_angle({0.6, 0.0, 0.8}, around(1.0))}, {}, {}, {}, {}};
  state.root_velocity_m_s = {around(1.0), around(1.0), around(1.0)};
  state.root_angular_velocity_rad_s = {around(2.0), around(2.0), around(2.0)};
  for (std::size_t j = 0; j < robot.joints.size(); ++j) {
    state.angle_rad.push_back(around(0.5));
    state.speed_rad_s.push_back(around(2.0));
  }
  return state;
}

/// Largest difference of a joint's angle between the engines after 0.4 s of free flight.
double flight_difference(const RobotSpec& robot, double h) {
  const auto engine = make_batch_engine(robot, {.timestep_s = h});
  const FullState start = thrown(robot, 3);
  engine->place(0);
  engine->set_state(0, robot_state(robot, start));
  OdeRig rig(robot);
  rig.set(body_motions(robot, start));
  const LaneArray none(static_cast<int>(robot.joints.size()), engine->lanes());
  const LaneArray none_of_one(none.rows(), 1);
  for (int n = 0; n < static_cast<int>(std::lround(0.4 / h)); ++n) {
    engine->step(none);
    rig.step(none_of_one, h, 0);
  }
  double largest = 0.0;
  for (int j = 0; j < none.rows(); ++j)
    largest = std::max(
        largest, std::abs(rig.angle(j) - static_cast<double>(engine->sensors().joint_angle_rad.at(j, 0))));
  return largest;
}

TEST(BatchAgreement, FreeFlightConvergesToOdeAtFirstOrder) {
  for (const RobotSpec& robot :
       {passive(quadruped("paper")), passive(quadruped("authors")), passive(biped())}) {
    const double coarse = flight_difference(robot, 1e-2), middle = flight_difference(robot, 1e-3),
                 fine = flight_difference(robot, 1e-4);
    RecordProperty(robot.name,
                   std::to_string(coarse) + " " + std::to_string(middle) + " " + std::to_string(fine));
    EXPECT_LT(coarse, 0.1);
    EXPECT_LT(middle, 0.2 * coarse) << coarse << " " << middle;
    EXPECT_LT(fine, 0.2 * middle) << middle << " " << fine;
  }
}

TEST(BatchAgreement, EnergyInFlightIsKeptTheBetterTheShorterTheStep) {
  const RobotSpec robot = passive(quadruped("paper"));
  const auto drift = [&](double h) {
    const auto engine = make_batch_engine(robot, {.timestep_s = h});
    const FullState start = thrown(robot, 5);
    engine->place(0);
    engine->set_state(0, robot_state(robot, start));
    const LaneArray none(12, engine->lanes());
    for (int n = 0; n < static_cast<int>(std::lround(0.4 / h)); ++n) engine->step(none);
    const FullState end = full_state(robot, engine->root_pose(0), engine->state(0));
    return kinetic_energy(robot, body_motions(robot, end)) /
               kinetic_energy(robot, body_motions(robot, start)) -
           1.0;
  };
  const double coarse = std::abs(drift(1e-2)), fine = std::abs(drift(1e-3));
  EXPECT_LT(coarse, 0.1);
  EXPECT_LT(fine, 0.2 * coarse);
}

TEST(BatchAgreement, BothMomentaAreKeptInFlightWhateverTheMotorsDo) {
  const RobotSpec robot = weightless(quadruped("paper"));
  const auto engine = make_batch_engine(robot, {});
  engine->place(0);
  FullState start = thrown(robot, 9);
  start.angle_rad.assign(12, 0.0);
  engine->set_state(0, robot_state(robot, start));
  const RobotState before = engine->state(0);
  LaneArray targets(12, engine->lanes());
  Stream stream(8, Purpose::test);
  for (int n = 0; n < 300; ++n) {
    if (n % 20 == 0)
      for (int j = 0; j < 12; ++j) targets.at(j, 0) = static_cast<float>(stream.uniform(-0.8, 0.8));
    engine->step(targets);
  }
  const RobotState after = engine->state(0);
  EXPECT_EQ(after.velocity_m_s, before.velocity_m_s);
  EXPECT_EQ(after.angular_momentum_kg_m2_s, before.angular_momentum_kg_m2_s);
  EXPECT_NEAR(norm(after.com_m - (before.com_m + 3.0 * before.velocity_m_s)), 0.0, 1e-5);
}

/// Steps of robots that stumble about, each compared with one step of ODE from the same state.
struct Comparison {
  std::vector<double> differences_m_s;
  int contacts = 0, equal_counts = 0;
};

Comparison compare(const RobotSpec& robot, int iterations) {
  const auto engine = make_batch_engine(robot, {});
  OdeRig rig(robot);
  Stream stream(21, Purpose::test);
  const int joints = static_cast<int>(robot.joints.size());
  LaneArray targets(joints, engine->lanes()), own(joints, 1);
  for (int lane = 0; lane < engine->lanes(); ++lane) engine->place(lane);
  Comparison result;
  for (int n = 0; n < 150; ++n) {
    if (n % 25 == 0) {
      for (int lane = 0; lane < engine->lanes(); ++lane)
        for (int j = 0; j < joints; ++j) targets.at(j, lane) = static_cast<float>(stream.uniform(-0.8, 0.8));
    }
    const int lane = n % engine->lanes();
    const FullState before = full_state(robot, engine->root_pose(lane), engine->state(lane));
    engine->step(targets);
    if (!engine->healthy(lane)) continue;
    for (int j = 0; j < joints; ++j) own.at(j, 0) = targets.at(j, lane);
    rig.set(body_motions(robot, before));
    rig.step(own, 0.01, iterations);
    const FullState after = full_state(robot, engine->root_pose(lane), engine->state(lane));
    const FullState expected = nearest(robot, rig.pose(), rig.motions());
    result.differences_m_s.push_back(
        norm(body_motions(robot, after)[0].velocity_m_s - body_motions(robot, expected)[0].velocity_m_s));
    result.contacts += rig.contacts();
    result.equal_counts += rig.contacts() == engine->contacts(lane) ? 1 : 0;
  }
  std::ranges::sort(result.differences_m_s);
  return result;
}

/// With a tail of two joints behind, which touches nothing: so not all limbs have three joints.
RobotSpec tailed(RobotSpec robot, double mass_kg, double max_torque_nm) {
  for (int j = 0; j < 2; ++j) {
    robot::Body body;
    body.parent = j == 0 ? 0 : static_cast<int>(robot.bodies.size()) - 1;
    body.position_m = j == 0 ? Vec3{-0.1, 0.02, 0.05} : Vec3{-0.1, 0.0, 0.0};
    body.com_m = {-0.05, 0.0, 0.0};
    body.mass_kg = mass_kg;
    body.inertia_kg_m2 = mass_kg * Vec3{0.001, 0.001, 0.001};
    robot::Joint joint;
    joint.body = static_cast<int>(robot.bodies.size());
    joint.axis = j == 0 ? Vec3{0.0, 0.0, 1.0} : Vec3{0.0, 1.0, 0.0};
    joint.lower_rad = -3.0;
    joint.upper_rad = 3.0;
    joint.servo = robot.joints[0].servo;
    joint.servo.max_torque_nm = max_torque_nm;
    robot.bodies.push_back(body);
    robot.joints.push_back(joint);
  }
  return robot;
}

TEST(BatchAgreement, LimbsHaveUpToTwentyFourJoints) {
  const auto with_tail_of = [](int pairs) {
    RobotSpec robot = quadruped("paper");
    for (int pair = 0; pair < pairs; ++pair) {
      robot = tailed(std::move(robot), 0.05, 1.0);
      if (pair > 0) robot.bodies[robot.bodies.size() - 2].parent = static_cast<int>(robot.bodies.size()) - 3;
    }
    return robot;
  };
  const auto engine = make_batch_engine(with_tail_of(12), {});
  engine->place(0);
  const LaneArray targets(36, engine->lanes());
  for (int n = 0; n < 50; ++n) engine->step(targets);
  EXPECT_TRUE(engine->healthy(0));
  try {
    make_batch_engine(with_tail_of(13), {});
    ADD_FAILURE() << "a tail of 26 joints was accepted";
  } catch (const UserError& error) {
    EXPECT_NE(std::string(error.what()).find("more than 24 joints in one chain"), std::string::npos)
        << error.what();
  }
}

TEST(BatchAgreement, ATailOfNoWeightChangesNothingForTheLegs) {
  // Robots whose limbs all have three joints have code of their own; the tail leads to the general one.
  // Rounding differs; later on it makes a foot touch a step earlier, and the walks part.
  for (const char* variant : {"paper", "authors"}) {
    const RobotSpec robot = quadruped(variant);
    const auto plain = make_batch_engine(robot, {}),
               general = make_batch_engine(tailed(robot, 1e-7, 0.0), {});
    LaneArray targets(12, plain->lanes()), more(14, plain->lanes());
    Stream stream(23, Purpose::test);
    for (int lane = 0; lane < plain->lanes(); ++lane) {
      plain->place(lane);
      general->place(lane);
    }
    double largest_m = 0.0, farthest_m = 0.0;
    for (int n = 0; n < 30; ++n) {
      for (int lane = 0; n % 15 == 0 && lane < plain->lanes(); ++lane)
        for (int j = 0; j < 12; ++j)
          targets.at(j, lane) = more.at(j, lane) = static_cast<float>(stream.uniform(-0.8, 0.8));
      plain->step(targets);
      general->step(more);
      for (int lane = 0; lane < plain->lanes(); ++lane) {
        largest_m = std::max(largest_m, norm(plain->com_m(lane) - general->com_m(lane)));
        farthest_m = std::max(farthest_m, norm(plain->com_m(lane) - plain->com_m(0)));
      }
    }
    EXPECT_GT(farthest_m, 0.05) << "each lane goes its own way";
    EXPECT_LT(largest_m, 1e-5) << variant;
    RecordProperty(std::string("largest_") + variant, std::to_string(largest_m));
  }
}

/// With a second sphere beside each foot's, so that legs touch the ground in two places at once.
RobotSpec with_toes(RobotSpec robot) {
  std::vector<robot::Geom> toes;
  for (const robot::Leg& leg : robot.legs) {
    toes.push_back(robot.geoms[to_index(leg.foot_geoms[0])]);
    toes.back().name += " toe";
    toes.back().position_m.x += 0.12;
  }
  robot.geoms.insert(robot.geoms.end(), toes.begin(), toes.end());
  robot.name += ", with toes";
  return robot;
}

TEST(BatchAgreement, OneStepFromTheSameStateIsThatOfQuickStepConverged) {
  for (const RobotSpec& robot : {quadruped("paper"), quadruped("authors"), with_toes(quadruped("paper")),
                                 tailed(quadruped("paper"), 0.2, 1.0)}) {
    const std::string variant = robot.name + (robot.joints.size() > 12 ? ", tailed" : "");
    const Comparison result = compare(robot, 5000);
    const std::size_t count = result.differences_m_s.size();
    const double median = result.differences_m_s[count / 2];
    RecordProperty("median_" + variant, std::to_string(median));
    EXPECT_GE(count, 140u);
    EXPECT_GT(result.contacts, 200);
    EXPECT_EQ(result.equal_counts, static_cast<int>(count));
    EXPECT_LT(median, 0.005) << variant << ", 9 in 10 below " << result.differences_m_s[count * 9 / 10];
  }
}

}  // namespace
}  // namespace amble::physics
