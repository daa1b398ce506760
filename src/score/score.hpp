#pragma once

#include <deque>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "amble/io/settings.hpp"
#include "amble/record/objective.hpp"
#include "amble/record/trajectory.hpp"

namespace amble::score {

/// Distance from start to end of a trial, m, in a straight line over the ground, whatever the direction
/// (Morse et al. 2013, sec. 4); 0 if it diverged.
double distance_m(const record::Trajectory& trajectory);

/// The value of a trial in which the robot may have fallen: times `fall_factor` if it did.
double credited(double value, record::Outcome outcome, double fall_factor);

/// One quantity in a score and its weight.
struct Term {
  std::string quantity = "distance";
  double weight = 1.0;
  void describe(io::SettingsVisitor& visitor);
};

/// Bounds on a quantity.
struct Limit {
  std::string quantity = "uprightness";
  double least = -1e9;
  double most = 1e9;
  void describe(io::SettingsVisitor& visitor);
};

/// How strictly the quantity `tracking` judges (tracking.hpp).
struct TrackingSettings {
  double speed_m_s = 0.2;
  double turn_rad_s = 0.5;

  void describe(io::SettingsVisitor& visitor);
  friend bool operator==(const TrackingSettings&, const TrackingSettings&) = default;
};

/// Definition of a score. The default is the paper's: distance in a straight line alone.
struct Settings {
  std::vector<Term> terms{Term()};
  std::vector<Limit> limits = {};
  double breach_factor = 0.0;
  double heading_deg = 0.0;  ///< to the left (counter-clockwise) of the robot's forward axis at the start
  double speed_m_s = 0.5;
  TrackingSettings tracking = {};

  void describe(io::SettingsVisitor& visitor);
  /// Throws SettingError for a quantity that does not exist, and for limits that no trial can meet.
  void validate() const;
  /// Whether a score by these settings is distance_m(), to the bit.
  bool is_distance() const;
};

/// What a score depends on besides the trajectory.
struct Context {
  const Settings& settings;
  double duration_s = 0.0;  ///< of a trial that completes
  double weight_n = 0.0;    ///< of the robot
  int leg = -1;             ///< of quantities that legs have; −1: the mean over legs
};

/// A quantity of a trial that scores, limits and maps can name.
struct Quantity {
  std::string name, unit;     ///< unit: "m", "" for a pure number
  io::Range range;            ///< of its values
  record::Measures measures;  ///< measurements of trials that it needs
  /// In the range, whatever the trial: also for one of no steps. Const, called by several threads at once.
  std::function<double(const record::Trajectory& trajectory, const Context& context)> of;
  bool of_legs = false;  ///< whether it is a quantity of one leg, or the mean over legs
};

/// Adds a quantity, from then on one of those that configs can name. Before the first config is read; not
/// thread safe. Throws UserError for a name that is taken or cannot be one.
void register_quantity(Quantity quantity);

/// amble's own, and then those that were added.
const std::deque<Quantity>& quantities();
/// By its name; throws SettingError naming `key` and the names there are.
const Quantity& quantity(const std::string& name, const std::string& key);

/// Scores trials: Σ weight × quantity, at least 0; times breach_factor for a trial that violates a limit, 0
/// for one that diverged.
class Score {
 public:
  /// The settings must be valid; `weight_n` is the robot's, `duration_s` that of a trial that completes.
  Score(const Settings& settings, double duration_s, double weight_n);

  /// Finite, ≥ 0.
  double of(const record::Trajectory& trajectory) const;
  /// Measurements of trials that it needs.
  record::Measures measures() const;

 private:
  Settings settings_;
  double duration_s_, weight_n_;
};

/// What a score by these settings is called and measured in.
record::Objective objective_of(const Settings& settings);

/// A score, already formatted, with its unit (record::Objective::unit).
std::string with_unit(std::string_view number, const Settings& settings);

}  // namespace amble::score
