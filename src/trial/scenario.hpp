#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "amble/core/math.hpp"
#include "amble/core/random.hpp"
#include "amble/ground/ground.hpp"
#include "amble/physics/engine.hpp"
#include "amble/robot/spec.hpp"
#include "amble/trial/commands.hpp"
#include "amble/trial/noise_settings.hpp"

namespace amble::trial {

/// All noise of one trial, drawn beforehand. Steps count from 1, as in Observer::on_step. draw_scenario()
/// makes one; in one that is made by hand `joint_sensor_rad` and `attitude_sensor_rad` must have their sizes.
struct Scenario {
  /// A push of the root.
  struct Push {
    int step = 0;      ///< acts during this step
    Vec3 impulse_n_s;  ///< in the world (physics::Engine::push)
  };
  /// A touch that is read the wrong way round.
  struct TouchFlip {
    int step = 0;  ///< in what the controller reads before this step
    int leg = 0;   ///< index in robot::RobotSpec::legs
  };

  std::optional<physics::StartPose> start;  ///< nothing: the robot's own start pose
  std::vector<Push> pushes;                 ///< by rising step
  std::vector<TouchFlip> touch_flips;       ///< by rising step
  std::vector<float> joint_sensor_rad;      ///< added to what is read, one number per joint
  std::vector<float> attitude_sensor_rad;   ///< the same for roll, pitch and yaw: three numbers
  int latency_ticks = 0;                    ///< how late targets come; until the first arrive, they are 0
  std::optional<Stream> readings = {};      ///< noise of single readings (trial/senses.hpp); nothing: none
  std::optional<CommandSchedule> commands = {};  ///< drawn ones; nothing: those of Protocol::commands
};

/// Names a scenario: the same key and settings give the same scenario, to the bit.
///
/// It contains no genome on purpose: all genomes of a generation have the same scenarios (common random
/// numbers; Law, Simulation Modeling and Analysis, sec. 11.2), which removes the variance between scenarios
/// from their comparison. The next generation has others, so that genomes, elites included, cannot adapt to
/// one scenario.
struct ScenarioKey {
  std::uint64_t seed = 0;        ///< the run's
  std::uint32_t generation = 0;  ///< whose noise it is
  /// Below 2^28. 0 … 999: trials of an evaluation; from 1000: trials that evolution has not seen; from 1e6:
  /// those by which champions are chosen; from 2e6: typical ones (experiment/problem/episode_set.hpp).
  std::uint32_t episode = 0;
};

/// Where trials start.
struct StartGround {
  const ground::Ground* ground = nullptr;  ///< null: the plane z = 0
  double place_m = 0.0;                    ///< ground::Settings::start_place_m
};

/// The scenario of a trial of `steps` steps. A longer trial begins as a shorter one of the same key, and no
/// kind of noise depends on the amount of another.
///
/// With NoiseSettings::first_undisturbed, episode 0 is the trial without noise, to the bit.
///
/// Start: joints and tilt as drawn, then the root is lifted so that the lowest point is as high over the
/// ground as in the robot's own start pose (but not below it), plus the height drawn. Pushes: uniform over a
/// disc in the world's x-y plane, which on a slope is that of the slope.
///
/// The robot is put up to ± StartGround::place_m from the origin along x and y; on uneven ground it is then
/// lifted or lowered to where it is as high over the ground as in its own start pose on the plane.
///
/// Commands are drawn whatever the noise, also for an undisturbed episode; with CommandSettings::mirrored
/// those of episode 2 n + 1 mirror those of episode 2 n.
///
/// `robot` is that of the trial, with its start pose and gravity; the settings must be valid.
Scenario draw_scenario(const NoiseSettings& noise, const robot::RobotSpec& robot, int steps,
                       double timestep_s, const ScenarioKey& key, const StartGround& start = {},
                       const CommandSettings& command = {});

}  // namespace amble::trial
