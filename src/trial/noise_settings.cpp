#include "amble/trial/noise_settings.hpp"

#include "amble/core/error.hpp"

namespace amble::trial {

void NoiseSettings::describe(io::SettingsVisitor& visitor) {
  visitor.integer(
      "episodes", episodes, {1, 1000},
      {"trials per evaluation, each with noise of its own, the same for all genomes of a generation"});
  visitor.choice("score", score, episode_score_names,
                 {"what counts of the scores of an evaluation's episodes"});
  visitor.flag("first_undisturbed", first_undisturbed,
               {"whether the first episode is without noise, so that no gait comes to need it"});
  visitor.number("push_m_s", push_m_s, {0.0, 100.0},
                 {"pushes: largest horizontal impulse, divided by the whole mass of the intact robot, m/s; "
                  "acts on the root"});
  visitor.number("push_interval_s", push_interval_s, {1e-5, 1e6},
                 {"one push, at a random moment, in each such interval, s"});
  visitor.number("start_joint_rad", start_joint_rad, {0.0, 0.5},
                 {"start: each joint turned by up to ± this, within its stops, rad"});
  visitor.number("start_tilt_rad", start_tilt_rad, {0.0, 0.5},
                 {"start: roll and pitch of the root, each up to ± this, rad"});
  visitor.number("start_height_m", start_height_m, {0.0, 1.0},
                 {"start: up to so much higher over the ground than without noise, m"});
  visitor.number("touch_flip_probability", touch_flip_probability, {0.0, 1.0},
                 {"sensors: probability per tick that a foot's touch is read the wrong way round"});
  visitor.number("joint_sensor_rad", joint_sensor_rad, {0.0, 1.0},
                 {"sensors: each joint angle is read wrong by up to ± this, constant during a trial, rad"});
  visitor.number("attitude_sensor_rad", attitude_sensor_rad, {0.0, 1.0},
                 {"sensors: the same for roll, pitch and yaw, rad"});
  visitor.integer(
      "latency_ticks", latency_ticks, {0, 100},
      {"targets reach the motors late, by a number of ticks from 0 to this, constant during a trial"});
}

void NoiseSettings::validate(const Settings& trial, bool other_places) const {
  if (first_undisturbed && episodes < 2)
    fail_setting({"noise.first_undisturbed", "noise.episodes"},
                 "noise.first_undisturbed leaves noise.episodes = {} no noise; expected at least 2",
                 episodes);
  if (episodes > 1 && !any() && !other_places)
    fail_setting({"noise.episodes"},
                 "noise.episodes = {}: without any noise they would all be the same; expected 1", episodes);
  if (push_m_s > 0.0 && push_interval_s < trial.timestep_s)
    fail_setting({"noise.push_interval_s", "trial.timestep_s"},
                 "noise.push_interval_s = {}: expected at least one timestep, {} s", push_interval_s,
                 trial.timestep_s);
}

bool NoiseSettings::disturbs_start() const {
  return start_joint_rad > 0.0 || start_tilt_rad > 0.0 || start_height_m > 0.0;
}

bool NoiseSettings::any() const {
  return disturbs_start() || push_m_s > 0.0 || touch_flip_probability > 0.0 || joint_sensor_rad > 0.0 ||
         attitude_sensor_rad > 0.0 || latency_ticks > 0;
}

NoiseSettings noise_of(const record::Level& level) {
  constexpr double drop_m_per_rad = 0.1;
  NoiseSettings noise;
  noise.start_joint_rad = noise.start_tilt_rad = level.start_rad;
  noise.start_height_m = drop_m_per_rad * level.start_rad;
  noise.push_m_s = level.push_m_s;
  return noise;
}

}  // namespace amble::trial
