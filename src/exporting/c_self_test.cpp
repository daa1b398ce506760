#include <algorithm>
#include <array>

#include "amble/core/index.hpp"
#include "amble/exporting/c_parts.hpp"

namespace amble::exporting {
namespace {

/// One of a tick's lists of numbers, of all ticks, as literals.
std::vector<std::vector<std::string>> literals(const Trace& trace, std::vector<float> Trace::Tick::*values) {
  std::vector<std::vector<std::string>> rows;
  for (const Trace::Tick& tick : trace.ticks) {
    std::vector<std::string>& row = rows.emplace_back();
    for (const float value : tick.*values) row.push_back(c_float(value));
  }
  return rows;
}

/// Touches are 0 or 1.
std::vector<std::vector<std::string>> touches(const Trace& trace) {
  std::vector<std::vector<std::string>> rows;
  for (const Trace::Tick& tick : trace.ticks) {
    std::vector<std::string>& row = rows.emplace_back();
    for (const float touch : tick.touch) row.push_back(touch > 0.5f ? "1" : "0");
  }
  return rows;
}

std::vector<std::vector<std::string>> fixed_targets(const ControllerTables& tables, const Trace& trace) {
  const int bits = fraction_bits(tables);
  std::vector<std::vector<std::string>> rows;
  for (const Trace::Tick& tick : trace.ticks) {
    std::vector<std::string>& row = rows.emplace_back();
    for (std::size_t j = 0; j < tables.joints.size(); ++j)
      row.push_back(std::to_string(fixed_target(tables.joints[j], tick.target_rad[j], bits)));
  }
  return rows;
}

void add_vectors(const ControllerTables& tables, const Trace& trace, bool fixed, CText& text) {
  const std::string upper = upper_case(text.prefix());
  text.line("enum {{ test_ticks = {} }};", trace.ticks.size());
  if (tables.reads_touch())
    text.array(fmt::format("static const uint8_t test_touch[test_ticks][{}_LEGS]", upper), touches(trace));
  if (tables.reads_angles())
    text.array(fmt::format("static const float test_angle_rad[test_ticks][{}_JOINTS]", upper),
               literals(trace, &Trace::Tick::angle_rad));
  if (tables.reads_attitude())
    text.array("static const float test_attitude_rad[test_ticks][3]",
               literals(trace, &Trace::Tick::attitude_rad));
  if (tables.reads_speeds())
    text.array(fmt::format("static const float test_speed_rad_s[test_ticks][{}_JOINTS]", upper),
               literals(trace, &Trace::Tick::speed_rad_s));
  if (tables.reads_torques())
    text.array(fmt::format("static const float test_torque_nm[test_ticks][{}_JOINTS]", upper),
               literals(trace, &Trace::Tick::torque_nm));
  if (tables.reads_yaw_rate())
    text.array("static const float test_yaw_rate_rad_s[test_ticks][1]",
               literals(trace, &Trace::Tick::yaw_rate_rad_s));
  if (tables.reads_loads())
    text.array(fmt::format("static const float test_load_n[test_ticks][{}_LEGS]", upper),
               literals(trace, &Trace::Tick::load_n));
  if (tables.reads_commands())
    text.array("static const float test_command[test_ticks][2]", literals(trace, &Trace::Tick::command));
  if (fixed)
    text.array(fmt::format("static const int16_t test_target[test_ticks][{}_JOINTS]", upper),
               fixed_targets(tables, trace));
  else
    text.array(fmt::format("static const float test_target[test_ticks][{}_JOINTS]", upper),
               literals(trace, &Trace::Tick::target_rad));
}

/// The least and the greatest number that a target can be, as literals.
void add_ranges(const ControllerTables& tables, bool fixed, CText& text) {
  std::vector<std::vector<std::string>> rows;
  for (const CommandedJoint& joint : tables.joints) {
    const auto end = [&](double angle_rad) {
      const auto rounded = static_cast<float>(angle_rad);
      return fixed ? std::to_string(fixed_target(joint, rounded, fraction_bits(tables))) : c_float(rounded);
    };
    rows.push_back({end(joint.lower_rad), end(joint.upper_rad)});
  }
  text.array(fmt::format("static const {} test_range[{}_JOINTS][2]", fixed ? "int16_t" : "float",
                         upper_case(text.prefix())),
             rows);
}

/// Statements that fill `sensors` from the vectors of `tick`, and from one bad reading.
void add_fillers(const ControllerTables& tables, bool fixed, CText& text) {
  const std::string type = text.prefix() + "_sensors", upper = upper_case(text.prefix());
  text.line("static void test_sense(int tick, {} *sensors) {{", type);
  text.line("  int i;");
  if (tables.reads_touch())
    text.line("  for (i = 0; i < {}_LEGS; ++i) sensors->touch[i] = test_touch[tick][i];", upper);
  if (tables.reads_angles())
    text.line("  for (i = 0; i < {}_JOINTS; ++i) sensors->angle_rad[i] = test_angle_rad[tick][i];", upper);
  if (tables.reads_attitude()) {
    text.line("  sensors->roll_rad = test_attitude_rad[tick][0];");
    text.line("  sensors->pitch_rad = test_attitude_rad[tick][1];");
    text.line("  sensors->yaw_rad = test_attitude_rad[tick][2];");
  }
  if (tables.reads_speeds())
    text.line("  for (i = 0; i < {}_JOINTS; ++i) sensors->speed_rad_s[i] = test_speed_rad_s[tick][i];",
              upper);
  if (tables.reads_torques())
    text.line("  for (i = 0; i < {}_JOINTS; ++i) sensors->torque_nm[i] = test_torque_nm[tick][i];", upper);
  if (tables.reads_yaw_rate()) text.line("  sensors->yaw_rate_rad_s = test_yaw_rate_rad_s[tick][0];");
  if (tables.reads_loads())
    text.line("  for (i = 0; i < {}_LEGS; ++i) sensors->load_n[i] = test_load_n[tick][i];", upper);
  text.line("  (void)i, (void)tick, (void)sensors;");
  text.line("}}");
  text.line("");
  if (fixed) return;
  text.line("static void test_fill({} *sensors, float reading) {{", type);
  text.line("  int i;");
  if (tables.reads_touch()) text.line("  for (i = 0; i < {}_LEGS; ++i) sensors->touch[i] = reading;", upper);
  if (tables.reads_angles())
    text.line("  for (i = 0; i < {}_JOINTS; ++i) sensors->angle_rad[i] = reading;", upper);
  if (tables.reads_attitude())
    text.line("  sensors->roll_rad = sensors->pitch_rad = sensors->yaw_rad = reading;");
  if (tables.reads_speeds())
    text.line("  for (i = 0; i < {}_JOINTS; ++i) sensors->speed_rad_s[i] = reading;", upper);
  if (tables.reads_torques())
    text.line("  for (i = 0; i < {}_JOINTS; ++i) sensors->torque_nm[i] = reading;", upper);
  if (tables.reads_yaw_rate()) text.line("  sensors->yaw_rate_rad_s = reading;");
  if (tables.reads_loads()) text.line("  for (i = 0; i < {}_LEGS; ++i) sensors->load_n[i] = reading;", upper);
  text.line("  (void)i, (void)reading, (void)sensors;");
  text.line("}}");
  text.line("");
}

constexpr std::string_view in_range = R"(static int test_in_range(const $p_targets *targets) {
  int i, good = 1;
  for (i = 0; i < $P_JOINTS; ++i)
    good = good && targets->$angle[i] >= test_range[i][0] && targets->$angle[i] <= test_range[i][1];
  return good;
}

)";

