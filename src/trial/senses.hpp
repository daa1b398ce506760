#pragma once

#include <optional>
#include <vector>

#include "amble/controllers/sensing.hpp"
#include "amble/core/index.hpp"
#include "amble/core/lanes.hpp"
#include "amble/core/random.hpp"
#include "amble/physics/engine.hpp"
#include "amble/trial/scenario.hpp"

namespace amble::trial {

/// What is between a robot and its controller's sensors.
struct Sensing {
  robot::ExtraSenses extra;                      ///< rows that the controller reads beside those of engines
  std::vector<controllers::SensorModel> models;  ///< noise, delay, dead time
  float heading_lead_rad = 0.0f;                 ///< controllers::HeadingSettings

  /// Whether controllers may read something else than the engine's frame.
  bool any() const { return extra.any() || !models.empty(); }
};

/// Rates as controllers sense them, rad/s: how far an angle moved in a tick of 1/rate_hz, in single
/// precision.
float rate_of(float before_rad, float now_rad, float rate_hz);
/// The same of an angle that goes from π to −π.
float turning_rate_of(float before_rad, float now_rad, float rate_hz);

/// An angle as one of at most half a turn, in single precision; of what is not finite NaN.
float wrapped_rad(float angle_rad);

/// The heading that commands lead to.
class ToldHeading {
 public:
  /// `lead_rad`: so far at most it is ahead of the robot's; 0: without limit.
  explicit ToldHeading(float lead_rad = 0.0f) : lead_rad_(lead_rad) {}

  /// It begins with the robot's own.
  void face(float yaw_rad) { wanted_yaw_rad_ = yaw_rad; }
  /// How far it is to the left of the robot's, −π … π rad; once per tick, at whose end it has turned by the
  /// commanded rate times the tick, `turned_rad`.
  float error_rad(float yaw_rad, float turned_rad);

 private:
  float lead_rad_, wanted_yaw_rad_ = 0.0f;
};

/// The sensors of a runner's robots as they are read: rates and torques that engines do not put into their
/// frames, and then for each reading, in this order: its delay (before so much time has gone by, the value at
/// the start), its dead time (it is renewed in the first tick and then every hold_ticks ticks), and its
/// noise, uniform, anew for each reading, by a stream of the trial's scenario; without a scenario there is
/// none. Scales are the controllers'. Rates and headings are those of true angles. A model of a sensor whose
/// rows the controller does not ask for has no effect.
///
/// The heading that commands lead to (ToldHeading) is the robot's own before the first tick.
class Senses {
 public:
  /// `sensors` gives the number of lanes and rows. Torques and loads only of an engine that measures them.
  Senses(const Sensing& sensing, const robot::SensorFrame& sensors, double timestep_s);

  /// The robot of this lane was placed; `scenario` is that of its trial, or null; `commands` likewise (not
  /// copied).
  void load(int lane, const physics::Engine& engine, const Scenario* scenario,
            const CommandSchedule* commands = nullptr);
  /// From now on the heading that commands lead to begins with the present one.
  void face(int lane, const physics::Engine& engine);
  /// There is no trial in this lane any more.
  void clear(int lane) { lanes_[to_index(lane)].commands = nullptr; }
  /// As controllers read them in this tick, all lanes; once per tick. Valid until the next call. Without
  /// anything to do it is the engine's own. AMBLE_CHECK: the engine measures torques and loads if they are
  /// asked for.
  const robot::SensorFrame& read(const physics::Engine& engine);

 private:
  struct Lane {
    int tick = 0;
    const CommandSchedule* commands = nullptr;
    ToldHeading heading;
    std::optional<Stream> noise;
  };
  /// A sensor's ring buffer over the ticks of its delay, for all lanes, and its last readings.
  struct Imperfect {
    controllers::SensorModel model;
    LaneArray past, held;
  };

  void take_rates(const physics::Engine& engine);
  void take_commands(const robot::SensorFrame& sensors);
  void read_imperfect(Imperfect& sensor, int lane);

  Sensing sensing_;
  float rate_hz_, timestep_s_;
  std::vector<Lane> lanes_;
  std::vector<Imperfect> imperfect_;
  LaneArray angle_before_rad_, yaw_before_rad_;
  robot::SensorFrame read_;
};

}  // namespace amble::trial
