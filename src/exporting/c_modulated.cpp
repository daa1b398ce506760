#include <algorithm>

#include "amble/core/index.hpp"
#include "amble/exporting/c_neural_text.hpp"
#include "amble/exporting/c_parts.hpp"

/// controllers::ModulatedSupgBatch in C, operation by operation.
namespace amble::exporting {
namespace {

constexpr std::string_view helpers =
    R"(static float within_one(float s) {
  const float above = s > -1.0f ? s : -1.0f;
  return above < 1.0f ? above : 1.0f;
}

/* About +- 1 over a reading's range; where it is not finite, the one before. */
static float sensed_as(float s, float before) {
  return s - s == 0.0f ? within_one(s) : before;
}

)";

constexpr std::string_view rate_text = R"(/* By how much a leg's timer grows: a tick times 2^rho. */
static int32_t growth($from, int leg) {
$sum  rho = within_one(rho);
  power = 1.52527338e-05f;
  power = power * rho + 0.000154035304f;
  power = power * rho + 0.00133335581f;
  power = power * rho + 0.00961812911f;
  power = power * rho + 0.0555041087f;
  power = power * rho + 0.240226507f;
  power = power * rho + 0.693147181f;
  power = power * rho + 1.0f;
  power = power * (float)tick_parts;
  return (int32_t)(power + 0.5f);
}

)";

constexpr std::string_view sensed_sum = R"(  float rho = 0.0f, power, part;
  int s;
  for (s = 0; s < sensor_count; ++s) {
    part = rate[leg][s] * sensed[s];
    rho = rho + part;
  }
)";

constexpr std::string_view load_text = R"(/* What a foot's load leaves of that growth. */
static int32_t held(int32_t grown, int32_t timer, float load) {
  float part = load_feedback * load;
  part = part * READ_TARGET(&cosine[timer < 0 ? 0 : timer >> tick_bits]);
  part = part * (float)tick_parts;
  grown -= (int32_t)part;
  return grown < 0 ? 0 : grown > 2 * tick_parts ? 2 * tick_parts : grown;
}

)";

constexpr std::string_view timer_text = R"(/* The shorter way round to start, or a share of it. */
static int32_t pulled(int32_t timer) {
  int32_t way = start - timer;
  if (reset_share == 0) return timer;
  if (timer < 0) return start;
  if (2 * (int64_t)way <= -(int64_t)period) way += period;
  timer += (int32_t)((int64_t)way * reset_share / 32768);
  return timer >= period ? timer - period : timer;
}

/* Advances the timer of a leg by one tick; returns what it would be without a jump. */
static int32_t update_timer($p_state *state, int leg, int touching, int32_t grown) {
  const int started = state->wait[leg] < 0, begins = state->wait[leg] == 0;
  const int triggered = $triggered;
  int32_t before = state->timer[leg], continued = stopped, next = stopped;
  if (begins && starts_at_once) before = first_timer[leg];
  if (before != stopped) {
    const int32_t sum = before + grown;
    continued = sum < period ? sum : period;
    next = sum < period ? sum : wraps ? sum - period : end_of_cycle;
  }
  if (begins && starts_at_once) continued = next;
  if (begins && !starts_at_once) next = first_timer[leg];
  if (triggered) next = pulled(next);
  state->timer[leg] = next;
  state->trigger[leg] = triggered ? 1 : 0;
  if (!started) --state->wait[leg];
  if (triggered)
    state->rests[leg] = refractory;
  else if (state->rests[leg] > 0)
    --state->rests[leg];
  if (touching)
    state->airborne[leg] = 0;
  else if (state->airborne[leg] < airborne_needed)
    ++state->airborne[leg];
  return continued;
}

static float between(const float *entry, float share) {
  const float a = READ_TARGET(entry), b = READ_TARGET(entry + 1);
  const float part = share * (b - a);
  return a + part;
}

