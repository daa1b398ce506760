#include <algorithm>

#include "amble/core/index.hpp"
#include "amble/exporting/c_parts.hpp"

/// controllers::ContactEstimate in C, operation by operation.
namespace amble::exporting {
namespace {

using controllers::ContactSource;

constexpr std::string_view of_joints =
    R"(/* What stands for a touch of each foot: a contact begins above one number and ends at another. */
static void update_contacts($p_state *state, const $p_sensors *in) {
  int leg, i;
  for (leg = 0; leg < $P_LEGS; ++leg) {
    const float limit = state->contact[leg] ? contact_ends : contact_begins;
    float number = 0.0f;
    for (i = 0; i < contact_joints && contact_joint[leg][i] >= 0; ++i) {
      float x = $x;
      if (x < 0.0f) x = -x;
      if (x > number) number = x;
    }
    state->contact[leg] = $knownnumber > limit;
  }
}

)";

constexpr std::string_view of_shocks = R"(static float size(float x) { return x < 0.0f ? -x : x; }

/* What stands for a touch: a shock is put down to the leg whose last is longest ago. */
static void update_contacts($p_state *state, const $p_sensors *in) {
  const float roll_change = in->roll_rad - state->roll_rad, pitch_change = in->pitch_rad - state->pitch_rad;
  const float roll_kick = size(roll_change - state->roll_change), pitch_kick = size(pitch_change - state->pitch_change);
  const float kick = roll_kick + pitch_kick, number = kick * per_tick_squared;
  int leg, longest = 0;
  state->roll_rad = in->roll_rad;
  state->pitch_rad = in->pitch_rad;
  state->roll_change = roll_change;
  state->pitch_change = pitch_change;
  for (leg = 0; leg < $P_LEGS; ++leg) {
    if (state->since[leg] < 0x40000000) ++state->since[leg];
    if (state->since[leg] > state->since[longest]) longest = leg;
    state->contact[leg] = 0;
  }
  if (state->seen < 2) {
    ++state->seen;
  } else if (number > contact_begins) {
    state->contact[longest] = 1;
    state->since[longest] = 0;
  }
}

)";

constexpr std::string_view init_all = "  for (leg = 0; leg < $P_LEGS; ++leg) state->contact[leg] = 0;\n";
constexpr std::string_view init_shocks = R"(  for (leg = 0; leg < $P_LEGS; ++leg) state->since[leg] = 0;
  state->roll_rad = state->pitch_rad = state->roll_change = state->pitch_change = 0.0f;
  state->seen = 0;
)";

}  // namespace

void add_contact_state(const SupgTables::Contact& contact, CText& text) {
  const std::string upper = upper_case(text.prefix());
  text.line("  uint8_t contact[{}_LEGS]; /* what stands for touches */", upper);
  if (contact.source == ContactSource::tracking)
    text.line("  float last_rad[{}_JOINTS]; /* targets */", upper);
  if (contact.source == ContactSource::shock) {
    text.line("  int32_t since[{}_LEGS]; /* ticks since the last */", upper);
    text.line("  float roll_rad, pitch_rad, roll_change, pitch_change;");
  }
  if (contact.source != ContactSource::torque)
    text.line("  uint8_t seen; /* ticks, as far as they matter */");
}

void add_contacts(const SupgTables::Contact& contact, CText& text) {
  text.line("static const float contact_begins = {};", c_float(contact.begins));
  if (contact.source == ContactSource::shock) {
    text.line("static const float per_tick_squared = {};", c_float(contact.per_tick_squared));
    text.line("");
    text.block(of_shocks);
    return;
  }
  text.line("static const float contact_ends = {};", c_float(contact.ends));
  std::size_t most = 1;
  for (const auto& leg : contact.joints) most = std::max(most, leg.size());
  std::vector<std::vector<std::string>> rows;
  for (const auto& leg : contact.joints) {
    auto& row = rows.emplace_back();
    for (std::size_t i = 0; i < most; ++i) row.push_back(std::to_string(i < leg.size() ? leg[i] : -1));
  }
  text.line("enum {{ contact_joints = {} }};", most);
  text.array(
      fmt::format("static const int16_t contact_joint[{}_LEGS][contact_joints]", upper_case(text.prefix())),
      rows);
  text.line("");
  const bool tracking = contact.source == ContactSource::tracking;
  const std::string x = tracking
                            ? "state->last_rad[contact_joint[leg][i]] - in->angle_rad[contact_joint[leg][i]]"
                            : "in->torque_nm[contact_joint[leg][i]]";
  text.block(replaced(replaced(of_joints, "$x", x), "$known", tracking ? "state->seen && " : ""));
}

std::string c_contact_init(const SupgTables::Contact& contact) {
  std::string text(init_all);
  if (contact.source == ContactSource::shock) text += init_shocks;
  if (contact.source == ContactSource::tracking)
    text +=
        "  for (joint = 0; joint < $P_JOINTS; ++joint) state->last_rad[joint] = 0.0f;\n  state->seen = 0;\n";
  return text;
}

std::string c_contact_end(const SupgTables::Contact& contact) {
  if (contact.source != ContactSource::tracking) return {};
  return "  for (joint = 0; joint < $P_JOINTS; ++joint) state->last_rad[joint] = targets->angle_rad[joint];\n"
         "  state->seen = 1;\n";
}

}  // namespace amble::exporting
