#include "amble/core/index.hpp"
#include "amble/exporting/c_neural_text.hpp"
#include "amble/exporting/c_parts.hpp"

/// The batch of controllers::OscillatorArchitecture in C, operation by operation.
namespace amble::exporting {
namespace {

constexpr std::string_view sine_text =
    R"(/* sin(2 pi x) for x from -1 to 1: into the quarter turns about 0, then a series. */
static float sine_of_turns(float x) {
  float s, y;
  if (x > 0.5f) x -= 1.0f;
  if (x < -0.5f) x += 1.0f;
  if (x > 0.25f) x = 0.5f - x;
  if (x < -0.25f) x = -0.5f - x;
  s = x * x;
  y = s * -15.0946426f;
  y = 42.0586939f + y;
  y = s * y;
  y = -76.7058598f + y;
  y = s * y;
  y = 81.6052493f + y;
  y = s * y;
  y = -41.3417022f + y;
  y = s * y;
  y = 6.28318531f + y;
  return x * y;
}

)";

constexpr std::string_view landing_text = R"(  for (i = 0; i < $P_LEGS; ++i) {
    const int touches = in->touch[i] > 0.5f;
    state->trigger[i] = touches && state->in_air[i] ? 1 : 0;
    state->in_air[i] = touches ? 0 : 1;
  }
)";

constexpr std::string_view oscillator_step = R"(void $p_init($p_state *state) {
  int i;
  for (i = 0; i < $P_OSCILLATORS; ++i) state->phase[i] = 0.0f;
$init}

void $p_step($p_state *state, const $p_sensors *in, $p_targets *targets) {
  int i;
  (void)in;
$landing  for (i = 0; i < $P_JOINTS; ++i) targets->angle_rad[i] = held_rad[i];
  for (i = 0; i < $P_OSCILLATORS; ++i) {
    const float *const own = oscillator[i];
    const float now = $now;
    const float turned = now + own[1];
    const float sine = sine_of_turns(turned >= 1.0f ? turned - 1.0f : turned);
    const float swing = own[0] * sine;
    const float target = own[2] + swing;
    const float next = now + (sine > 0.0f ? swing_turns : stance_turns);
    targets->angle_rad[joint_of[i]] = target < own[3] ? own[3] : own[4] < target ? own[4] : target;
    state->phase[i] = next >= 1.0f ? next - 1.0f : next;
  }
}

)";

constexpr std::string_view legs_init =
    R"(  for (i = 0; i < $P_LEGS; ++i) state->trigger[i] = state->in_air[i] = 0;
)";

}  // namespace

void add_oscillator_state(const OscillatorTables& tables, CText& text) {
  const std::string upper = upper_case(text.prefix());
  text.line("  float phase[{}_OSCILLATORS]; /* turns, from 0 to 1 */", upper);
  if (!tables.resets) return;
  text.line("  uint8_t trigger[{}_LEGS];  /* 1 in the tick in which a foot comes down */", upper);
  text.line("  uint8_t in_air[{}_LEGS];   /* 1 if the foot did not touch in the last tick */", upper);
}

void add_oscillators(const ControllerTables& tables, CText& text) {
  const auto& parts = std::get<OscillatorTables>(tables.parts);
  const std::string upper = upper_case(text.prefix());
  std::vector<std::string> joints, legs, held;
  std::vector<std::vector<std::string>> numbers;
  for (const OscillatorTables::Oscillator& one : parts.oscillators) {
    joints.push_back(std::to_string(one.joint));
    legs.push_back(std::to_string(tables.joints[to_index(one.joint)].leg));
    numbers.push_back({c_float(one.amplitude_rad), c_float(one.phase_turns), c_float(one.offset_rad),
                       c_float(one.lower_rad), c_float(one.upper_rad)});
  }
  for (const CommandedJoint& joint : tables.joints)
    held.push_back(c_float(static_cast<float>(joint.lower_rad)));
  text.block(c_rounding);
  text.line("/* Turns in a tick where the sine is positive, and where it is not. */");
  text.line("static const float swing_turns = {}, stance_turns = {};", c_float(parts.swing_turns),
            c_float(parts.stance_turns));
  text.line("/* By oscillator: amplitude (rad), phase shift (turns), offset and the joint's range (rad). */");
  text.array(fmt::format("static const float oscillator[{}_OSCILLATORS][5]", upper), numbers);
  text.array(fmt::format("static const int16_t joint_of[{}_OSCILLATORS]", upper), joints);
  if (parts.resets) text.array(fmt::format("static const int16_t leg_of[{}_OSCILLATORS]", upper), legs);
  text.line("/* Where joints are that have no oscillator. */");
  text.array(fmt::format("static const float held_rad[{}_JOINTS]", upper), held);
  text.line("");
  text.block(sine_text);
  std::string step = replaced(oscillator_step, "$landing", parts.resets ? landing_text : "");
  step = replaced(step, "$init", parts.resets ? legs_init : "");
  text.block(replaced(
      step, "$now", parts.resets ? "state->trigger[leg_of[i]] ? 0.0f : state->phase[i]" : "state->phase[i]"));
}

}  // namespace amble::exporting
