#include <fmt/ranges.h>

#include <cmath>

#include "amble/core/index.hpp"
#include "amble/exporting/c_parts.hpp"

namespace amble::exporting {
namespace {

std::string kind_in_words(const ControllerTables& tables) {
  return tables.kind == "supg"          ? "single-unit pattern generators (SUPG)"
         : tables.kind == "ctrnn"       ? "a continuous-time recurrent neural network (CTRNN)"
         : tables.kind == "network"     ? "a network of neurons"
         : tables.kind == "mixed"       ? "single-unit pattern generators (SUPG) and neurons"
         : tables.kind == "oscillators" ? "an oscillator for each joint"
                                        : tables.kind;
}

std::vector<std::string> provenance_lines(const Provenance& from, const std::string& robot) {
  return {fmt::format("experiment  {}, seed {}, generation {}, number {}", from.experiment, from.seed,
                      from.generation, from.index),
          fmt::format("robot       {}", robot),
          fmt::format("engine      {}", from.engine),
          fmt::format("result      {}", from.result),
          fmt::format("settings    XXH3 {}", from.settings_hash),
          fmt::format("genome      XXH3 {}", from.genome_hash)};
}

/// For feet of several shapes, which of them count as a touch.
std::vector<std::string> foot_lines(const robot::RobotSpec& robot) {
  std::vector<std::string> lines;
  for (const robot::Leg& leg : robot.legs) {
    if (leg.foot_geoms.size() == 1) continue;
    std::vector<std::string> shapes;
    for (const int geom : leg.foot_geoms)
      shapes.push_back(fmt::format("'{}'", robot.geoms[to_index(geom)].name));
    lines.push_back(fmt::format("    the foot of '{}': any of {}", leg.name, fmt::join(shapes, ", ")));
  }
  return lines;
}

std::vector<std::string> sensor_lines(const ControllerTables& tables, const robot::RobotSpec& robot,
                                      bool fixed) {
  std::vector<std::string> lines{"Sensors, read before each step:"};
  if (tables.reads_touch()) {
    lines.push_back(
        fmt::format("  touch[leg]        {} while the foot is on the ground, else 0", fixed ? "not 0" : "1"));
    for (const std::string& line : foot_lines(robot)) lines.push_back(line);
  }
  if (tables.reads_angles()) lines.push_back("  angle_rad[joint]  rad, 0 in the start pose, signed as below");
  if (tables.reads_attitude())
    lines.push_back(
        "  roll_rad, pitch_rad, yaw_rad  of the trunk against the world (x forward, y left, z up): "
        "R_z(yaw) R_y(pitch) R_x(roll); each from -pi to pi");
  if (tables.reads_speeds())
    lines.push_back(
        "  speed_rad_s[joint]  rad/s: (angle now - angle one tick ago) / tick; 0 without a tick before");
  if (tables.reads_torques())
    lines.push_back("  torque_nm[joint]  N m of the motor about the joint's axis; 0 without a tick before");
  if (tables.reads_yaw_rate())
    lines.push_back(
        "  yaw_rate_rad_s    rad/s: (yaw now - yaw one tick ago, the short way) / tick; 0 without a tick "
        "before");
  if (tables.reads_loads())
    lines.push_back(
        "  load_n[leg]       N of the ground against the foot, along its normal; 0 without a tick before");
  if (tables.reads_commands())
    lines.push_back(
        "  Commands, by its function set_command: a speed along its own forward axis and a turn to the left");
  if (lines.size() == 1) lines = {"Sensors: it reads none."};
  if (const auto* const neural = std::get_if<NeuralTables>(&tables.parts)) {
    std::vector<std::string> names;
    for (const NeuralTables::Sensor& sensor : neural->sensors) names.push_back(sensor.name);
    lines.push_back(fmt::format("Nodes that sense: {}.", fmt::join(names, ", ")));
    lines.push_back("A reading that is not finite is replaced by the last one that was.");
  }
  const auto* const supg = std::get_if<SupgTables>(&tables.parts);
  if (supg != nullptr && supg->modulation)
    lines.push_back("What legs sense is replaced by the last finite reading where it is not finite.");
  return lines;
}

/// With axis and range: what a target means.
std::vector<std::string> joint_lines(const ControllerTables& tables, const robot::RobotSpec& robot,
                                     const std::vector<std::string>& names) {
  std::vector<std::string> lines{
      "Joints: angle 0 is the start pose; positive angles turn the body by the right-hand rule about the "
      "axis, "
      "which is in the body's own frame."};
  for (std::size_t j = 0; j < tables.joints.size(); ++j) {
    const CommandedJoint& joint = tables.joints[j];
    const robot::Joint& part = robot.joints[j];
    const std::string range = joint.driven
                                  ? fmt::format("targets from {} to {} rad", joint.lower_rad, joint.upper_rad)
                              : joint.motor ? fmt::format("held at {} rad", joint.lower_rad)
                                            : std::string("no motor, its target means nothing");
    lines.push_back(fmt::format("  {}  '{}', body '{}', axis {} {} {}: {}", names[j], joint.name,
                                robot.bodies[to_index(part.body)].name, part.axis.x, part.axis.y, part.axis.z,
                                range));
  }
  return lines;
}

std::vector<std::string> first_vector(const ControllerTables& tables, const Trace& trace) {
  const Trace::Tick& tick = trace.ticks.front();
  std::vector<std::string> lines{"First step of its own trial, for a look:"};
  if (tables.reads_touch()) lines.push_back(fmt::format("  touch      {}", fmt::join(tick.touch, " ")));
  if (tables.reads_angles()) lines.push_back(fmt::format("  angle_rad  {}", fmt::join(tick.angle_rad, " ")));
  if (tables.reads_attitude())
    lines.push_back(fmt::format("  roll, pitch, yaw  {}", fmt::join(tick.attitude_rad, " ")));
  lines.push_back(fmt::format("  targets    {}", fmt::join(tick.target_rad, " ")));
  return lines;
}

void add_enumerators(const std::vector<std::string>& names, CText& text) {
  text.line("enum {{");
  for (std::size_t i = 0; i < names.size(); ++i)
    text.line("  {} = {}{}", names[i], i, i + 1 < names.size() ? "," : "");
  text.line("}};");
  text.line("");
}

/// Rows of macros cost nothing where they are not used, and firmware makes of them what it needs, on an AVR
/// in flash.
void add_rows(const ControllerTables& tables, const Trace& trace, const std::vector<std::string>& joints,
              const std::vector<std::string>& legs, CText& text) {
  text.block(
      "/* Tables for firmware: ROW(joint, name, leg or -1, least, greatest and first target, rad), and "
      "ROW(leg,\n"
      " * name). The first target is that of the first step of the controller's own trial. */\n"
      "#define $P_EACH_JOINT(ROW)");
  for (std::size_t j = 0; j < tables.joints.size(); ++j) {
    const CommandedJoint& joint = tables.joints[j];
    text.block(fmt::format(" \\\n  ROW({}, {}, {}, {}, {}, {})", joints[j], c_string(joint.name), joint.leg,
                           c_float(static_cast<float>(joint.lower_rad)),
                           c_float(static_cast<float>(joint.upper_rad)),
                           c_float(trace.ticks.front().target_rad[j])));
  }
  text.block("\n#define $P_EACH_LEG(ROW)");
  for (std::size_t leg = 0; leg < tables.legs.size(); ++leg)
    text.block(fmt::format(" \\\n  ROW({}, {})", legs[leg], c_string(tables.legs[leg])));
  text.block("\n\n");
}

void add_structs(const ControllerTables& tables, bool fixed, CText& text) {
  const std::string upper = upper_case(text.prefix());
  text.line("typedef struct {{");
  if (tables.reads_touch()) text.line("  {} touch[{}_LEGS];", fixed ? "uint8_t" : "float", upper);
  if (tables.reads_angles()) text.line("  float angle_rad[{}_JOINTS];", upper);
  if (tables.reads_attitude()) text.line("  float roll_rad, pitch_rad, yaw_rad;");
  if (tables.reads_speeds()) text.line("  float speed_rad_s[{}_JOINTS];", upper);
  if (tables.reads_torques()) text.line("  float torque_nm[{}_JOINTS];", upper);
  if (tables.reads_yaw_rate()) text.line("  float yaw_rate_rad_s;");
  if (tables.reads_loads()) text.line("  float load_n[{}_LEGS];", upper);
  if (tables.reads_nothing()) text.line("  char none; /* it reads none */");
  text.line("}} {}_sensors;", text.prefix());
  text.line("");
  text.line("typedef struct {{");
  if (fixed)
    text.line("  int16_t angle[{0}_JOINTS]; /* in 2^-{0}_FRACTION_BITS rad */", upper);
  else
    text.line("  float angle_rad[{}_JOINTS];", upper);
  text.line("}} {}_targets;", text.prefix());
  text.line("");
  text.line("/* All memory of a controller. Its members are for reading, in tests and telemetry. */");
  text.line("typedef struct {{");
  if (const auto* const supg = std::get_if<SupgTables>(&tables.parts))
    add_supg_state(*supg, text);
  else if (const auto* const neural = std::get_if<NeuralTables>(&tables.parts))
    add_neural_state(*neural, text);
  else
    add_oscillator_state(std::get<OscillatorTables>(tables.parts), text);
  add_command_state(tables, text);
  add_differential_state(tables, text);
  text.line("}} {}_state;", text.prefix());
  text.line("");
}

constexpr std::string_view functions = R"(/* The controller before its first step. */
void $p_init($p_state *state);
$command/* One step: from this tick's sensors to this tick's targets. To be called once per tick. */
void $p_step($p_state *state, const $p_sensors *sensors, $p_targets *targets);

#ifdef $P_SELF_TEST
/* Runs the first ticks of the champion's own trial: the largest error of a target, rad, or -1 where
 * a target left its range, also with sensors that are NaN, infinite or huge. Unless $P_NO_MAIN is
 * defined there is a main() that prints it. */
float $p_self_test(void);
#endif

#ifdef __cplusplus
}
#endif

#endif
)";

