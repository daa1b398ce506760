#include "amble/substrate/sensor.hpp"

#include <gtest/gtest.h>

namespace amble::substrate {
namespace {

using Kind = Sensor::Kind;

TEST(Sensor, AsksForWhatFramesHaveOnlyIfAsked) {
  for (const Kind kind : {Kind::angle, Kind::touch, Kind::roll, Kind::pitch, Kind::yaw, Kind::sine})
    EXPECT_EQ(extra_senses({kind, 0}), robot::ExtraSenses{});
  EXPECT_EQ(extra_senses({Kind::speed, 0}), (robot::ExtraSenses{.speed = true}));
  EXPECT_EQ(extra_senses({Kind::torque, 0}), (robot::ExtraSenses{.torque = true}));
  EXPECT_EQ(extra_senses({Kind::yaw_rate, 0}), (robot::ExtraSenses{.yaw_rate = true}));
  EXPECT_EQ(extra_senses({Kind::load, 0}), (robot::ExtraSenses{.load = true}));
  for (const Kind kind : {Kind::command_speed, Kind::command_turn, Kind::command_stop})
    EXPECT_EQ(extra_senses({kind, 0}), (robot::ExtraSenses{.command = true}));
  EXPECT_EQ(extra_senses({Kind::heading_error, 0}), (robot::ExtraSenses{.heading_error = true}));
}

TEST(Sensor, SharesItsRowsWithItselfAndRollWithYaw) {
  const Sensor roll{Kind::roll, 0}, pitch{Kind::pitch, 0}, yaw{Kind::yaw, 0};
  for (const Sensor& sensor : {roll, pitch, yaw}) EXPECT_TRUE(shares_rows(sensor, sensor));
  EXPECT_TRUE(shares_rows(roll, yaw) && shares_rows(yaw, roll));
  for (const Sensor& sensor : {roll, yaw})
    EXPECT_FALSE(shares_rows(sensor, pitch) || shares_rows(pitch, sensor));
  EXPECT_FALSE(shares_rows({Kind::angle, 0}, {Kind::angle, 1}));
  EXPECT_FALSE(shares_rows({Kind::angle, 0}, {Kind::touch, 0}));
}

TEST(Sensor, ReadsItsRowWhereTheFrameHasIt) {
  robot::SensorFrame frame;
  frame.joint_angle_rad = LaneArray(2, 1);
  frame.touch = LaneArray(2, 1);
  frame.attitude_rad = LaneArray(3, 1);
  EXPECT_EQ(row_of({Kind::angle, 1}, frame), frame.joint_angle_rad.row(1));
  EXPECT_EQ(row_of({Kind::touch, 1}, frame), frame.touch.row(1));
  EXPECT_EQ(row_of({Kind::pitch, 0}, frame), frame.attitude_rad.row(1));
  EXPECT_EQ(row_of({Kind::yaw, 0}, frame), frame.attitude_rad.row(2));
  for (const Kind kind : {Kind::sine, Kind::speed, Kind::torque, Kind::yaw_rate, Kind::load,
                          Kind::command_turn, Kind::command_stop, Kind::heading_error})
    EXPECT_EQ(row_of({kind, 0}, frame), nullptr);
}

}  // namespace
}  // namespace amble::substrate
