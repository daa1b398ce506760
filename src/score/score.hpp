#pragma once

#include <deque>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "amble/io/settings.hpp"
#include "amble/record/objective.hpp"
#include "amble/record/trajectory.hpp"

/// What a trial is worth, and what it was like in numbers.
namespace amble::score {

/// Distance from start to end of a trial, m, in a straight line over the ground, whatever the direction
/// (Morse et al. 2013, sec. 4); 0 if it diverged.
double distance_m(const record::Trajectory& trajectory);

/// The value of a trial in which the robot may have fallen: times `fall_factor` (trial::Settings) if it did.
double credited(double value, record::Outcome outcome, double fall_factor);

/// One quantity in a score and its weight.
struct Term {
  std::string quantity = "distance";            ///< name of a row of quantities()
  double weight = 1.0;                          ///< value of one unit of it, −1e6 … 1e6
  void describe(io::SettingsVisitor& visitor);  ///< an item of score.terms
};

/// Bounds on a quantity, in its unit. A value on a bound keeps to it.
struct Limit {
  std::string quantity = "uprightness";         ///< name of a row of quantities()
  double least = -1e9;                          ///< not below this, −1e9 … 1e9
  double most = 1e9;                            ///< not above this, likewise; at least `least`
  void describe(io::SettingsVisitor& visitor);  ///< an item of score.limits
};

/// How strictly the quantity `tracking` judges (tracking.hpp).
struct TrackingSettings {
  double speed_m_s = 0.2;   ///< an error so large counts 0 where a slower speed is commanded, 1e−6 … 1000
  double turn_rad_s = 0.5;  ///< an error so large counts 0 where a slower turn is commanded, 1e−6 … 1000

  void describe(io::SettingsVisitor& visitor);  ///< the table [score.tracking]
  friend bool operator==(const TrackingSettings&, const TrackingSettings&) = default;
};

/// Definition of a score. The default is the paper's: distance in a straight line alone.
struct Settings {
  std::vector<Term> terms{Term()};  ///< the score is their sum, at least 0; there is one at least
  std::vector<Limit> limits = {};   ///< what a trial must keep to
  double breach_factor = 0.0;       ///< share of the score kept for each limit that is broken, 0 … 1
  /// Which way the quantities heading and speed_kept go: to the left (counter-clockwise) of the robot's
  /// forward axis at the start, −360 … 360.
  double heading_deg = 0.0;
  double speed_m_s = 0.5;          ///< speed wanted by the quantity speed_kept, 1e−6 … 1000
  TrackingSettings tracking = {};  ///< how strictly the quantity tracking judges

  void describe(io::SettingsVisitor& visitor);  ///< the table [score]
  /// Throws SettingError: no term, a quantity that does not exist, a limit whose `least` is above its `most`.
  void validate() const;
  /// Whether a score by these settings is distance_m(), to the bit.
  bool is_distance() const;
};

/// What a score depends on besides the trajectory.
struct Context {
  const Settings& settings;  ///< the score's; not owned
  double duration_s = 0.0;   ///< length of a trial that completes, positive
  double weight_n = 0.0;     ///< the robot's weight
  int leg = -1;              ///< which leg, for a quantity that legs have; −1: the mean over legs
};

/// A quantity of a trial that scores, limits and maps can name.
struct Quantity {
  std::string name,           ///< as configs write it: a–z, 0–9, "-" and "_"
      unit;                   ///< "m", "J", …; "" for a pure number
  io::Range range;            ///< which values it can have
  record::Measures measures;  ///< measurements of trials that it needs
  /// Its value, finite and in the range, whatever the trial: also for one of no steps. An AMBLE_CHECK fails
  /// where one that was added is not. Const, called by several threads at once.
  std::function<double(const record::Trajectory& trajectory, const Context& context)> of;
  bool of_legs = false;   ///< whether it is a quantity of one leg, or the mean over legs
  bool circular = false;  ///< whether `range` is a turn, whose ends are the same
};

/// Adds a quantity, from then on one of those that configs can name. Before the first config is read; not
/// thread safe. Throws UserError for a name that is taken or cannot be one. AMBLE_CHECK: it has a function.
void register_quantity(Quantity quantity);

/// amble's own, and then those that were added.
const std::deque<Quantity>& quantities();
/// By its name; throws SettingError naming `key`, the setting that has it, and the names there are.
const Quantity& quantity(const std::string& name, const std::string& key);

/// Scores trials: Σ weight × quantity, at least 0; times breach_factor for each limit that a trial violates;
/// 0 for one that diverged. Const, shared by all threads.
class Score {
 public:
  /// `weight_n` is the robot's, `duration_s` that of a trial that completes. Throws SettingError as
  /// Settings::validate().
  Score(const Settings& settings, double duration_s, double weight_n);

  /// Finite, ≥ 0, before trial::Settings::fall_factor (credited()). The trial was measured as measures()
  /// says.
  double of(const record::Trajectory& trajectory) const;
  /// Measurements of trials that it needs.
  record::Measures measures() const;

 private:
  Settings settings_;
  double duration_s_, weight_n_;
};

/// What a score by these settings is called and measured in.
record::Objective objective_of(const Settings& settings);

/// What is added up to it, by the names of docs/SCORES.md: "tracking", "distance + 0.5 × upright_time".
std::string described(const Settings& settings);

/// A score, already formatted, with its unit (record::Objective::unit): "3.12 m".
std::string with_unit(std::string_view number, const Settings& settings);

}  // namespace amble::score