constexpr std::string_view command =
    R"(/* Tells it a speed along its own forward axis, m/s, and a turn to the left, rad/s; from the next step on.
 * At first it is to stand still. Both are limited to +- 100; if one is not finite nothing changes. */
void $p_set_command($p_state *state, float speed_m_s, float turn_rad_s);
)";

void add_constants(const ControllerTables& tables, bool fixed, CText& text) {
  const std::string upper = upper_case(text.prefix());
  text.line("#define {}_JOINTS {}", upper, tables.joints.size());
  text.line("#define {}_LEGS {}", upper, tables.legs.size());
  text.line("#define {}_TICK_US {} /* time from step to step, microseconds */", upper,
            std::lround(1e6 * tables.timestep_s));
  if (const auto* const neural = std::get_if<NeuralTables>(&tables.parts))
    text.line("#define {}_NEURONS {}", upper, neural->neurons.size());
  if (const auto* const oscillators = std::get_if<OscillatorTables>(&tables.parts))
    text.line("#define {}_OSCILLATORS {}", upper, oscillators->oscillators.size());
  if (const auto* const supg = std::get_if<SupgTables>(&tables.parts); supg != nullptr && supg->modulation)
    text.line("#define {}_TICK_PARTS {} /* timers in the state count in these */", upper,
              controllers::parts_per_tick);
  if (const auto* const supg = std::get_if<SupgTables>(&tables.parts); supg != nullptr && supg->mixed) {
    text.line("#define {}_NEURONS {} /* in the state's values, from here on: */", upper,
              supg->mixed->neurons.size());
    text.line("#define {}_FIRST_NEURON {}", upper, supg->mixed->sensors.size());
  }
  if (fixed) text.line("#define {}_FRACTION_BITS {}", upper, fraction_bits(tables));
  text.line("#define {}_READS_TOUCH {}", upper, tables.reads_touch() ? 1 : 0);
  text.line("#define {}_READS_ANGLES {}", upper, tables.reads_angles() ? 1 : 0);
  text.line("#define {}_READS_ATTITUDE {}", upper, tables.reads_attitude() ? 1 : 0);
  if (tables.reads_speeds()) text.line("#define {}_READS_SPEEDS 1", upper);
  if (tables.reads_torques()) text.line("#define {}_READS_TORQUES 1", upper);
  if (tables.reads_yaw_rate()) text.line("#define {}_READS_YAW_RATE 1", upper);
  if (tables.reads_loads()) text.line("#define {}_READS_LOADS 1", upper);
  if (tables.reads_commands()) text.line("#define {}_OBEYS 1", upper);
  if (tables.differential)
    text.line("#define {}_IS_STEERED 1 /* by hand, around what it has learnt */", upper);
  text.line("");
}

}  // namespace

