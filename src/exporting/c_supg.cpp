#include <algorithm>

#include "amble/core/index.hpp"
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
  int leg;
  for (leg = 0; leg < $P_LEGS; ++leg) {
    state->timer[leg] = stopped;
    state->airborne[leg] = 0;
    state->wait[leg] = wait_ticks[leg];
    state->trigger[leg] = 0;
  }
}

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

void $p_step($p_state *state, const $p_sensors *sensors, $p_targets *targets) {
  int leg, joint;
  for (leg = 0; leg < $P_LEGS; ++leg) update_timer(state, leg, $touching);
  for (joint = 0; joint < $P_JOINTS; ++joint) {
    leg = leg_of_joint[joint]; /* -1: a joint of no leg, which is held */
    targets->angle$unit[joint] = READ_TARGET(&pattern[joint][leg < 0 ? 0 : state->timer[leg] + 1]);
  }
$unread}
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

}  // namespace

void add_supg_state(const SupgTables& tables, CText& text) {
  const std::string type = timer_type(tables);
  text.line("  {} timer[{}_LEGS];    /* ticks; -1: stopped */", type, upper_case(text.prefix()));
  text.line("  {} airborne[{}_LEGS]; /* ticks off the ground, as far as they matter */", type,
            upper_case(text.prefix()));
  text.line("  {} wait[{}_LEGS];     /* ticks before the first start; -1 once it was */", type,
            upper_case(text.prefix()));
  text.line("  uint8_t trigger[{}_LEGS];  /* 1 in the tick of a trigger */", upper_case(text.prefix()));
}

void add_supg(const ControllerTables& tables, const CSourceOptions& options, CText& text) {
  const auto& supg = std::get<SupgTables>(tables.parts);
  const bool fixed = options.arithmetic == Arithmetic::fixed;
  const std::string type = timer_type(supg), upper = upper_case(options.prefix);
  std::size_t columns = 1;
  for (const auto& pattern : supg.targets_rad) columns = std::max(columns, pattern.size());
  std::vector<std::string> waits, firsts, legs;
  for (const SupgTables::Leg& leg : supg.legs) {
    waits.push_back(std::to_string(leg.wait_ticks));
    firsts.push_back(std::to_string(leg.first_timer));
  }
  for (const CommandedJoint& joint : tables.joints) legs.push_back(std::to_string(joint.leg));

  text.block(
      replaced(flash_of_avr, "READ_TARGET_FROM_FLASH", fixed ? "(int16_t)pgm_read_word" : "pgm_read_float"));
  text.line("/* Ticks of a cycle, of a timer that a trigger sets, and of what it becomes at the end. */");
  text.line("enum {{ period = {}, start_tick = {}, end_of_cycle = {}, stopped = -1 }};", supg.period_ticks,
            supg.start_tick, supg.end_of_cycle);
  const bool is_triggered = supg.is_triggered();
  text.line("/* {} */", is_triggered ? "Ticks off the ground after which a touch is a trigger."
                                     : "No touch is a trigger.");
  text.line("enum {{ airborne_needed = {} }};", supg.airborne_ticks_needed);
  text.array(fmt::format("static const {} wait_ticks[{}_LEGS]", type, upper), waits);
  text.array(fmt::format("static const {} first_timer[{}_LEGS]", type, upper), firsts);
  text.array(
      fmt::format("static const {} leg_of_joint[{}_JOINTS]", legs.size() > 127 ? "int16_t" : "int8_t", upper),
      legs);
  text.line("/* Targets of each joint by its leg's timer, from -1 on{}. */",
            fixed ? fmt::format(", in 2^-{} rad", fraction_bits(tables)) : std::string(", rad"));
  text.array(fmt::format("static const {} pattern[{}_JOINTS][{}] IN_FLASH", fixed ? "int16_t" : "float",
                         upper, columns),
             pattern_rows(tables, supg, fixed));
  text.line("");
  text.block(init);
  std::string step = replaced(update, "$timer", type);
  step = replaced(step, "$triggered",
                  is_triggered ? "started && touching && state->airborne[leg] >= airborne_needed" : "0");
  step = replaced(step, "$touching",
                  !is_triggered ? "0"
                  : fixed       ? "sensors->touch[leg] > 0"
                                : "sensors->touch[leg] > 0.5f");
  step = replaced(step, "$unread", is_triggered ? "" : "  (void)sensors; /* no touch is a trigger */\n");
  text.block(replaced(step, "$unit", fixed ? "" : "_rad"));
}

}  // namespace amble::exporting
