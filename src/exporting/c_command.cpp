#include "amble/exporting/c_parts.hpp"

/// What a robot is told, in C: trial::Senses operation by operation.
namespace amble::exporting {
namespace {

constexpr std::string_view set_text =
    R"(static float within_100(float number) {
  return number < -100.0f ? -100.0f : number > 100.0f ? 100.0f : number;
}

void $p_set_command($p_state *state, float speed_m_s, float turn_rad_s) {
  if (speed_m_s - speed_m_s != 0.0f || turn_rad_s - turn_rad_s != 0.0f) return;
  state->command_speed_m_s = within_100(speed_m_s);
  state->command_turn_rad_s = within_100(turn_rad_s);
  state->command_stop = state->command_speed_m_s == 0.0f && state->command_turn_rad_s == 0.0f ? 1.0f : 0.0f;
}

)";

constexpr std::string_view heading_text =
    R"(/* Also of a yaw that is counted on from turn to turn; one beyond a million is none. */
static float within_half_a_turn(float angle_rad) {
  const float turns = angle_rad / 6.28318531f;
  if (!(angle_rad > 3.14159265f || angle_rad < -3.14159265f)) return angle_rad;
  if (!(angle_rad > -1e6f && angle_rad < 1e6f)) return angle_rad - angle_rad;
  return angle_rad - 6.28318531f * (float)(int32_t)(turns > 0.0f ? turns + 0.5f : turns - 0.5f);
}

/* How far the heading that the commanded turns have led to is to the left of the robot's. */
static void update_heading($p_state *state, const $p_sensors *in) {
  const float turned_rad = state->command_turn_rad_s * $tick;
  float error_rad;
  if (!state->faces && in->yaw_rad - in->yaw_rad == 0.0f) { /* the first finite one */
    state->faces = 1;
    state->wanted_yaw_rad = within_half_a_turn(in->yaw_rad);
  }
  error_rad = within_half_a_turn(state->wanted_yaw_rad - in->yaw_rad);
  if (error_rad - error_rad == 0.0f) state->heading_error_rad = error_rad; /* else the yaw is lost: as it was */
$lead  state->wanted_yaw_rad = within_half_a_turn(state->wanted_yaw_rad + turned_rad);
}

)";

constexpr std::string_view lead_text =
    R"(  if (state->heading_error_rad > $most || state->heading_error_rad < -$most) { /* the robot turns less than told */
    state->heading_error_rad = state->heading_error_rad > 0.0f ? $most : -$most;
    state->wanted_yaw_rad = within_half_a_turn(in->yaw_rad + state->heading_error_rad);
  }
)";

/// update_heading() with its numbers.
std::string heading_source(const ControllerTables& tables) {
  const std::string lead = tables.heading_lead_rad > 0.0f
                               ? replaced(lead_text, "$most", c_float(tables.heading_lead_rad))
                               : std::string();
  return replaced(replaced(heading_text, "$lead", lead), "$tick",
                  c_float(static_cast<float>(tables.timestep_s)));
}

}  // namespace

void add_command_state(const ControllerTables& tables, CText& text) {
  if (!tables.reads_commands()) return;
  text.line("  float command_speed_m_s, command_turn_rad_s, command_stop; /* what it is told */");
  if (!tables.reads_heading_error()) return;
  text.line("  float wanted_yaw_rad, heading_error_rad;");
  text.line("  uint8_t faces;");
}

void add_commands(const ControllerTables& tables, CText& text) {
  if (!tables.reads_commands()) return;
  text.block(set_text);
  if (tables.reads_heading_error()) text.block(heading_source(tables));
}

std::string c_command_init(const ControllerTables& tables) {
  if (!tables.reads_commands()) return {};
  std::string text = "  $p_set_command(state, 0.0f, 0.0f);\n";
  if (tables.reads_heading_error())
    text += "  state->wanted_yaw_rad = state->heading_error_rad = 0.0f;\n  state->faces = 0;\n";
  return text;
}

std::string c_command_step(const ControllerTables& tables, const char* sensors) {
  return tables.reads_heading_error() ? fmt::format("  update_heading(state, {});\n", sensors)
                                      : std::string();
}

}  // namespace amble::exporting