std::string c_header(const ControllerTables& tables, const robot::RobotSpec& robot,
                     const Provenance& provenance, const Trace& trace, const CSourceOptions& options) {
  const bool fixed = options.arithmetic == Arithmetic::fixed;
  const std::vector<std::string> joints = c_joint_names(tables, options.prefix);
  CText text(options.prefix);
  text.line("/* Controller exported by amble {}: {}.", in_comment(provenance.amble),
            in_comment(kind_in_words(tables)));
  text.comment_lines({""});
  text.comment_lines(provenance_lines(provenance, robot.name));
  text.comment_lines({"",
                      fmt::format("Rate: {} steps per second, one every {} s. {}", tables.rate_hz(),
                                  tables.timestep_s, options.start),
                      ""});
  text.comment_lines(sensor_lines(tables, robot, fixed));
  text.comment_lines({""});
  text.comment_lines(joint_lines(tables, robot, joints));
  text.comment_lines({""});
  text.comment_lines(first_vector(tables, trace));
  text.line(" */");
  text.block(
      "#ifndef $P_H\n#define $P_H\n\n#include <stdint.h>\n\n#ifdef __cplusplus\nextern \"C\" {\n#endif\n\n");
  add_constants(tables, fixed, text);
  add_enumerators(joints, text);
  const std::vector<std::string> legs = c_leg_names(tables, options.prefix);
  add_enumerators(legs, text);
  add_rows(tables, trace, joints, legs, text);
  add_structs(tables, fixed, text);
  text.block(replaced(functions, "$command", tables.reads_commands() ? command : ""));
  return text.take();
}

}  // namespace amble::exporting