static float target($owner_int joint, int32_t timer, const float *sensed) {
  const int32_t entry = timer < 0 ? 0 : (timer >> tick_bits) + 1;
  const float share = timer < 0 ? 0.0f : (float)(timer & (tick_parts - 1)) * (1.0f / (float)tick_parts);
  float y = between(&pattern[joint][entry], share);
$gains  return limited($y, joint);
}

)";

constexpr std::string_view gains_text = R"(  int s;
  for (s = 0; s < sensor_count; ++s) {
    const float shift = between(&gain[s][joint][entry], share) * sensed[s];
    y = y + shift;
  }
)";

constexpr std::string_view weight_text = R"(/* How much of the pattern at a level a reading takes. */
static float weight_of_level(float s, float level) {
  const float twice = s + s, away = twice - (level + level);
  const float near = 1.0f - (away < 0.0f ? -away : away);
  return near > 0.0f ? near : 0.0f;
}

)";

constexpr std::string_view readings_text = R"(  int s, l;
  for (s = 0; s < sensor_count; ++s)
    for (l = 0; l < level_count; ++l) {
      const float part = between(&gain[s * level_count + l][joint][entry], share);
      const float shift = part * weight_of_level(sensed[s], reading_level[l]);
      y = y + shift;
    }
)";

constexpr std::string_view step_text =
    R"(void $p_step($p_state *state, const $p_sensors *in, $p_targets *targets) {
  float (*const sensed)[sensor_count + 1] = state->sensed;
  int32_t continued[$P_LEGS];
  int leg, joint;
  (void)in;
$heading$contacts  for (leg = 0; leg < $P_LEGS; ++leg) {
    sense($statein, leg, sensed[leg]);
    continued[leg] = update_timer(state, leg, $touching, $grown);
  }
  for (joint = 0; joint < $P_JOINTS; ++joint) {
    leg = leg_of_joint[joint]; /* -1: a joint of no leg, which is held */
    if (leg < 0) {
      targets->angle_rad[joint] = READ_TARGET(&pattern[joint][0]);
      continue;
    }
$target  }
$end}
)";

constexpr std::string_view plain_target =
    "    targets->angle_rad[joint] = target($ownerjoint, state->timer[leg], sensed[leg]);\n";

constexpr std::string_view smoothed_target = R"(    {
      const int jumped = continued[leg] != state->timer[leg];
      const float on_rad = target($ownerjoint, continued[leg], sensed[leg]);
      const float at_rad = jumped ? target($ownerjoint, state->timer[leg], sensed[leg]) : on_rad;
$first      targets->angle_rad[joint] = smoothed(state, joint, on_rad, at_rad, jumped);
    }
)";

constexpr std::string_view first_stages = R"(      int stage;
      if (!state->begun)
        for (stage = 0; stage < filter_order; ++stage) state->stage_rad[stage][joint] = at_rad;
)";

constexpr std::string_view init_text = R"(void $p_init($p_state *state) {
  int leg, sensor$variables;
  for (leg = 0; leg < $P_LEGS; ++leg) {
    state->timer[leg] = stopped;
    state->airborne[leg] = 0;
    state->wait[leg] = wait_ticks[leg];
    state->trigger[leg] = 0;
    state->rests[leg] = 0;
    for (sensor = 0; sensor <= sensor_count; ++sensor) state->sensed[leg][sensor] = 0.0f;
  }
$rest}

)";

