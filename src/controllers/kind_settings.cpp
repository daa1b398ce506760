#include "amble/controllers/kind_settings.hpp"

namespace amble::controllers {

void NetworkSettings::describe(io::SettingsVisitor& visitor) {
  visitor.number("slope", slope, {1e-3, 1e3},
                 {"slope of the neurons' logistic function", "HyperSharpNEAT: 4.9"});
  visitor.integer("passes", passes, {1, 10000},
                  {"updates of all neurons in a tick, from a cleared state", "the authors' code: 17"});
}

void CtrnnSettings::describe(io::SettingsVisitor& visitor) {
  visitor.choice("equation", equation, equation_names,
                 {"what is integrated: the neurons' values (rate: τ dy/dt = −y + s(Σ w y − bias)) or their "
                  "potentials (potential: τ dy/dt = −y + Σ w s(y + bias))",
                  "the authors' code: rate; Beer 1995, eq. 1: potential"});
  visitor.choice("integrator", integrator, integrator_names,
                 {"how it is integrated", "the authors' code: euler"});
  visitor.number(
      "step", step, {1e-6, 1e6},
      {"length of one step of the integrator, in the unit of the time constants", "the authors' code: 1"});
  visitor.integer("steps_per_tick", steps_per_tick, {1, 10000},
                  {"steps of the integrator in a tick", "the authors' code: 17"});
  visitor.choice("state", state, state_rule_names,
                 {"whether the neurons' state is kept from tick to tick or cleared before each",
                  "the authors' code: cleared; Morse et al. 2013: a CTRNN, so kept"});
  visitor.number("slope", slope, {1e-3, 1e3},
                 {"slope of the neurons' logistic function", "HyperSharpNEAT: 4.9; Beer 1995: 1"});
  visitor.texts(
      "sensors", sensors,
      {.what =
           "with controller.substrate = \"auto\": what each leg's module senses beside its touch, by names "
           "as those of controller.supg.modulation.sensors; in the sensors' units times their "
           "controller.sensing.sensors[].scale",
       .first_is_implied = true});
  visitor.choice(
      "motor_bias", motor_bias, motor_bias_names,
      {.what = "with controller.substrate = \"auto\": biases of the neurons that drive joints: 3 (fixed), "
               "or from −3 to 3 by the CPPN (evolved)",
       .source = "the authors' code: fixed",
       .first_is_implied = true});
}

void OscillatorSettings::describe(io::SettingsVisitor& visitor) {
  visitor.number("least_frequency_hz", least_frequency_hz, {0.001, 100.0},
                 {"the slowest that a joint can swing, turns per second"});
  visitor.number("most_frequency_hz", most_frequency_hz, {0.001, 100.0},
                 {"the fastest that a joint can swing, turns per second"});
  visitor.choice(
      "reset", reset, phase_reset_names,
      {"a foot that comes down leaves the phases of its leg as they are (none) or starts them anew "
       "(touch)",
       "Raffin et al.: none"});
}

void MixedSettings::describe(io::SettingsVisitor& visitor) {
  visitor.number(
      "rate", rate, {0.0, 10.0},
      {"what a source that says 1 adds to a leg's ρ by a rate link of the greatest weight: its rate "
       "is a factor of 2 to the power of ρ, within ± 1; 0: nothing"});
  visitor.number("amplitude", amplitude, {0.0, 10.0},
                 {"the same for amplitude: 1 doubles the pattern about the middle of the joint's range, −1 "
                  "leaves nothing of it"});
  visitor.number("shift", shift, {0.0, 10.0},
                 {"the same for shift: of the target, in halves of the joint's range"});
  visitor.number("coupling", coupling, {0.0, 10.0},
                 {"the same for coupling: ρ where the other leg is a quarter of a period ahead of where it "
                  "should be"});
  visitor.choice(
      "neurons", neurons, leg_neurons_names,
      {.what = "with controller.substrate = \"auto\": two neurons a leg, or none, for comparison: then "
               "what is commanded acts on SUPGs alone",
       .first_is_implied = true});
}

void DifferentialSettings::describe(io::SettingsVisitor& visitor) {
  visitor.number(
      "turn_gain", turn_gain, {0.0, 1000.0},
      {"while a turn of w rad/s is commanded, the legs on the inner side swing 1 − this × |w| as far "
       "as evolved, down to −1, that is backwards, s/rad; 0: no turns"});
  visitor.number(
      "full_speed_m_s", full_speed_m_s, {0.0, 100.0},
      {"commanded speed at which legs swing as evolved, m/s; by slower ones they swing less, by 0 m/s "
       "and 0 rad/s all joints stand; 0: speeds and stops are not obeyed"});
  visitor.number("heading_gain", heading_gain, {0.0, 100.0},
                 {"rate of turning that is added to the commanded one for each radian of heading error, 1/s; "
                  "0: none"});
  visitor.number("change_s", change_s, {0.0, 60.0},
                 {"time in which legs pass from swinging as evolved to standing, s; 0: at once"});
  visitor.choice(
      "about", about, swing_centre_names,
      {"angle about which a joint moves less: that of the start pose, or the middle of its range"});
  visitor.texts(
      "joint_types", joint_types,
      {"types of the joints that swing a leg forward and back; empty: of each leg the one that moves "
       "its foot farthest forward per radian in the start pose"});
}

void GaitSettings::describe(io::SettingsVisitor& visitor) {
  visitor.number("speed_m_s", speed_m_s, {-100.0, 100.0}, {"speed at which this gait walks, m/s"});
  visitor.number("turn_rad_s", turn_rad_s, {-100.0, 100.0}, {"rate at which it turns to the left, rad/s"});
  visitor.text("genome", genome, {"genome of its CPPN, as in a champion file, as JSON in a text"});
}

void SwitchingSettings::describe(io::SettingsVisitor& visitor) {
  visitor.tables(
      "gaits", gaits,
      {"what the walker can do: `amble repertoire RUN --switching FILE.json` writes them from a map"});
  visitor.number("heading_gain", heading_gain, {0.0, 100.0},
                 {"rate of turning that is added to the commanded one for each radian of heading error, 1/s; "
                  "0: none"});
}

}  // namespace amble::controllers
