#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "amble/controllers/kind_settings.hpp"
#include "amble/controllers/neural.hpp"

namespace amble::controllers {

/// The properties of a neuron; the unit of time is that of CtrnnSettings::step.
inline constexpr std::string_view bias_property = "bias", time_constant_property = "time_constant";

/// Continuous-time recurrent neural networks in a substrate (Morse et al. 2013, sec. 4 and figure 7). With
/// s(x) = 1/(1 + e^(−slope x)), bias b and time constant τ of each neuron, weights w and values o of its
/// sources:
///
/// Equation::rate        τ dy/dt = −y + s(Σ w o − b), value o = y      (the authors' code)
/// Equation::potential   τ dy/dt = −y + Σ w o,        value o = s(y + b)      (Beer 1995, eq. 1)
///
/// The value of a sensor is what is sensed, and stays as it is during a tick. All neurons are updated
/// together, steps_per_tick times by `step`, which is in the unit of the time constants. y starts from 0,
/// with StateRule::cleared in every tick. With F for the right side but −y, a step is y += step/τ (F − y) by
/// Integrator::euler; y += (1 − e^(−step/τ)) (F − y), exact while F stays, by Integrator::exponential_euler;
/// and the classical Runge-Kutta method of fourth order by Integrator::rk4.
class CtrnnArchitecture : public NeuralArchitecture {
 public:
  /// Throws UserError, too, if a time constant can be 0 or less, or shorter than the step of an explicit
  /// integrator.
  CtrnnArchitecture(const CtrnnSettings& settings, const substrate::Settings& substrate,
                    const robot::RobotSpec& robot, double timestep_s, const SensingSettings& sensing = {});
  std::unique_ptr<Parameters> decode(const cppn::Network& network) const override;
  std::unique_ptr<Batch> make_batch(int lanes) const override;

 private:
  CtrnnSettings settings_;
};

}  // namespace amble::controllers