void add_sense(const SupgTables::Modulation& modulation, bool commands, CText& text) {
  text.line("/* What a leg senses. */");
  text.line("static void sense({1}const {0}_sensors *in, int leg, float *sensed) {{", text.prefix(),
            commands ? fmt::format("const {}_state *state, ", text.prefix()) : std::string());
  if (modulation.sensor_count() > 0 || modulation.load_feedback > 0.0f) text.line("  float product;");
  text.line("  switch (leg) {{");
  for (std::size_t leg = 0; leg < modulation.sensors.size(); ++leg) {
    text.line("    case {}:", leg);
    std::vector<controllers::LegSensor> sensors = modulation.sensors[leg];
    if (modulation.load_feedback > 0.0f) sensors.push_back(modulation.loads[leg]);
    for (std::size_t s = 0; s < sensors.size(); ++s) {
      const controllers::LegSensor& sensor = sensors[s];
      if (!sensor.is_there) {
        text.line("      sensed[{}] = 0.0f;", s);
        continue;
      }
      text.line("      product = {} * {};", c_sensor_member(sensor.sensor), c_float(sensor.gain));
      text.line("      sensed[{0}] = sensed_as(product - {1}, sensed[{0}]);", s, c_float(sensor.shift));
    }
    text.line("      break;");
  }
  text.line("    default:");
  text.line("      break;");
  text.line("  }}");
  text.line("  (void)in, (void)sensed{};", commands ? ", (void)state" : "");
  text.line("}}");
  text.line("");
}

void add_gains(const SupgTables::Modulation& modulation, std::size_t joints, std::size_t entries,
               CText& text) {
  text.line("/* What each sensor shifts each joint's targets by {}, entry by entry. */",
            modulation.by_reading ? "at each level" : "where it says 1");
  text.line("static const float gain[{}][{}][{}] IN_FLASH = {{", modulation.gains_rad.size(), joints,
            entries);
  for (const auto& channel : modulation.gains_rad) {
    text.line("  {{");
    for (const auto& joint : channel) {
      std::string row;
      for (const float value : joint) row += (row.empty() ? "" : ", ") + c_float(value);
      text.line("    {{{}}},", joint.empty() ? "0" : row);
    }
    text.line("  }},");
  }
  text.line("}};");
}

void add_levels(CText& text) {
  std::vector<std::string> levels(controllers::reading_levels.size());
  std::ranges::transform(controllers::reading_levels, levels.begin(), c_float);
  text.line("enum {{ level_count = {} }};", levels.size());
  text.array("static const float reading_level[level_count]", levels);
  text.line("");
  text.block(weight_text);
}

void add_rates(const SupgTables::Modulation& modulation, CText& text) {
  std::vector<std::vector<std::string>> rates;
  for (const auto& leg : modulation.rates) {
    auto& row = rates.emplace_back();
    for (const float rate : leg) row.push_back(c_float(rate));
  }
  text.array(fmt::format("static const float rate[{}_LEGS][sensor_count]", upper_case(text.prefix())), rates);
}

void add_load_feedback(const SupgTables::Modulation& modulation, CText& text) {
  std::vector<std::string> cosines(modulation.cosines.size());
  std::ranges::transform(modulation.cosines, cosines.begin(), c_float);
  text.line("/* How a foot's load pulls its leg's timer. */");
  text.line("static const float load_feedback = {};", c_float(modulation.load_feedback));
  text.array(fmt::format("static const float cosine[{}] IN_FLASH", cosines.size()), cosines);
}

/// By how much a leg's timer grows, as an expression of C.
std::string c_growth(const SupgTables::Modulation& modulation) {
  std::string grown = modulation.rates_on ? "growth(sensed[leg], leg)" : "tick_parts";
  if (modulation.load_feedback <= 0.0f) return grown;
  return "held(" + grown + ", state->timer[leg], sensed[leg][sensor_count])";
}

