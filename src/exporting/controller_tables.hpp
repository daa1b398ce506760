#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "amble/controllers/modulation.hpp"
#include "amble/experiment/problem.hpp"
#include "amble/neat/genome.hpp"
#include "amble/robot/spec.hpp"
#include "amble/substrate/sensor.hpp"
#include "amble/substrate/settings.hpp"

namespace amble::exporting {

/// A joint as a controller commands it.
struct CommandedJoint {
  std::string name;
  int leg = -1;                             ///< −1: belongs to none
  double lower_rad = 0.0, upper_rad = 0.0;  ///< range of the targets; equal if the joint is held
  bool driven = true;
  bool motor = true;  ///< false: it moves freely, and its target is 0 and means nothing
};

/// A link of a sum; `source`: what it reads, in an order that the sum's owner says.
struct WeightedLink {
  int source = 0;
  float weight = 0.0f;
};

/// SUPGs as tables (controllers::SupgArchitecture says what each number means).
struct SupgTables {
  struct Leg {
    int offset_ticks = 1;
    int wait_ticks = 0;   ///< before the timer starts for the first time
    int first_timer = 0;  ///< its value in that tick, ticks; −1: stopped
  };

  int period_ticks = 0;
  static constexpr int never = -1;
  int airborne_ticks_needed = 0;  ///< ticks off the ground before a touch is a trigger; 0: each touch is;
                                  ///< `never`: no touch is
  bool is_triggered() const { return airborne_ticks_needed != never; }
  int start_tick = 0;     ///< timer value in the tick of a trigger
  int end_of_cycle = -1;  ///< timer value after period_ticks − 1; −1: stopped
  std::vector<Leg> legs;
  /// Joint by joint: target at timer −1 (stopped), 0, …, up to the largest value that the timer can have, or
  /// the period where jumps are smoothed. For a joint that belongs to no leg, the angle at which it is held.
  std::vector<std::vector<float>> targets_rad;

  /// controllers::SeamSmoother.
  struct Seam {
    bool starts_at_once = true;  ///< before tick 1 there is nothing from which to jump
    float residual_decay = 0.0f, filter_share = 1.0f;
    int filter_order = 0;
  };
  std::optional<Seam> seam = {};  ///< none: targets are those of the tables

  /// controllers::ModulatedSupgBatch. Targets have one entry more then, behind the period.
  struct Modulation {
    bool starts_at_once = true;
    bool rates_on = false;
    std::int32_t reset_share = 0, refractory_ticks = 0;
    std::vector<std::vector<controllers::LegSensor>> sensors;  ///< leg by leg
    std::vector<std::vector<float>> rates;                     ///< leg by leg, sensor by sensor
    float load_feedback = 0.0f;                                ///< 0: none, and the next two are empty
    std::vector<controllers::LegSensor> loads = {};            ///< leg by leg
    std::vector<float> cosines = {};                           ///< controllers::phase_cosines()
    bool by_reading = false;                                   ///< controllers::ShapeBy::reading
    /// Channel by channel (controllers::shape_channels), joint by joint, entries as in targets_rad; empty
    /// without shape.
    std::vector<std::vector<std::vector<float>>> gains_rad;

    std::size_t sensor_count() const { return sensors.empty() ? 0 : sensors.front().size(); }
    bool shapes() const { return !gains_rad.empty(); }
  };
  std::optional<Modulation> modulation = {};

  /// controllers::MixedBatch, beside `modulation`. Sources are rows of MixedNet.
  struct Mixed {
    struct Neuron {
      std::string name;
      float bias = 0.0f, step = 0.0f;
      std::vector<WeightedLink> links;
    };
    struct Listened {
      int joint = 0;
      float per_half = 0.0f;  ///< by which its distance from the middle is multiplied, 1/rad
    };

    std::vector<controllers::LegSensor> sensors;
    std::vector<std::string> sensor_names;
    std::vector<Neuron> neurons = {};
    std::vector<Listened> listened = {};
    std::vector<std::vector<WeightedLink>> rates = {};                    ///< leg by leg
    std::vector<std::vector<WeightedLink>> amplitudes = {}, shifts = {};  ///< joint by joint
    /// Leg by leg, first for sines and then for cosines; sources are the legs' sines, then their cosines.
    /// Empty without couplings.
    std::vector<std::vector<WeightedLink>> pulls = {};
    std::vector<std::array<float, 2>> ranges_rad = {};  ///< joint by joint: middle, and half the width
  };
  std::optional<Mixed> mixed = {};

