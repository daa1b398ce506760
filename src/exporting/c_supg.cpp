#include <algorithm>

#include "amble/core/error.hpp"
#include "amble/core/index.hpp"
#include "amble/exporting/c_neural_text.hpp"
#include "amble/exporting/c_parts.hpp"

namespace amble::exporting {
namespace {

/// The type of timers: signed, as −1 means stopped.
std::string timer_type(const SupgTables& tables) {
  // One more than the largest value is computed.
  const int largest = std::max(tables.period_ticks, tables.airborne_ticks_needed) + 1;
  return largest <= 0x7fff ? "int16_t" : "int32_t";
}

/// On an AVR constant arrays are in RAM unless they are marked, and then they are read by other instructions.
constexpr std::string_view flash_of_avr = R"(#ifdef __AVR__
#include <avr/pgmspace.h>
#define IN_FLASH PROGMEM
#define READ_TARGET(where) READ_TARGET_FROM_FLASH(where)
#else
#define IN_FLASH
#define READ_TARGET(where) (*(where))
#endif

)";

constexpr std::string_view init = R"(void $p_init($p_state *state) {
  int leg$variables;
  for (leg = 0; leg < $P_LEGS; ++leg) {
    state->timer[leg] = stopped;
    state->airborne[leg] = 0;
    state->wait[leg] = wait_ticks[leg];
    state->trigger[leg] = 0;
  }
$rest}

)";

constexpr std::string_view update = R"(/* Advances the timer of a leg by one tick. */
static void update_timer($p_state *state, int leg, int touching) {
  const int started = state->wait[leg] < 0, starts = state->wait[leg] == 0;
  const int triggered = $triggered;
  $timer next = state->timer[leg];
  if (next != stopped) next = ($timer)(next + 1 >= period ? end_of_cycle : next + 1);
  if (triggered) next = start_tick;
  if (starts) next = first_timer[leg];
  state->timer[leg] = next;
  state->trigger[leg] = triggered ? 1 : 0;
  if (!started) --state->wait[leg];
  if (touching)
    state->airborne[leg] = 0;
  else if (state->airborne[leg] < airborne_needed)
    ++state->airborne[leg];
}
)";

constexpr std::string_view plain_step = R"(
void $p_step($p_state *state, const $p_sensors *sensors, $p_targets *targets) {
  int leg, joint;
$contacts  for (leg = 0; leg < $P_LEGS; ++leg) update_timer(state, leg, $touching);
  for (joint = 0; joint < $P_JOINTS; ++joint) {
    leg = leg_of_joint[joint]; /* -1: a joint of no leg, which is held */
    targets->angle$unit[joint] = READ_TARGET(&pattern[joint][leg < 0 ? 0 : state->timer[leg] + 1]);
  }
$ends$unread}
)";

constexpr std::string_view smoothed_step = R"(
void $p_step($p_state *state, const $p_sensors *sensors, $p_targets *targets) {
  $timer continued[$P_LEGS];
  int leg, joint;
$contacts  for (leg = 0; leg < $P_LEGS; ++leg) {
    continued[leg] = continued_timer(state, leg);
    update_timer(state, leg, $touching);
  }
  for (joint = 0; joint < $P_JOINTS; ++joint) {
    leg = leg_of_joint[joint]; /* -1: a joint of no leg, which is held */
    targets->angle_rad[joint] =
        leg < 0 ? READ_TARGET(&pattern[joint][0])
                : smoothed(state, joint, READ_TARGET(&pattern[joint][continued[leg] + 1]),
                           READ_TARGET(&pattern[joint][state->timer[leg] + 1]), continued[leg] != state->timer[leg]);
  }
$ends$unread}
)";

std::vector<std::vector<std::string>> pattern_rows(const ControllerTables& tables, const SupgTables& supg,
                                                   bool fixed) {
  const int bits = fixed ? fraction_bits(tables) : 0;
  std::vector<std::vector<std::string>> rows;
  for (std::size_t j = 0; j < tables.joints.size(); ++j) {
    std::vector<std::string>& row = rows.emplace_back();
    for (const float target_rad : supg.targets_rad[j])
      row.push_back(fixed ? std::to_string(fixed_target(tables.joints[j], target_rad, bits))
                          : c_float(target_rad));
  }
  return rows;
}

void check_fixed(const SupgTables& supg) {
  if (supg.mixed)
    fail(
        ExitCode::bad_input,
        "--fixed: the controller is of kind mixed, whose neurons are exported in floating point alone: leave "
        "out --fixed");
  if (supg.contact)
    fail(ExitCode::bad_input,
         "--fixed: controller.supg.contact is exported in floating point alone: leave out --fixed");
  if (supg.modulation)
    fail(ExitCode::bad_input,
         "--fixed: controller.supg.modulation is exported in floating point alone: leave out --fixed");
  if (supg.seam)
    fail(ExitCode::bad_input,
         "--fixed: controller.supg.seam smooths targets in floating point: expected residual_s = 0 and "
         "filter_s = 0, or leave out --fixed");
}