void add_constants(const SupgTables& supg, CText& text) {
  const SupgTables::Modulation& modulation = *supg.modulation;
  const std::string upper = upper_case(text.prefix());
  text.line("/* Timers count in 2^-{} ticks. */", controllers::parts_bits);
  text.line("enum {{ tick_bits = {}, stopped = -1, starts_at_once = {}, wraps = {}, sensor_count = {} }};",
            controllers::parts_bits, modulation.starts_at_once ? 1 : 0, supg.end_of_cycle == 0 ? 1 : 0,
            modulation.sensor_count());
  const auto parts = [](int ticks) { return static_cast<std::int64_t>(ticks) * controllers::parts_per_tick; };
  text.line("static const int32_t tick_parts = {}, period = {}, start = {}, end_of_cycle = {};",
            controllers::parts_per_tick, parts(supg.period_ticks), parts(supg.start_tick),
            supg.end_of_cycle < 0 ? -1 : parts(supg.end_of_cycle));
  text.line("static const int32_t airborne_needed = {}, reset_share = {}, refractory = {};",
            supg.airborne_ticks_needed, modulation.reset_share, modulation.refractory_ticks);
  std::vector<std::string> waits, firsts;
  for (const SupgTables::Leg& leg : supg.legs) {
    waits.push_back(std::to_string(leg.wait_ticks));
    firsts.push_back(
        std::to_string(modulation.starts_at_once ? parts(leg.offset_ticks) : parts(supg.start_tick)));
  }
  text.array(fmt::format("static const int32_t wait_ticks[{}_LEGS]", upper), waits);
  text.array(fmt::format("static const int32_t first_timer[{}_LEGS]", upper), firsts);
}

/// What a tick does to a timer, and the target at one.
void add_timers(const SupgTables& supg, const std::string& state, CText& text) {
  const SupgTables::Modulation& modulation = *supg.modulation;
  std::string timers = replaced(timer_text, "$triggered",
                                supg.is_triggered() ? "started && touching && state->rests[leg] == 0 && "
                                                      "state->airborne[leg] >= airborne_needed"
                                                    : "0");
  timers = replaced(timers, "$owner_", supg.mixed ? state + ", " : "");
  timers = replaced(timers, "$y", supg.mixed ? "reshaped(state, joint, y)" : "y");
  text.block(replaced(timers, "$gains",
                      !modulation.shapes()    ? "  (void)sensed;\n"
                      : modulation.by_reading ? readings_text
                                              : gains_text));
}

}  // namespace

std::string c_sensor_member(const substrate::Sensor& sensor, std::string_view state) {
  using Kind = substrate::Sensor::Kind;
  switch (sensor.kind) {
    case Kind::angle:
      return fmt::format("in->angle_rad[{}]", sensor.index);
    case Kind::touch:
      return fmt::format("in->touch[{}]", sensor.index);
    case Kind::load:
      return fmt::format("in->load_n[{}]", sensor.index);
    case Kind::speed:
      return fmt::format("in->speed_rad_s[{}]", sensor.index);
    case Kind::torque:
      return fmt::format("in->torque_nm[{}]", sensor.index);
    case Kind::roll:
      return "in->roll_rad";
    case Kind::pitch:
      return "in->pitch_rad";
    case Kind::yaw:
      return "in->yaw_rad";
    case Kind::yaw_rate:
      return "in->yaw_rate_rad_s";
    case Kind::command_speed:
      return fmt::format("{}->command_speed_m_s", state);
    case Kind::command_turn:
      return fmt::format("{}->command_turn_rad_s", state);
    case Kind::command_stop:
      return fmt::format("{}->command_stop", state);
    case Kind::heading_error:
      return fmt::format("{}->heading_error_rad", state);
    case Kind::sine:
      break;
  }
  return "0.0f";
}

void add_modulated_state(const SupgTables& tables, CText& text) {
  const std::string upper = upper_case(text.prefix());
  text.line("  int32_t timer[{}_LEGS];    /* in 2^-{} ticks; -1: stopped */", upper, controllers::parts_bits);
  text.line("  int32_t airborne[{}_LEGS]; /* ticks off the ground, as far as they matter */", upper);
  text.line("  int32_t wait[{}_LEGS];     /* ticks before the first start; -1 once it was */", upper);
  text.line("  int32_t rests[{}_LEGS];    /* ticks in which there is no other trigger */", upper);
  text.line("  uint8_t trigger[{}_LEGS];  /* 1 in the tick of a trigger */", upper);
  text.line("  float sensed[{}_LEGS][{}]; /* the last finite readings */", upper,
            tables.modulation->sensor_count() + 1);
  if (tables.mixed) add_mixed_state(*tables.mixed, text);
  if (tables.contact) add_contact_state(*tables.contact, text);
  if (!tables.seam) return;
  add_seam_state(*tables.seam, text);
  if (tables.seam->filter_order > 0) text.line("  uint8_t begun;");
}