constexpr std::string_view self_test_begin = R"(float $p_self_test(void) {
  $p_state state;
  $p_sensors sensors;
  $p_targets targets;
  float largest_rad = 0.0f;
  int tick, i;
  $p_init(&state);
  for (tick = 0; tick < test_ticks; ++tick) {
    test_sense(tick, &sensors);
$command    $p_step(&state, &sensors, &targets);
    if (!test_in_range(&targets)) return -1.0f;
    for (i = 0; i < $P_JOINTS; ++i) {
      float error_rad = (float)($difference) / $one_rad;
      if (error_rad < 0.0f) error_rad = -error_rad;
      if (error_rad > largest_rad) largest_rad = error_rad;
    }
  }
)";

constexpr std::string_view bad_readings = R"(  {
    /* Bits of NaN, infinity, the largest float; then their negatives. */
    static const uint32_t bad[6] = {0x7fc00000u, 0x7f800000u, 0x7f7fffffu,
                                    0xffc00000u, 0xff800000u, 0xff7fffffu};
    union {
      uint32_t bits;
      float number;
    } reading;
    for (i = 0; i < 6; ++i) {
      reading.bits = bad[i];
      for (tick = 0; tick < 50; ++tick) {
        test_fill(&sensors, reading.number);
        $p_step(&state, &sensors, &targets);
        if (!test_in_range(&targets)) return -1.0f;
      }
    }
  }
)";

constexpr std::string_view self_test_end = R"(  return largest_rad;
}

#ifndef $P_NO_MAIN
#include <stdio.h>

int main(void) {
  const float error_rad = $p_self_test();
  const int good = error_rad >= 0.0f && error_rad <= 1e-6f;
  if (error_rad < 0.0f)
    printf("$p: a target left its range\n");
  else
    printf("$p: %d ticks, largest error %g rad\n", test_ticks, (double)error_rad);
  return good ? 0 : 1;
}
#endif
#endif
)";

}  // namespace

void add_self_test(const ControllerTables& tables, const Trace& trace, const CSourceOptions& options,
                   CText& text) {
  const bool fixed = options.arithmetic == Arithmetic::fixed;
  text.line("");
  text.block("#ifdef $P_SELF_TEST\n");
  add_vectors(tables, trace, fixed, text);
  add_ranges(tables, fixed, text);
  text.line("");
  add_fillers(tables, fixed, text);
  const std::string_view member = fixed ? "angle" : "angle_rad";
  text.block(replaced(in_range, "$angle", member));
  const std::string difference = fmt::format("targets.{}[i] - test_target[tick][i]", member);
  const std::string one_rad = fixed ? fmt::format("{}.0f", 1 << fraction_bits(tables)) : "1.0f";
  const std::string_view command =
      tables.reads_commands() ? "    $p_set_command(&state, test_command[tick][0], test_command[tick][1]);\n"
                              : "";
  text.block(replaced(replaced(replaced(self_test_begin, "$difference", difference), "$one_rad", one_rad),
                      "$command", command));
  if (!fixed) text.block(bad_readings);
  text.block(self_test_end);
}

}  // namespace amble::exporting