void add_timer_constants(const SupgTables& supg, CText& text) {
  const std::string type = timer_type(supg), upper = upper_case(text.prefix());
  std::vector<std::string> waits, firsts;
  for (const SupgTables::Leg& leg : supg.legs) {
    waits.push_back(std::to_string(leg.wait_ticks));
    firsts.push_back(std::to_string(leg.first_timer));
  }
  text.line("/* Ticks of a cycle, of a timer that a trigger sets, and of what it becomes at the end. */");
  text.line("enum {{ period = {}, start_tick = {}, end_of_cycle = {}, stopped = -1 }};", supg.period_ticks,
            supg.start_tick, supg.end_of_cycle);
  text.line("/* {} */", supg.is_triggered() ? "Ticks off the ground after which a touch is a trigger."
                                            : "No touch is a trigger.");
  text.line("enum {{ airborne_needed = {} }};", supg.airborne_ticks_needed);
  text.array(fmt::format("static const {} wait_ticks[{}_LEGS]", type, upper), waits);
  text.array(fmt::format("static const {} first_timer[{}_LEGS]", type, upper), firsts);
}

void add_patterns(const ControllerTables& tables, const SupgTables& supg, bool fixed, CText& text) {
  const std::string upper = upper_case(text.prefix());
  std::size_t columns = 1;
  for (const auto& pattern : supg.targets_rad) columns = std::max(columns, pattern.size());
  std::vector<std::string> legs;
  for (const CommandedJoint& joint : tables.joints) legs.push_back(std::to_string(joint.leg));
  text.array(
      fmt::format("static const {} leg_of_joint[{}_JOINTS]", legs.size() > 127 ? "int16_t" : "int8_t", upper),
      legs);
  text.line("/* Targets of each joint by its leg's timer, from -1 on{}. */",
            fixed ? fmt::format(", in 2^-{} rad", fraction_bits(tables)) : std::string(", rad"));
  text.array(fmt::format("static const {} pattern[{}_JOINTS][{}] IN_FLASH", fixed ? "int16_t" : "float",
                         upper, columns),
             pattern_rows(tables, supg, fixed));
  text.line("");
}

void add_functions(const SupgTables& supg, bool fixed, CText& text) {
  const std::string type = timer_type(supg);
  const bool is_triggered = supg.is_triggered();
  if (supg.seam) add_seam(supg, type, text);
  const std::string rest =
      (supg.seam ? c_seam_init(*supg.seam) : "") + (supg.contact ? c_contact_init(*supg.contact) : "");
  const bool stages = supg.seam && supg.seam->filter_order > 0;
  const bool joints = rest.find("joint") != std::string::npos;
  text.block(replaced(replaced(init, "$rest", rest), "$variables",
                      stages   ? ", joint, stage"
                      : joints ? ", joint"
                               : ""));
  std::string step =
      replaced(std::string(update) + std::string(supg.seam ? smoothed_step : plain_step), "$timer", type);
  step = replaced(step, "$triggered",
                  is_triggered ? "started && touching && state->airborne[leg] >= airborne_needed" : "0");
  step = replaced(step, "$contacts", supg.contact ? "  update_contacts(state, sensors);\n" : "");
  step = replaced(step, "$ends", supg.contact ? c_contact_end(*supg.contact) : "");
  step = replaced(step, "$touching",
                  !is_triggered  ? "0"
                  : supg.contact ? "state->contact[leg]"
                  : fixed        ? "sensors->touch[leg] > 0"
                                 : "sensors->touch[leg] > 0.5f");
  step = replaced(step, "$unread", is_triggered ? "" : "  (void)sensors; /* no touch is a trigger */\n");
  text.block(replaced(step, "$unit", fixed ? "" : "_rad"));
}

}  // namespace

void add_supg_state(const SupgTables& tables, CText& text) {
  if (tables.modulation) return add_modulated_state(tables, text);
  const std::string type = timer_type(tables);
  text.line("  {} timer[{}_LEGS];    /* ticks; -1: stopped */", type, upper_case(text.prefix()));
  text.line("  {} airborne[{}_LEGS]; /* ticks off the ground, as far as they matter */", type,
            upper_case(text.prefix()));
  text.line("  {} wait[{}_LEGS];     /* ticks before the first start; -1 once it was */", type,
            upper_case(text.prefix()));
  text.line("  uint8_t trigger[{}_LEGS];  /* 1 in the tick of a trigger */", upper_case(text.prefix()));
  if (tables.seam) add_seam_state(*tables.seam, text);
  if (tables.contact) add_contact_state(*tables.contact, text);
}

void add_supg(const ControllerTables& tables, const CSourceOptions& options, CText& text) {
  const auto& supg = std::get<SupgTables>(tables.parts);
  const bool fixed = options.arithmetic == Arithmetic::fixed;
  if (fixed) check_fixed(supg);
  if (supg.seam || supg.modulation || supg.contact) text.block(c_rounding);
  text.block(
      replaced(flash_of_avr, "READ_TARGET_FROM_FLASH", fixed ? "(int16_t)pgm_read_word" : "pgm_read_float"));
  if (!supg.modulation) add_timer_constants(supg, text);
  add_patterns(tables, supg, fixed, text);
  if (supg.contact) add_contacts(*supg.contact, text);
  if (supg.modulation)
    add_modulated(tables, text);
  else
    add_functions(supg, fixed, text);
}

}  // namespace amble::exporting
