#pragma once

#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "amble/controllers/kind_settings.hpp"
#include "amble/controllers/supg.hpp"
#include "amble/controllers/supg_settings.hpp"

namespace amble::controllers {

/// What surrounds SUPGs in a mixed substrate, the same for all genomes. What is summed comes from rows: first
/// the sensors, then the neurons, then the SUPGs that neurons listen to.
struct MixedNet {
  /// A link; `source`: a row.
  struct Link {
    int source = 0;
    int index = 0;  ///< in Layout::links()
  };
  /// A sum over links, in the order of the layout.
  struct Sum {
    std::vector<Link> links;
  };
  /// The coupling of a leg to another, of one link.
  struct Coupling {
    int leg = 0, other = 0;
    int index = 0;
  };

  std::vector<LegSensor> sensors;
  std::vector<std::string> sensor_names;
  std::vector<int> neurons;     ///< nodes
  std::vector<int> listened;    ///< SUPGs that neurons listen to: index in SupgJoints::of_legs
  std::vector<Sum> hidden;      ///< neuron by neuron
  std::vector<Sum> rates;       ///< leg by leg
  std::vector<Sum> amplitudes;  ///< as SupgJoints::of_legs
  std::vector<Sum> shifts;      ///< the same
  std::vector<Coupling> couplings;

  int rows() const { return static_cast<int>(sensors.size() + neurons.size() + listened.size()); }
  int first_neuron() const { return static_cast<int>(sensors.size()); }
  int first_listened() const { return static_cast<int>(sensors.size() + neurons.size()); }
  /// Links of amplitudes or shifts into a SUPG.
  bool reshapes(std::size_t supg) const {
    return !amplitudes[supg].links.empty() || !shifts[supg].links.empty();
  }
};

/// A decoded mixed controller: the SUPGs' targets, and what is around them.
class MixedParameters : public ModulatedParameters {
 public:
  MixedParameters(SupgParameters targets, std::size_t links, std::size_t neurons, std::size_t couplings)
      : ModulatedParameters(std::move(targets), 0, 0),
        weights(links),
        biases(neurons),
        steps(neurons),
        in_phase(couplings),
        out_of_phase(couplings) {}

  std::vector<float> weights;        ///< link by link, times its port's gain; 0: not expressed, or coupling
  std::vector<float> biases, steps;  ///< neuron by neuron; a step is 1 − e^(−timestep/τ)
  std::vector<float> in_phase, out_of_phase;  ///< coupling by coupling: c cos 2πψ, c sin 2πψ
};

/// SUPGs, neurons and sensors in one substrate. Nodes that drive joints are SUPGs (SupgArchitecture), nodes
/// with a sensor sense, all others are neurons. In each tick, before the SUPGs' own:
///
/// 1. Sensors are read: s = reading × scale / full, then limited to ± 1 (substrate::SensorKind::full; the
///    scale of `sensing`; of an angle the reading is its distance from the middle of the joint's range).
/// 2. Neurons: h ← h + k (tanh(Σ w u + bias) − h), k = 1 − e^(−timestep/time_constant). u are sensors as read
///    now, neurons and SUPGs as they were after the last tick; a SUPG's value is its target as −1 … 1 in the
///    joint's range. h is 0 before the first tick, and where it is smaller than 1e−9.
/// 3. Rates: a leg's timer grows by 2^ρ, ρ = Σ a u + Σ c sin 2π(φ' − φ − ψ), within ± 1. u are sensors and
///    neurons of this tick, from links with Port::rate to any of the leg's SUPGs; φ and φ' the phases timer /
///    period of the leg and of another before this tick, from links with Port::coupling between SUPGs of the
///    two. ψ is the difference of the phases that their offsets begin with, φ'₀ − φ₀: coupling holds legs to
///    the gait that the offsets describe. Timers that stand couple with none.
/// 4. Targets: y + (y − middle) A + B × half the range, limited to the range, with y the SUPG's target, A = Σ
///    g u within ± 1 by Port::amplitude, and B = Σ o u within ± 1 by Port::shift.
///
/// A weight is its CPPN output beyond the threshold, −1 … 1 (Layout), times Settings::weight_range for hidden
/// links, and times the gain of MixedSettings for the others. With all of these gains 0 it is to the bit the
/// SUPGs alone. Of SupgSettings all holds but `modulation.sensors` and `modulation.load_feedback`.
class MixedArchitecture : public SupgArchitecture {
 public:
  /// Throws UserError as SupgArchitecture does, and for these two, a clock among the sensors, or a
  /// time constant that can be 0.
  MixedArchitecture(const SupgSettings& supg, const MixedSettings& mixed,
                    const substrate::Settings& substrate, const robot::RobotSpec& robot, double timestep_s,
                    const SensingSettings& sensing = {});

  std::string name() const override { return "mixed"; }
  std::unique_ptr<Parameters> decode(const cppn::Network& network) const override;
  std::unique_ptr<Batch> make_batch(int lanes) const override;
  std::string parameters_json(const Parameters& parameters) const override;
  robot::ExtraSenses extra_senses() const override;
  bool reads(const substrate::Sensor& sensor) const override;
  bool scales(const substrate::Sensor& sensor) const override;
  const MixedNet& net() const { return *net_; }
  /// Names of the neurons, in the order of MixedNet::neurons.
  std::vector<std::string> neuron_names() const;

 private:
  double weight_gain(substrate::Port port) const;

  MixedSettings mixed_;
  double weight_range_, heading_lead_rad_;
  std::shared_ptr<const MixedNet> net_;
};

/// From a layout of which kind and ports of all links have been checked. `of_legs`: SupgJoints. Throws
/// SettingError for a clock among the sensors, and for a leg that is coupled to itself.
MixedNet make_mixed_net(const substrate::Layout& layout, const std::vector<int>& of_legs, int types,
                        const robot::RobotSpec& robot, const std::vector<SensorModel>& models);

}  // namespace amble::controllers
