#pragma once

// The settings of the kinds of controllers beside SUPGs (supg_settings.hpp), and of what steers them. What
// each setting does its kind's header says: network.hpp, ctrnn.hpp, oscillators.hpp, mixed.hpp,
// differential.hpp, switching.hpp.

#include <array>
#include <string>
#include <string_view>
#include <vector>

#include "amble/io/settings.hpp"

namespace amble::controllers {

/// A static network of neurons that is run anew in each tick.
struct NetworkSettings {
  double slope = 4.9;  ///< of the neurons' logistic function, > 0
  int passes = 17;     ///< updates of all neurons in a tick, ≥ 1

  void describe(io::SettingsVisitor& visitor);
};

/// Which differential equation the neurons follow (CtrnnArchitecture).
enum class Equation { rate, potential };
inline constexpr std::array<std::string_view, 2> equation_names{"rate", "potential"};

/// How they are integrated (CtrnnArchitecture).
enum class Integrator { euler, exponential_euler, rk4 };
inline constexpr std::array<std::string_view, 3> integrator_names{"euler", "exponential_euler", "rk4"};

/// What becomes of the neurons' state between ticks.
enum class StateRule { kept, cleared };
inline constexpr std::array<std::string_view, 2> state_rule_names{"kept", "cleared"};

/// Biases of the motors of an automatic substrate: those of the authors, or as the CPPN has them.
enum class MotorBias { fixed, evolved };
inline constexpr std::array<std::string_view, 2> motor_bias_names{"fixed", "evolved"};

/// A continuous-time recurrent neural network. The defaults are what the authors' code did.
struct CtrnnSettings {
  Equation equation = Equation::rate;
  Integrator integrator = Integrator::euler;
  double step = 1.0;        ///< > 0, in the unit of the time constants
  int steps_per_tick = 17;  ///< ≥ 1
  StateRule state = StateRule::cleared;
  double slope = 4.9;  ///< of the neurons' logistic function, > 0
  /// What each module of an automatic substrate senses beside its touch, and its motors'
  /// biases (automatic_variants.hpp).
  std::vector<std::string> sensors = {};
  MotorBias motor_bias = MotorBias::fixed;

  void describe(io::SettingsVisitor& visitor);
};

/// What a foot that comes down does to the phases of its leg.
enum class PhaseReset { none, touch };
inline constexpr std::array<std::string_view, 2> phase_reset_names{"none", "touch"};

/// A sine for each joint; its parameters are evolved.
struct OscillatorSettings {
  /// Between which evolution chooses, 0.001 … 100, and at most half a turn a timestep.
  double least_frequency_hz = 0.3, most_frequency_hz = 3.0;
  PhaseReset reset = PhaseReset::none;

  void describe(io::SettingsVisitor& visitor);
  bool operator==(const OscillatorSettings&) const = default;
};

/// Neurons of an automatic mixed substrate.
enum class LegNeurons { two, none };
inline constexpr std::array<std::string_view, 2> leg_neurons_names{"two", "none"};

/// How strongly the links of a mixed substrate act on SUPGs: what one source that says 1 changes by the
/// greatest weight, 0 … 10. 0: not at all.
struct MixedSettings {
  double rate = 1.0;  ///< ρ, a leg's timer grows by 2^ρ ticks a tick: 1 halves the period, −1 doubles it
  double amplitude = 1.0;  ///< 1 doubles the swing about the middle of the joint's range, −1 stops it
  double shift = 0.5;      ///< of the target, in halves of the joint's range
  double coupling = 1.0;   ///< ρ where the other leg is a quarter of a period ahead of its place
  LegNeurons neurons = LegNeurons::two;  ///< of each leg, in an automatic substrate

  void describe(io::SettingsVisitor& visitor);
  friend bool operator==(const MixedSettings&, const MixedSettings&) = default;
};

/// About which angle a joint swings less: that of the start pose, or the middle of its range.
enum class SwingCentre { start_pose, middle };
inline constexpr std::array<std::string_view, 2> swing_centre_names{"start_pose", "middle"};

/// Differential steering by hand, around a controller that may sense commands itself or not. Off by default.
struct DifferentialSettings {
  double turn_gain = 0.0;  ///< s/rad, 0 … 1000: inner legs swing by 1 − turn_gain × |turn|, at least −1
  double full_speed_m_s = 0.0;  ///< at which legs swing as evolved, 0 … 100; 0: hears no speeds, no stops
  double heading_gain = 0.0;    ///< 1/s, 0 … 100: rad/s added to the turn per rad of heading error
  double change_s = 0.3;        ///< time in which a swing goes from 1 to 0, 0 … 60; 0: at once
  SwingCentre about = SwingCentre::start_pose;
  std::vector<std::string> joint_types = {};  ///< of the joints that swing a leg; empty: SwingJoints

  void describe(io::SettingsVisitor& visitor);
  bool any() const { return turn_gain > 0.0 || full_speed_m_s > 0.0 || heading_gain > 0.0; }
  friend bool operator==(const DifferentialSettings&, const DifferentialSettings&) = default;
};

/// One of the gaits among which a walker switches.
struct GaitSettings {
  double speed_m_s = 0.0;   ///< at which it walks
  double turn_rad_s = 0.0;  ///< at which it turns, to the left
  std::string genome;       ///< of its CPPN, as neat::genome_text() writes it

  void describe(io::SettingsVisitor& visitor);
  friend bool operator==(const GaitSettings&, const GaitSettings&) = default;
};

/// Switching between gaits as commanded, for SUPGs. Off by default, when there are no gaits.
struct SwitchingSettings {
  std::vector<GaitSettings> gaits = {};
  double heading_gain = 0.0;  ///< 1/s: rad/s added to the turn per rad of heading error

  void describe(io::SettingsVisitor& visitor);
  bool any() const { return !gaits.empty(); }
  friend bool operator==(const SwitchingSettings&, const SwitchingSettings&) = default;
};

}  // namespace amble::controllers