  /// controllers::ContactEstimate, which stands for touches.
  struct Contact {
    controllers::ContactSource source = controllers::ContactSource::torque;
    std::vector<std::vector<int>> joints;  ///< leg by leg
    float begins = 0.0f, ends = 0.0f, per_tick_squared = 0.0f;
  };
  std::optional<Contact> contact = {};                ///< none: touches are read
  std::vector<std::array<float, 2>> limits_rad = {};  ///< joint by joint; of a seam or modulation
};

/// A network of neurons as tables. What a tick does is documented at controllers::NetworkArchitecture and
/// CtrnnArchitecture, and to the bit in docs/CONTROLLERS.md.
struct NeuralTables {
  /// An expressed link. `source`: of Neuron::from_sensors in `sensors`, of from_neurons in `neurons`.
  using Link = WeightedLink;
  struct Neuron {
    std::string name;
    int node = 0;                    ///< in the substrate's list of nodes
    float bias = 0.0f, rate = 0.0f;  ///< of a CTRNN; `rate` is the integrator's factor of F − y
    std::vector<Link> from_sensors = {}, from_neurons = {};  ///< in the order of summation
  };
  struct Sensor {
    std::string name;
    substrate::Sensor reads;
    float scale = 1.0f;  ///< by which a reading is multiplied
  };
  /// What happens in a tick after the sensors were read.
  enum class Update {
    levels,      ///< each neuron once, in order
    passes,      ///< all neurons together, `steps` times from 0
    euler,       ///< a CTRNN, `steps` steps
    runge_kutta  ///< a CTRNN, `steps` steps of the classical method of fourth order
  };

  Update update = Update::levels;
  int steps = 1;
  bool potential = false;  ///< controllers::Equation::potential
  bool cleared = false;    ///< the state is 0 at the beginning of each tick
  float slope = 1.0f;      ///< of the logistic function
  double sine_period_s = 1.0;
  substrate::Attitude attitude = substrate::Attitude::true_angles;
  std::vector<Sensor> sensors;
  std::vector<Neuron> neurons;
  std::vector<int> neuron_of_joint;  ///< in control order; −1: the joint is held at CommandedJoint::lower_rad
};

/// Oscillators as tables; what a tick does is documented at controllers::OscillatorArchitecture.
struct OscillatorTables {
  struct Oscillator {
    int joint = 0;  ///< in control order
    float amplitude_rad = 0.0f, phase_turns = 0.0f, offset_rad = 0.0f;
    float lower_rad = 0.0f, upper_rad = 0.0f;  ///< to which targets are limited
  };

  float swing_turns = 0.0f, stance_turns = 0.0f;  ///< a tick
  bool resets = false;                            ///< controllers::PhaseReset::touch
  std::vector<Oscillator> oscillators = {};
};

/// Steering by hand (controllers::DifferentialArchitecture) of whatever controller.
struct Differential {
  struct Steered {
    int joint = 0;   ///< in control order
    int factor = 0;  ///< controllers::DifferentialArchitecture::Factor
    float centre_rad = 0.0f, lower_rad = 0.0f, upper_rad = 0.0f;
  };

  float turn_gain = 0.0f, heading_gain = 0.0f, full_speed_m_s = 0.0f;
  float most_change = 2.0f;  ///< of a factor in a tick
  std::vector<Steered> joints = {};
};

/// A decoded controller as an export needs it, whatever its architecture.
struct ControllerTables {
  std::string kind;  ///< controllers::Architecture::name
  double timestep_s = 0.01;
  std::vector<CommandedJoint> joints;  ///< in control order
  std::vector<std::string> legs;
  std::variant<SupgTables, NeuralTables, OscillatorTables> parts;
  std::optional<Differential> differential = {};
  float heading_lead_rad = 0.0f;  ///< controllers::HeadingSettings

  /// Which sensors it reads.
  bool reads_angles() const;
  bool reads_touch() const;
  bool reads_attitude() const;
  bool reads_speeds() const;
  bool reads_torques() const;
  bool reads_yaw_rate() const;
  bool reads_loads() const;
  bool reads_commands() const;  ///< by PREFIX_set_command, not by sensors
  bool reads_heading_error() const;
  bool reads_nothing() const;
  /// How often it must be called: 1 / timestep_s.
  double rate_hz() const { return 1.0 / timestep_s; }
};

/// Throws UserError for an architecture that has no tables here.
ControllerTables controller_tables(const experiment::Problem& problem, const neat::Genome& genome);

}  // namespace amble::exporting
