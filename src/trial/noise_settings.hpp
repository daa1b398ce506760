#pragma once

#include <array>
#include <string_view>

#include "amble/io/settings.hpp"
#include "amble/record/levels.hpp"
#include "amble/trial/settings.hpp"

/// Trials: a controller drives a robot in an engine for a while.
namespace amble::trial {

/// How the scores of several episodes are combined.
enum class EpisodeScore {
  mean,           ///< their mean
  worst,          ///< the least
  median,         ///< their median: what typically happens
  lower_quartile  ///< their 25 % quantile, of type 7
};
/// As configs write them, by EpisodeScore.
inline constexpr std::array<std::string_view, 4> episode_score_names{"mean", "worst", "median",
                                                                     "lower_quartile"};

/// Noise against controllers that exploit the quirks of one simulator (Jakobi, Husbands & Harvey 1995): what
/// works in each of several disturbed trials ("episodes") does not depend on a detail. All amounts are 0 by
/// default: no noise. Each is drawn uniformly; see trial/scenario.hpp. Ranges are those that describe() holds
/// a config to.
struct NoiseSettings {
  int episodes = 1;                         ///< trials per evaluation, 1 … 1000
  EpisodeScore score = EpisodeScore::mean;  ///< what counts of their scores
  bool first_undisturbed = false;  ///< whether the first is without noise; then there are two at least
  /// Largest impulse on the root, along the plane of the ground, / the whole mass of the intact robot, 0 …
  /// 100.
  double push_m_s = 0.0;
  double push_interval_s = 2.0;  ///< one push in each such interval, at a random moment, 1e−5 … 1e6
  double start_joint_rad = 0.0;  ///< start: each joint turned by up to ± this, within its stops, 0 … 0.5
  double start_tilt_rad = 0.0;   ///< start: roll and pitch of the root, each up to ± this, 0 … 0.5
  double start_height_m = 0.0;   ///< start: up to so much higher over the ground, 0 … 1
  double touch_flip_probability = 0.0;  ///< sensors: that a touch is read the wrong way in a tick, 0 … 1
  double joint_sensor_rad = 0.0;     ///< sensors: error of each joint angle, constant in a trial, ± 0 … 1
  double attitude_sensor_rad = 0.0;  ///< sensors: error of roll, pitch and yaw, likewise, ± 0 … 1
  int latency_ticks = 0;  ///< targets come late by 0 to this many ticks, constant in a trial, 0 … 100

  void describe(io::SettingsVisitor& visitor);  ///< the table [noise]
  /// Throws SettingError for several episodes that would all be the same, and pushes more often than steps.
  /// `other_places`: whether each episode starts at another place anyway (ground::Settings::start_place_m).
  void validate(const Settings& trial, bool other_places = false) const;

  /// Whether the robot starts elsewhere than in its start pose.
  bool disturbs_start() const;
  /// Whether there is any noise at all; that of sensors that controllers::SensingSettings gives is not meant.
  bool any() const;
};

/// The noise of trials at a level (record/levels.hpp): their starts, or pushes. One episode.
NoiseSettings noise_of(const record::Level& level);

}  // namespace amble::trial