void add_modulated(const ControllerTables& tables, CText& text) {
  const auto& supg = std::get<SupgTables>(tables.parts);
  const SupgTables::Modulation& modulation = *supg.modulation;
  add_constants(supg, text);
  const std::size_t entries = to_index(supg.period_ticks + 3);
  if (modulation.shapes()) add_gains(modulation, tables.joints.size(), entries, text);
  if (modulation.rates_on) add_rates(modulation, text);
  if (modulation.load_feedback > 0.0f) add_load_feedback(modulation, text);
  add_limits(supg.limits_rad, text);
  text.line("");
  if (modulation.sensor_count() > 0 || modulation.load_feedback > 0.0f || supg.mixed) text.block(helpers);
  if (modulation.by_reading && modulation.shapes()) add_levels(text);
  add_commands(tables, text);
  add_sense(modulation, tables.reads_commands(), text);
  if (supg.mixed) add_mixed(supg, text);
  const std::string state = fmt::format("const {}_state *state", text.prefix());
  if (supg.mixed)
    text.block(replaced(replaced(rate_text, "$from", state), "$sum",
                        "  float rho, power;\n" + c_mixed_growth(*supg.mixed)));
  else if (modulation.rates_on)
    text.block(replaced(replaced(rate_text, "$from", "const float *sensed"), "$sum", sensed_sum));
  if (modulation.load_feedback > 0.0f) text.block(load_text);
  const bool triggered = supg.is_triggered();
  add_timers(supg, state, text);
  if (supg.seam) add_smoothing(*supg.seam, text);
  const bool filters = supg.seam && supg.seam->filter_order > 0;
  std::string rest = supg.seam && supg.seam->residual_decay > 0.0f ? c_residual_init() : "";
  if (filters) rest += "  state->begun = 0;\n";
  if (supg.contact) rest += c_contact_init(*supg.contact);
  rest += c_command_init(tables);
  if (supg.mixed) rest += c_mixed_init(*supg.mixed);
  text.block(replaced(replaced(init_text, "$rest", rest), "$variables",
                      rest.find("joint") != std::string::npos ? ", joint" : ""));
  std::string step = replaced(step_text, "$target",
                              supg.seam ? replaced(smoothed_target, "$first", filters ? first_stages : "")
                                        : std::string(plain_target));
  step = replaced(step, "$statein", tables.reads_commands() ? "state, in" : "in");
  step = replaced(step, "$ownerjoint", supg.mixed ? "state, joint" : "joint");
  step = replaced(step, "$heading",
                  c_command_step(tables, "in") + (supg.mixed ? "  run_net(state, in);\n" : ""));
  step = replaced(step, "$contacts", supg.contact ? "  update_contacts(state, in);\n" : "");
  step = replaced(step, "$touching",
                  !triggered     ? "0"
                  : supg.contact ? "state->contact[leg]"
                                 : "in->touch[leg] > 0.5f");
  step = replaced(step, "$grown", supg.mixed ? "growth(state, leg)" : c_growth(modulation));
  std::string end = filters ? "  state->begun = 1;\n" : supg.seam ? "" : "  (void)continued;\n";
  if (supg.mixed) end += c_mixed_end(*supg.mixed);
  text.block(replaced(step, "$end", end + (supg.contact ? c_contact_end(*supg.contact) : "")));
}

}  // namespace amble::exporting
