#include "amble/controllers/supg_seam.hpp"

#include <algorithm>

#include "amble/controllers/supg_kernel.hpp"
#include "amble/cppn/activation.hpp"

namespace amble::controllers {
namespace {

/// e^(−x) for x ≥ 0, the same on every CPU: (1 − t)/(1 + t) with t = tanh(x/2), the bipolar sigmoid.
float decay(double x) {
  float t = static_cast<float>(x);
  cppn::activate(neat::Activation::bipolar_sigmoid, cppn::Linear::identity, {&t, 1});
  return (1.0f - t) / (1.0f + t);
}

}  // namespace

void SeamSettings::describe(io::SettingsVisitor& visitor) {
  visitor.choice(
      "time", time, substrate::time_inputs_names,
      {"what the CPPN is told of a pattern's time t (in periods): t (line), or sin 2πt and cos 2πt in "
       "its place (circle), so that each pattern ends where it began",
       "line: Morse et al. 2013"});
  visitor.flag("detrend", detrend,
               {"whether a pattern P becomes P − (t − ½)(P(1) − P(0)), which ends where it began",
                "Morse et al. 2013: not"});
  visitor.number(
      "residual_s", residual_s, {0.0, 60.0},
      {"a jump, at a trigger or at the end of a period, fades with this time constant, s; 0: it is "
       "one",
       "Morse et al. 2013: 0"});
  visitor.number("filter_s", filter_s, {0.0, 60.0},
                 {"time constant of a low-pass filter of all targets, s; it delays them always; 0: none",
                  "Morse et al. 2013: 0"});
  visitor.integer("filter_order", filter_order, {1, 2},
                  {"order of that filter; of the second it is critically damped"});
}

SeamFactors::SeamFactors(const SeamSettings& settings, double timestep_s)
    : residual_decay(settings.residual_s > 0.0 ? decay(timestep_s / settings.residual_s) : 0.0f),
      filter_share(settings.filter_s > 0.0 ? 1.0f - decay(timestep_s / settings.filter_s) : 1.0f),
      filter_order(settings.filter_s > 0.0 ? settings.filter_order : 0) {}

SeamSmoother::SeamSmoother(const SeamSettings& settings, double timestep_s, int joints, int lanes)
    : factors_(settings, timestep_s),
      joints_(joints),
      lanes_(lanes),
      residual_rad_(joints, lanes),
      stage_rad_(joints * factors_.filter_order, lanes) {}

void SeamSmoother::load(int joint, int lane, float target_rad) {
  residual_rad_.at(joint, lane) = 0.0f;
  for (int stage = 0; stage < factors_.filter_order; ++stage)
    stage_rad_.at(stage * joints_ + joint, lane) = target_rad;
}

void SeamSmoother::smooth(int joint, const float* continued_rad, const float* present_rad,
                          const std::int32_t* jumped, float lower_rad, float upper_rad, float* targets_rad) {
  if (factors_.residual_decay > 0.0f)
    run_residual({.decay = factors_.residual_decay,
                  .lower_rad = lower_rad,
                  .upper_rad = upper_rad,
                  .continued_rad = continued_rad,
                  .present_rad = present_rad,
                  .jumped = jumped,
                  .residual_rad = residual_rad_.row(joint)},
                 targets_rad, lanes_);
  else
    std::copy_n(present_rad, lanes_, targets_rad);
  if (factors_.filter_order == 0) return;
  for (int stage = 0; stage < factors_.filter_order; ++stage)
    run_filter(factors_.filter_share, stage_rad_.row(stage * joints_ + joint), targets_rad, lanes_);
  const LimitedRow row{targets_rad, lower_rad, upper_rad, targets_rad};
  run_limits({&row, 1}, lanes_);
}

}  // namespace amble::controllers
