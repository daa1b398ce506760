#include "amble/controllers/supg_contact.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "amble/controllers/supg.hpp"
#include "amble/core/error.hpp"
#include "tests/controllers/supg_substrate.hpp"

namespace amble::controllers {
namespace supg_contact_test {

constexpr double timestep_s = 0.01;
constexpr int legs = 4, joints = 12;

robot::SensorFrame frame() {
  return {.joint_angle_rad = LaneArray(joints, 1),
          .touch = LaneArray(legs, 1),
          .attitude_rad = LaneArray(3, 1),
          .joint_torque_nm = LaneArray(joints, 1)};
}

ContactEstimate estimate(const ContactSettings& settings) {
  ContactEstimate contact(settings, contact_joints(settings, quadruped()), timestep_s, 1);
  contact.load(0);
  return contact;
}

TEST(SupgContact, ByTorqueBeginsAboveTheThresholdAndEndsAtTheRelease) {
  ContactEstimate contact =
      estimate({.source = ContactSource::torque, .joint_type = "knee", .threshold = 2.0, .release = 0.5});
  auto sensors = frame();
  sensors.joint_torque_nm.at(1, 0) = 9.0f;  // the hip says nothing
  const std::vector<std::pair<float, float>> steps{{0.0f, 0.0f}, {2.0f, 0.0f}, {-2.1f, 1.0f}, {1.1f, 1.0f},
                                                   {1.0f, 0.0f}, {1.9f, 0.0f}, {2.1f, 1.0f},  {0.0f, 0.0f}};
  for (const auto& [torque, expected] : steps) {
    sensors.joint_torque_nm.at(0, 0) = torque;
    contact.update(sensors);
    EXPECT_EQ(contact.row(0)[0], expected) << torque;
    EXPECT_EQ(contact.row(1)[0], 0.0f);
  }
}

TEST(SupgContact, ByTrackingComparesWithTheLastTarget) {
  ContactEstimate contact = estimate({.source = ContactSource::tracking, .joint_type = {}, .threshold = 0.1});
  auto sensors = frame();
  LaneArray targets(joints, 1);
  targets.at(5, 0) = 0.3f;  // a joint of leg 1
  contact.update(sensors);
  EXPECT_EQ(contact.row(1)[0], 0.0f);  // before there is a target nothing is behind it
  contact.targets(targets);
  contact.update(sensors);
  EXPECT_EQ(contact.row(1)[0], 1.0f);
  EXPECT_EQ(contact.row(0)[0], 0.0f);
  sensors.joint_angle_rad.at(5, 0) = 0.26f;
  contact.update(sensors);
  EXPECT_EQ(contact.row(1)[0], 0.0f);
}

TEST(SupgContact, AShockIsOfTheLegWithoutAContactForLongest) {
  ContactEstimate contact = estimate({.source = ContactSource::shock, .joint_type = {}, .threshold = 10.0});
  auto sensors = frame();
  std::vector<int> order;
  for (int tick = 0; tick < 60; ++tick) {
    // The roll turns steadily but for a kick of 0.01 rad in every tenth tick: 100 rad/s², thrice over.
    sensors.attitude_rad.at(0, 0) = 0.001f * static_cast<float>(tick) + (tick % 10 == 9 ? 0.01f : 0.0f);
    contact.update(sensors);
    int sum = 0;
    for (int leg = 0; leg < legs; ++leg)
      if (contact.row(leg)[0] > 0.5f) {
        ++sum;
        order.push_back(leg);
      }
    EXPECT_EQ(sum, tick >= 9 && (tick % 10 == 9 || tick % 10 <= 1) ? 1 : 0) << tick;
  }
  for (std::size_t i = 0; i < order.size(); ++i) EXPECT_EQ(order[i], static_cast<int>(i % 4)) << i;
}

TEST(SupgContact, RefusesAJointTypeThatTheRobotLacks) {
  try {
    contact_joints({.source = ContactSource::torque, .joint_type = "elbow"}, quadruped());
    FAIL() << "accepted";
  } catch (const SettingError& error) {
    EXPECT_STREQ(
        error.what(),
        "controller.supg.contact.joint_type = \"elbow\": the robot has no joint type elbow; expected knee, "
        "hip_fb, hip_io");
  }
}

TEST(SupgContact, RefusesThresholdsThatEveryTickOrNoneExceeds) {
  const auto refusal = [](const ContactSettings& settings) -> std::string {
    try {
      contact_joints(settings, quadruped());
    } catch (const SettingError& error) {
      return error.what();
    }
    return "none";
  };
  const double most_nm = quadruped().joints[0].servo.max_torque_nm;
  EXPECT_EQ(refusal({.source = ContactSource::torque, .joint_type = {}, .threshold = 0.99 * most_nm}),
            "none");
  EXPECT_NE(refusal({.source = ContactSource::torque, .joint_type = {}, .threshold = most_nm})
                .find("no motor of a leg gives more"),
            std::string::npos);
  EXPECT_NE(refusal({.source = ContactSource::shock, .joint_type = {}, .threshold = 0.0})
                .find("every tick would be a contact"),
            std::string::npos);
  EXPECT_EQ(refusal({.source = ContactSource::touch, .joint_type = {}, .threshold = 0.0}), "none");
}

TEST(SupgContact, TriggersALegAsATouchWould) {
  SupgSettings settings;
  settings.contact = {.source = ContactSource::torque, .joint_type = "knee", .threshold = 1.0};
  const SupgArchitecture by_torque(settings, supg_substrate(), quadruped(), timestep_s);
  EXPECT_TRUE(by_torque.extra_senses().torque);
  settings.contact = {};
  const SupgArchitecture by_touch(settings, supg_substrate(), quadruped(), timestep_s);
  EXPECT_FALSE(by_touch.extra_senses().any());
  const auto estimated = by_torque.make_batch(1), touched = by_touch.make_batch(1);
  auto sensors = frame(), feet = frame();
  LaneArray targets(joints, 1);
  std::vector<float> one(2 * legs), other(2 * legs);
  for (int tick = 0; tick < 300; ++tick) {
    for (int leg = 0; leg < legs; ++leg) {
      const bool down = (tick / (20 + leg)) % 2 == 1;
      sensors.joint_torque_nm.at(3 * leg, 0) = down ? -1.5f : 0.2f;
      feet.touch.at(leg, 0) = down ? 1.0f : 0.0f;
    }
    estimated->step(sensors, targets);
    touched->step(feet, targets);
    estimated->state(0, one);
    touched->state(0, other);
    ASSERT_EQ(one, other) << tick;
  }
}

}  // namespace supg_contact_test
}  // namespace amble::controllers
