#include "amble/core/check.hpp"
#include "amble/exporting/c_neural_text.hpp"
#include "amble/exporting/c_parts.hpp"

/// Steering by hand, in C: controllers::DifferentialArchitecture operation by operation, around any
/// controller.
namespace amble::exporting {
namespace {

constexpr std::string_view steering_text = R"(static float held_within(float low, float number, float high) {
  return number < low ? low : high < number ? high : number;
}

/* What swings on the left, on the right, between them, and what does not swing are multiplied by it. */
static void update_factors($p_state *state) {
  const float stops = $stops;
  const float turn = $turn;
  const float speed = $speed;
  const float left_out = 1.0f - turn_gain * (turn < 0.0f ? -turn : turn);
  const float inner = speed * (-1.0f < left_out ? left_out : -1.0f);
  const float left = speed < 0.0f ? -turn : turn;
  const float wanted[4] = {left > 0.0f ? inner : speed, left < 0.0f ? inner : speed, speed, stops > 0.5f ? 0.0f : 1.0f};
  const float most = state->steered ? most_change : 2.0f;
  int i;
  state->steered = 1;
  for (i = 0; i < 4; ++i) state->factor[i] = held_within(state->factor[i] - most, wanted[i], state->factor[i] + most);
}

void $p_init($p_state *state) {
  int i;
  $p_walker_init(state);
$init  for (i = 0; i < 4; ++i) state->factor[i] = 1.0f;
  state->steered = 0;
}

void $p_step($p_state *state, const $p_sensors *sensors, $p_targets *targets) {
  int i;
$step  $p_walker_step(state, sensors, targets);
  update_factors(state);
  for (i = 0; i < (int)(sizeof steered_joint / sizeof steered_joint[0]); ++i) {
    const float factor = state->factor[factor_of[i]];
    float *const target = &targets->angle_rad[steered_joint[i]];
    const float scaled = swing[i][0] + (*target - swing[i][0]) * factor;
    if (factor != 1.0f) *target = held_within(swing[i][1], scaled, swing[i][2]);
  }
}

)";

}  // namespace

void add_differential_state(const ControllerTables& tables, CText& text) {
  if (!tables.differential) return;
  text.line("  float factor[4]; /* left, right, between, others */");
  text.line("  uint8_t steered; /* 0 before the first step */");
}

ControllerTables walker_tables(const ControllerTables& tables) {
  ControllerTables walker = tables;
  walker.differential.reset();
  return walker.reads_commands() ? tables : walker;
}

std::string c_walker_text(std::string text, const std::string& prefix) {
  for (const char* const function : {"_init(", "_step("}) {
    const std::string was = "void " + prefix + function;
    const std::size_t at = text.find(was);
    AMBLE_CHECK(at != std::string::npos, "each controller has both functions");
    text.replace(at, was.size(), "static void " + prefix + "_walker" + function);
  }
  return text;
}

void add_differential(const ControllerTables& tables, CText& text) {
  const Differential& steering = *tables.differential;
  const bool own = !walker_tables(tables).differential, heading = steering.heading_gain > 0.0f,
             speeds = steering.full_speed_m_s > 0.0f;
  std::vector<std::string> joints, factors;
  std::vector<std::vector<std::string>> swing;
  for (const Differential::Steered& joint : steering.joints) {
    joints.push_back(std::to_string(joint.joint));
    factors.push_back(std::to_string(joint.factor));
    swing.push_back({c_float(joint.centre_rad), c_float(joint.lower_rad), c_float(joint.upper_rad)});
  }
  text.block(c_rounding);  // what it is around may compute nothing
  if (own) add_commands(tables, text);
  text.line("static const float turn_gain = {}, most_change = {};", c_float(steering.turn_gain),
            c_float(steering.most_change));
  text.line("/* Joints that are steered: which factor; centre and range, rad. */");
  text.array("static const int16_t steered_joint[]", joints);
  text.array("static const uint8_t factor_of[]", factors);
  text.array("static const float swing[][3]", swing);
  text.line("");
  std::string steps = replaced(steering_text, "$stops", speeds ? "state->command_stop" : "0.0f");
  steps = replaced(steps, "$turn",
                   heading ? fmt::format("state->command_turn_rad_s + {} * state->heading_error_rad",
                                         c_float(steering.heading_gain))
                           : "state->command_turn_rad_s");
  steps = replaced(
      steps, "$speed",
      speeds ? fmt::format("stops > 0.5f ? 0.0f : held_within(-1.0f, state->command_speed_m_s / {}, 1.0f)",
                           c_float(steering.full_speed_m_s))
             : "1.0f");
  steps = replaced(steps, "$init", own ? c_command_init(tables) : "");
  text.block(replaced(steps, "$step", own ? c_command_step(tables, "sensors") : ""));
}

}  // namespace amble::exporting
