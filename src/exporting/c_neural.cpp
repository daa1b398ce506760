#include <algorithm>

#include "amble/core/index.hpp"
#include "amble/exporting/c_neural_text.hpp"
#include "amble/exporting/c_parts.hpp"

namespace amble::exporting {
namespace {

using Update = NeuralTables::Update;

/// All links one behind the other, for each neuron those from sensors and then those from neurons.
struct LinkTable {
  std::vector<std::string> sources, weights;
  std::vector<std::string> first;  ///< of neuron n: [2 n] from sensors, [2 n + 1] from neurons, [2 n + 2] end
  std::size_t largest_source = 0;
};

LinkTable link_table(const NeuralTables& tables) {
  LinkTable table;
  const auto begin = [&] { table.first.push_back(std::to_string(table.sources.size())); };
  for (const NeuralTables::Neuron& neuron : tables.neurons) {
    for (const auto* const links : {&neuron.from_sensors, &neuron.from_neurons}) {
      begin();
      for (const NeuralTables::Link& link : *links) {
        table.sources.push_back(std::to_string(link.source));
        table.weights.push_back(c_float(link.weight));
        table.largest_source = std::max(table.largest_source, to_index(link.source));
      }
    }
  }
  begin();
  return table;
}

bool is_ctrnn(const NeuralTables& tables) {
  return tables.update == Update::euler || tables.update == Update::runge_kutta;
}

bool has_sine(const NeuralTables& tables) {
  return std::ranges::any_of(tables.sensors, [](const NeuralTables::Sensor& sensor) {
    return sensor.reads.kind == substrate::Sensor::Kind::sine;
  });
}

/// Whether some sensor is the arc tangent of an attitude's tangent (controllers/sensing.hpp).
bool has_swapped_attitude(const NeuralTables& tables) {
  using Kind = substrate::Sensor::Kind;
  return tables.attitude == substrate::Attitude::misordered_quaternion &&
         std::ranges::any_of(tables.sensors, [](const NeuralTables::Sensor& sensor) {
           return sensor.reads.kind == Kind::roll || sensor.reads.kind == Kind::yaw;
         });
}

bool senses(const NeuralTables& tables) {
  return std::ranges::any_of(tables.sensors, [](const NeuralTables::Sensor& sensor) {
    return sensor.reads.kind != substrate::Sensor::Kind::sine;
  });
}

void add_tables(const ControllerTables& tables, const NeuralTables& neural, CText& text) {
  const LinkTable links = link_table(neural);
  const std::string upper = upper_case(text.prefix());
  text.line("/* Links of neuron n: from sensors [first[2 n], first[2 n + 1]), from neurons up to");
  text.line(" * first[2 n + 2]. */");
  text.array(
      fmt::format("static const {} first[2 * {}_NEURONS + 1]", unsigned_type(links.sources.size()), upper),
      links.first);
  const std::size_t count = std::max<std::size_t>(links.sources.size(), 1);
  text.array(fmt::format("static const {} source[{}]", unsigned_type(links.largest_source), count),
             links.sources);
  text.array(fmt::format("static const float weight[{}]", count), links.weights);
  if (is_ctrnn(neural)) {
    std::vector<std::string> biases, rates;
    for (const NeuralTables::Neuron& neuron : neural.neurons) {
      biases.push_back(c_float(neural.potential ? neuron.bias : 0.0f - neuron.bias));
      rates.push_back(c_float(neuron.rate));
    }
    text.array(
        fmt::format("static const float {}[{}_NEURONS]", neural.potential ? "bias" : "minus_bias", upper),
        biases);
    text.line("/* Step over time constant. */");
    text.array(fmt::format("static const float rate[{}_NEURONS]", upper), rates);
  }
  std::vector<std::string> drivers, lowers, widths;
  for (std::size_t j = 0; j < tables.joints.size(); ++j) {
    const CommandedJoint& joint = tables.joints[j];
    drivers.push_back(std::to_string(neural.neuron_of_joint[j]));
    lowers.push_back(c_double(joint.lower_rad));
    widths.push_back(c_double(joint.upper_rad - joint.lower_rad));
  }
  text.line("/* The neuron that drives each joint, or -1 for one that is held, and its range. */");
  text.array(fmt::format("static const int16_t driver[{}_JOINTS]", upper), drivers);
  text.array(fmt::format("static const double lower_rad[{}_JOINTS]", upper), lowers);
  text.array(fmt::format("static const double width_rad[{}_JOINTS]", upper), widths);
  text.line("");
}

/// The expression of the struct PREFIX_sensors that a sensor reads.
std::string reading(const substrate::Sensor& sensor, substrate::Attitude formula) {
  using Kind = substrate::Sensor::Kind;
  if (formula == substrate::Attitude::misordered_quaternion) {
    if (sensor.kind == Kind::roll) return "negative_arc_tangent(in->yaw_rad)";
    if (sensor.kind == Kind::yaw) return "negative_arc_tangent(in->roll_rad)";
  }
  return c_sensor_member(sensor, "s");
}

/// The same, multiplied by the sensor's scale.
std::string scaled(const std::string& expression, float scale) {
  return scale == 1.0f ? expression : fmt::format("{} * {}", expression, c_float(scale));
}

void add_sensing(const ControllerTables& tables, const NeuralTables& neural, CText& text) {
  if (senses(neural)) text.block(c_sense);
  if (has_swapped_attitude(neural)) text.block(c_negative_arc_tangent);
  if (has_sine(neural)) {
    text.line("/* sin(2 pi t / {} s) at tick s->tick. */", neural.sine_period_s);
    text.line("static float clock_sine(uint32_t tick) {{");
    text.line("  const double turns = tick * {} / {};", c_double(tables.timestep_s),
              c_double(neural.sine_period_s));
    text.block(c_clock_sine);
  }
  add_commands(tables, text);
  text.line("static void read_sensors({0}_state *s, const {0}_sensors *in) {{", text.prefix());
  if (neural.sensors.empty()) text.line("  (void)s;");
  if (!senses(neural)) text.line("  (void)in;");
  for (std::size_t i = 0; i < neural.sensors.size(); ++i) {
    const NeuralTables::Sensor& sensor = neural.sensors[i];
    if (sensor.reads.kind == substrate::Sensor::Kind::sine)
      text.line("  s->sensor[{}] = {};", i, scaled("clock_sine(s->tick)", sensor.scale));
    else
      text.line("  s->sensor[{0}] = sense({1}, s->sensor[{0}]); /* {2} */", i,
                scaled(reading(sensor.reads, neural.attitude), sensor.scale), in_comment(sensor.name));
  }
  text.line("}}");
  text.line("");
}

void add_update(const NeuralTables& neural, CText& text) {
  if (neural.update == Update::levels) return text.block(c_levels);
  text.line("enum {{ steps = {} }};", neural.steps);
  if (neural.update == Update::passes) return text.block(c_passes);
  text.block(neural.potential ? c_pulls_potential : c_pulls_rate);
  // With the rate equation the state is the values.
  const bool runge_kutta = neural.update == Update::runge_kutta;
  const std::string_view find = runge_kutta ? "    find_values(s, at);\n" : "  find_values(s, y);\n";
  text.block(replaced(runge_kutta ? c_runge_kutta_step : c_euler_step, "  $find_values",
                      neural.potential ? find : ""));
  text.line("static void update({}_state *s) {{", text.prefix());
  text.block(neural.potential ? c_ctrnn_begin_potential : c_ctrnn_begin_rate);
  if (neural.cleared) text.block(c_ctrnn_clear);
  text.block(c_ctrnn_steps);
  if (neural.potential) text.block(c_ctrnn_end_potential);
  text.line("}}");
  text.line("");
}

}  // namespace

void add_neural_state(const NeuralTables& tables, CText& text) {
  const std::string upper = upper_case(text.prefix());
  const bool ctrnn = is_ctrnn(tables);
  if (!tables.sensors.empty()) text.line("  float sensor[{}]; /* as last read */", tables.sensors.size());
  text.line("  float neuron[{}_NEURONS]; /* values */", upper);
  text.line("  float sensed[{}_NEURONS]; /* scratch: the sensors' part of a neuron's sum */", upper);
  if (tables.update == Update::passes || ctrnn) text.line("  float next[{}_NEURONS]; /* scratch */", upper);
  if (tables.potential) text.line("  float y[{}_NEURONS]; /* potentials */", upper);
  if (tables.update == Update::runge_kutta) text.line("  float change[4][{}_NEURONS]; /* scratch */", upper);
  if (has_sine(tables)) text.line("  uint32_t tick; /* from 0; begins again after 2^32 */");
}

void add_neural(const ControllerTables& tables, CText& text) {
  const auto& neural = std::get<NeuralTables>(tables.parts);
  text.block(c_rounding);
  text.block(c_float_bits);
  add_tables(tables, neural, text);
  text.block(c_fused);
  const float per_x = neural.slope * controllers_log2_e();
  text.line("/* 1/(1 + e^(-slope x)), slope {}; 1/(slope log2(e)) times 126 is where it is cut off. */",
            c_float(neural.slope));
  text.line("static float logistic(float x) {{");
  text.line("  const float scale = {}, largest = {};", c_float(-per_x), c_float(largest_exponent() / per_x));
  text.block(c_logistic);
  text.block(c_sum);
  add_sensing(tables, neural, text);
  add_update(neural, text);

  text.line("void {0}_init({0}_state *state) {{", text.prefix());
  text.line("  int n;");
  if (!neural.sensors.empty())
    text.line("  for (n = 0; n < {}; ++n) state->sensor[n] = 0.0f;", neural.sensors.size());
  text.line("  for (n = 0; n < {}_NEURONS; ++n) {{", upper_case(text.prefix()));
  text.line("    state->neuron[n] = 0.0f;");
  if (neural.potential) text.line("    state->y[n] = 0.0f;");
  text.line("  }}");
  if (has_sine(neural)) text.line("  state->tick = 0;");
  text.block(c_command_init(tables));
  text.line("}}");
  text.line("");
  text.block(replaced(c_step_begin, "$heading", c_command_step(tables, "sensors")));
  if (has_sine(neural)) text.line("  ++state->tick;");
  text.block(c_step_end);
}

}  // namespace amble::exporting
