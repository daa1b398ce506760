#pragma once

#include <array>
#include <string_view>

#include "amble/io/settings.hpp"
#include "amble/record/levels.hpp"
#include "amble/trial/settings.hpp"

namespace amble::trial {

/// How the scores of several episodes are combined.
enum class EpisodeScore { mean, worst, median, lower_quartile };
inline constexpr std::array<std::string_view, 4> episode_score_names{"mean", "worst", "median",
                                                                     "lower_quartile"};

/// Noise against controllers that exploit the quirks of one simulator (Jakobi, Husbands & Harvey 1995): what
/// works in each of several disturbed trials ("episodes") does not depend on a detail. All amounts are 0 by
/// default: no noise. Each is drawn uniformly; see trial/scenario.hpp.
struct NoiseSettings {
  int episodes = 1;
  EpisodeScore score = EpisodeScore::mean;
  bool first_undisturbed = false;
  double push_m_s = 0.0;
  double push_interval_s = 2.0;
  double start_joint_rad = 0.0;
  double start_tilt_rad = 0.0;
  double start_height_m = 0.0;
  double touch_flip_probability = 0.0;
  double joint_sensor_rad = 0.0;
  double attitude_sensor_rad = 0.0;
  int latency_ticks = 0;

  void describe(io::SettingsVisitor& visitor);
  /// Throws UserError for several episodes that would all be the same, and pushes more often than steps.
  /// `other_places`: whether each episode starts at another place anyway (ground::Settings::start_place_m).
  void validate(const Settings& trial, bool other_places = false) const;

  /// Whether the robot starts elsewhere than in its start pose.
  bool disturbs_start() const;
  /// Whether there is any noise at all.
  bool any() const;
};

/// The noise of trials at a level: their starts, or pushes.
NoiseSettings noise_of(const record::Level& level);

}  // namespace amble::trial
