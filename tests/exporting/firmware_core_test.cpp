#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <string>
#include <tuple>
#include <vector>

#include "examples/firmware/calibrate.c"
#include "examples/firmware/commands.c"
#include "examples/firmware/pca9685.c"
#include "examples/firmware/safety.c"
#include "examples/firmware/servos.c"

// The parts of examples/firmware that need no board. tests/exporting/firmware_test.cpp runs all of it.
namespace amble::tests {
namespace {

constexpr servo typical{.pin = 3,
                        .sign = 1,
                        .zero_us = 1500,
                        .least_us = 900,
                        .most_us = 2100,
                        .slew_us_per_s = 4100,
                        .us_per_rad = 637};
constexpr std::int32_t tick_us = 10000;

TEST(FirmwareServos, PulsesAreTheNearestOfAnAngleWithinTheLimits) {
  std::mt19937 random(1);
  for (const int sign : {1, -1})
    for (int i = 0; i < 10000; ++i) {
      servo s = typical;
      s.sign = static_cast<int8_t>(sign);
      const auto angle = static_cast<std::int32_t>(random() % 262144) - 131072;  // ± 4 rad
      const double wanted_us = 1500 + sign * (angle / 32768.0) * 637;
      const int16_t pulse_us = servo_goal_us(&s, angle, 15);
      EXPECT_NEAR(pulse_us, std::clamp(wanted_us, 900.0, 2100.0), 0.5001);
      EXPECT_GE(pulse_us, 900);
      EXPECT_LE(pulse_us, 2100);
    }
}

TEST(FirmwareServos, AreNoFasterThanTheirSlewAndArrive) {
  int16_t pulse_us = 900;
  int ticks = 0;
  for (; pulse_us != 2100 && ticks < 1000; ++ticks) {
    const int16_t next_us = servo_towards_us(&typical, pulse_us, 2100, tick_us);
    EXPECT_LE(next_us - pulse_us, 41);
    EXPECT_GT(next_us, pulse_us);
    pulse_us = next_us;
  }
  EXPECT_EQ(ticks, 30);  // 1200 us at 41 us a tick
  servo slow = typical;
  slow.slew_us_per_s = 1;
  EXPECT_EQ(servo_towards_us(&slow, 1500, 1000, tick_us), 1499);
}

constexpr safety_limits watched{.late_us = 50000,
                                .silent_ticks = 10,
                                .stuck_ticks = 500,
                                .airborne_ticks = 100,
                                .lost_ticks = 10,
                                .slow_us = 100000};

/// A robot of four legs that walks: each call is a tick.
struct Watched {
  safety state;
  safety_inputs in;
  Watched()
      : in{.now_us = 0xffff0000u,
           .stop = 0,
           .answered = 1,
           .pulsed = 1,
           .timed = 1,
           .walks = 1,
           .stands = 0,
           .tilted = 0,
           .legs = 4,
           .touch = {1, 0, 0, 1}} {
    safety_init(&state);
    EXPECT_EQ(state.reason, STOP_POWER_ON);
    EXPECT_EQ(safety_arm(&state, &in), 1);
  }
  stop_reason tick(int ticks = 1, bool steps = true) {
    for (int i = 0; i < ticks; ++i) {
      in.now_us += tick_us;
      if (steps)
        for (uint8_t& touch : in.touch) touch = !touch;
      safety_check(&state, &watched, tick_us, &in);
    }
    return state.reason;
  }
};

TEST(FirmwareSafety, LetsARobotWalkAlsoWhenItsClockGoesRound) {
  Watched robot;
  EXPECT_EQ(robot.tick(100000), STOP_NONE);
}

TEST(FirmwareSafety, StopsStayUntilItIsArmedAgainWithTheSwitchReleased) {
  Watched robot;
  robot.in.stop = 1;
  EXPECT_EQ(robot.tick(), STOP_SWITCH);
  EXPECT_EQ(safety_arm(&robot.state, &robot.in), 0);
  EXPECT_EQ(robot.tick(), STOP_SWITCH);
  robot.in.stop = 0;
  EXPECT_EQ(robot.tick(100), STOP_SWITCH);
  EXPECT_EQ(safety_arm(&robot.state, &robot.in), 1);
  EXPECT_EQ(robot.tick(100), STOP_NONE);
}

TEST(FirmwareSafety, StopsAtATickThatIsTooLate) {
  Watched robot;
  robot.in.now_us += 50000;
  EXPECT_EQ(robot.tick(), STOP_NONE);
  robot.in.now_us += 50001;
  EXPECT_EQ(robot.tick(), STOP_LATE);
  Watched calibrated;
  calibrated.in.timed = 0;
  calibrated.in.now_us += 90000;
  EXPECT_EQ(calibrated.tick(), STOP_NONE);
}

TEST(FirmwareSafety, StopsAtTicksThatAreTooLateAllTogether) {
  for (const auto& [late_us, ticks, reason] : {std::tuple{500, 100000, STOP_NONE},
                                               {2000, 50, STOP_NONE},
                                               {2000, 51, STOP_SLOW},
                                               {49000, 3, STOP_SLOW}}) {
    Watched robot;
    for (int i = 0; i < ticks; ++i) {
      robot.in.now_us += static_cast<std::uint32_t>(late_us);
      robot.tick();
    }
    EXPECT_EQ(robot.state.reason, reason) << late_us << " " << ticks;
  }
  Watched once;  // and what is caught up
  for (int second = 0; second < 100; ++second) {
    once.in.now_us += 40000;
    once.tick();
    for (int caught_up = 0; caught_up < 4; ++caught_up) {
      once.in.now_us -= tick_us;
      once.tick();
    }
    EXPECT_EQ(once.tick(95), STOP_NONE) << second;
  }
  Watched calibrated;
  calibrated.in.timed = 0;
  for (int i = 0; i < 100; ++i) {
    calibrated.in.now_us += 90000;
    EXPECT_EQ(calibrated.tick(), STOP_NONE);
  }
}

TEST(FirmwareSafety, StopsWhenPulsesDoNotGetThereInTooManyTicksInARow) {
  Watched robot;
  robot.in.pulsed = 0;
  EXPECT_EQ(robot.tick(9), STOP_NONE);
  robot.in.pulsed = 1;
  EXPECT_EQ(robot.tick(), STOP_NONE);
  robot.in.pulsed = 0;
  EXPECT_EQ(robot.tick(9), STOP_NONE);
  EXPECT_EQ(robot.tick(), STOP_LOST);
}

TEST(FirmwareSafety, StopsWhenSensorsAreSilentForTooManyTicksInARow) {
  Watched robot;
  robot.in.answered = 0;
  EXPECT_EQ(robot.tick(9), STOP_NONE);
  robot.in.answered = 1;
  EXPECT_EQ(robot.tick(), STOP_NONE);
  robot.in.answered = 0;
  EXPECT_EQ(robot.tick(9), STOP_NONE);
  EXPECT_EQ(robot.tick(), STOP_SILENT);
}

TEST(FirmwareSafety, StopsWhenASwitchIsStuckButOnlyWhileWalking) {
  Watched robot;
  EXPECT_EQ(robot.tick(2), STOP_NONE);
  EXPECT_EQ(robot.tick(499, false), STOP_NONE);
  EXPECT_EQ(robot.tick(1, false), STOP_STUCK);
  Watched standing;
  standing.in.walks = 0;
  EXPECT_EQ(standing.tick(5000, false), STOP_NONE);
}

TEST(FirmwareSafety, LeavesFeetAloneWhichAreToldToStand) {
  Watched robot;
  robot.in.stands = 1;
  EXPECT_EQ(robot.tick(5000, false), STOP_NONE);
  robot.in.stands = 0;
  EXPECT_EQ(robot.tick(499, false), STOP_NONE);
  EXPECT_EQ(robot.tick(1, false), STOP_STUCK);
}

TEST(FirmwareSafety, StopsWhenNoFootIsOnTheGroundForTooLongOrTheTrunkIsTilted) {
  Watched robot;
  robot.tick();
  for (uint8_t& touch : robot.in.touch) touch = 0;
  EXPECT_EQ(robot.tick(99, false), STOP_NONE);
  EXPECT_EQ(robot.tick(1, false), STOP_FALLEN);
  Watched tilted;
  tilted.in.tilted = 1;
  EXPECT_EQ(tilted.tick(), STOP_FALLEN);
}

TEST(FirmwareSafety, CallsNoRobotFallenThatHasNotLandedSinceItWalks) {
  Watched robot;
  for (uint8_t& touch : robot.in.touch) touch = 0;
  EXPECT_EQ(robot.tick(300, false), STOP_NONE);
  robot.in.touch[2] = 1;
  EXPECT_EQ(robot.tick(1, false), STOP_NONE);
  robot.in.touch[2] = 0;
  EXPECT_EQ(robot.tick(99, false), STOP_NONE);
  robot.in.walks = 0;
  EXPECT_EQ(robot.tick(1, false), STOP_NONE);
  robot.in.walks = 1;
  EXPECT_EQ(robot.tick(499, false), STOP_NONE);
  EXPECT_EQ(robot.tick(1, false), STOP_STUCK);
}

TEST(FirmwareSafety, WithoutSwitchesWatchesNoFoot) {
  Watched robot;
  robot.in.legs = 0;
  EXPECT_EQ(robot.tick(5000, false), STOP_NONE);
}

std::string& said() {
  static std::string text;
  return text;
}

/// Two joints with targets of ± 0.5 rad.
struct Calibrated {
  servo servos[2] = {typical, typical};
  calibrated_joint joints[2] = {{"KNEE", -16384, 16384}, {"HIP", -16384, 16384}};
  calibration state{.servos = servos,
                    .joints = joints,
                    .count = 2,
                    .fraction_bits = 15,
                    .joint = -1,
                    .pulse_us = 0,
                    .print = [](const char* text) { said() += text; }};
  Calibrated() { calibrate_begin(&state); }
  std::string operator()(const std::string& line, int goes_on = 1) {
    said().clear();
    EXPECT_EQ(calibrate_line(&state, line.c_str()), goes_on) << line;
    return said();
  }
};

TEST(FirmwareCalibration, FindsZeroSignScaleAndLimits) {
  Calibrated say;
  EXPECT_EQ(say("joint 1"), "1 HIP: 1500 us\n");
  EXPECT_EQ(say("-20"), "1 HIP: 1480 us\n");
  say("zero");
  for (int i = 0; i < 5; ++i) say("-100");
  EXPECT_EQ(say("at 45"), "sign -1, us_per_rad 637\n");
  EXPECT_EQ(say("least"), "least 980 us\n");
  for (int i = 0; i < 8; ++i) say("+100");
  EXPECT_EQ(say("most"), "most 1780 us\n");
  EXPECT_THAT(
      say("table"),
      testing::EndsWith(
          "[HIP] = {3, -1, 1480, 980, 1780, 4100, 637}, /* targets 1161 to 1799 us: BEYOND THE LIMITS */\n"));
  EXPECT_EQ(say.servos[0].zero_us, typical.zero_us);
  EXPECT_EQ(say("quit", 0), "");
}

TEST(FirmwareCalibration, RefusesWhatItDoesNotUnderstandAndMovesNothing) {
  Calibrated say;
  EXPECT_THAT(say("+20"), testing::HasSubstr("first choose a joint"));
  say("joint 0");
  const std::string table = say("table");
  for (const char* line : {"joint 2", "joint -1", "joint", "joint 1x", "+101", "-500", "+", "+9999999",
                           "at 0", "at", "at x", "at 45", "zeros", "", " ", "jointzero"}) {
    EXPECT_THAT(say(line), testing::AnyOf(testing::HasSubstr("expected"))) << line;
    EXPECT_EQ(say.state.pulse_us, 1500) << line;
    EXPECT_EQ(say.state.joint, 0) << line;
    EXPECT_EQ(say("table"), table) << line;
  }
}

TEST(FirmwareCalibration, StaysWithinWhatServosBear) {
  Calibrated say;
  say("joint 0");
  for (int i = 0; i < 30; ++i) say("+100");
  EXPECT_EQ(say.state.pulse_us, 2500);
  for (int i = 0; i < 30; ++i) say("-100");
  EXPECT_EQ(say.state.pulse_us, 500);
}

TEST(FirmwareCommands, AreTakenFromTheirLine) {
  for (const auto& [line, speed_m_s, turn_rad_s] : {std::tuple{"go 0.2 -0.35", 0.2f, -0.35f},
                                                    {"go 0 0", 0.0f, 0.0f},
                                                    {"go  +1  2 ", 1.0f, 2.0f},
                                                    {"go -.5 1.", -0.5f, 1.0f},
                                                    {"go 99.9999 -0.0001", 99.9999f, -0.0001f}}) {
    command told{.speed_m_s = 7.0f, .turn_rad_s = 7.0f, .ticks = 3};
    EXPECT_EQ(command_take(&told, line), 1) << line;
    EXPECT_FLOAT_EQ(told.speed_m_s, speed_m_s) << line;
    EXPECT_FLOAT_EQ(told.turn_rad_s, turn_rad_s) << line;
    EXPECT_EQ(told.ticks, 0) << line;
  }
}

TEST(FirmwareCommands, OfOtherLinesChangeNothing) {
  for (const char* line :
       {"go",           "go ",      "go 1",      "go 1 ",  "go 1 2 3",  "go 1 x",   "go x 1",
        "go 1,2 3",     "go 1e1 2", "go - 1",    "go . 1", "go 1..2 3", "go 1 --2", "go 100 1",
        "go 0.00001 1", "go nan 1", "go0.1 0.2", "GO 1 1", "ago 1 1",   ""}) {
    command told{.speed_m_s = 7.0f, .turn_rad_s = -7.0f, .ticks = 3};
    EXPECT_EQ(command_take(&told, line), 0) << line;
    EXPECT_EQ(told.speed_m_s, 7.0f) << line;
    EXPECT_EQ(told.turn_rad_s, -7.0f) << line;
    EXPECT_EQ(told.ticks, 3) << line;
  }
  EXPECT_EQ(command_begins("go"), 1);
  EXPECT_EQ(command_begins("go x"), 1);
  EXPECT_EQ(command_begins("gone"), 0);
}

TEST(FirmwareCommands, RunOutWhereNoLineFollows) {
  command told;
  command_begin(&told);
  ASSERT_EQ(command_take(&told, "go 0 0.1"), 1);
  for (int tick = 0; tick < 99; ++tick) EXPECT_EQ(command_runs_out(&told, 100), 0);
  ASSERT_EQ(command_take(&told, "go 0.2 0"), 1);
  for (int tick = 0; tick < 100; ++tick) EXPECT_EQ(command_runs_out(&told, 100), 0);
  EXPECT_EQ(told.speed_m_s, 0.2f);
  EXPECT_EQ(command_runs_out(&told, 100), 1);
  EXPECT_EQ(told.speed_m_s, 0.0f);
  for (int tick = 0; tick < 70000; ++tick) EXPECT_EQ(command_runs_out(&told, 100), 0);
  ASSERT_EQ(command_take(&told, "go 0.2 0"), 1);
  for (int tick = 0; tick < 70000; ++tick) EXPECT_EQ(command_runs_out(&told, 0), 0);
  EXPECT_EQ(told.speed_m_s, 0.2f);
}

TEST(FirmwarePca9685, CountsTheNearestOfItsClock) {
  for (int16_t us = 0; us < 3000; ++us) EXPECT_NEAR(pca9685_counts(us), us / 4.88, 0.5001);
}

/// Registers that were written to; a chip that is gone takes nothing.
std::vector<int>& written() {
  static std::vector<int> registers;
  return registers;
}
int take(const std::uint8_t* bytes, std::uint8_t count) {
  for (int i = 1; i < count; ++i) written().push_back(bytes[0] + i - 1);
  return 1;
}
int refuse(const std::uint8_t*, std::uint8_t) {
  return 0;
}

TEST(FirmwarePca9685, WritesToNoRegisterOfAChannelThatItHasNot) {
  for (int channel = 0; channel < 256; ++channel) {
    written().clear();
    EXPECT_EQ(pca9685_pulse(take, static_cast<std::uint8_t>(channel), 1500), channel < 16) << channel;
    if (channel < 16)
      EXPECT_THAT(written(),
                  testing::ElementsAre(6 + 4 * channel, 7 + 4 * channel, 8 + 4 * channel, 9 + 4 * channel));
    else
      EXPECT_THAT(written(), testing::IsEmpty()) << channel;
  }
}

TEST(FirmwarePca9685, SaysWhetherTheChipTookIt) {
  EXPECT_EQ(pca9685_init(take), 1);
  EXPECT_EQ(pca9685_init(refuse), 0);
  EXPECT_EQ(pca9685_pulse(refuse, 0, 1500), 0);
}

}  // namespace
}  // namespace amble::tests
