#include <algorithm>

#include "amble/core/index.hpp"
#include "amble/exporting/c_neural_text.hpp"
#include "amble/exporting/c_parts.hpp"

/// controllers::MixedBatch in C, operation by operation.
namespace amble::exporting {
namespace {

constexpr std::string_view net_text = R"(/* Sensors, neurons, and what they add up to. */
static void run_net($p_state *state, const $p_sensors *in) {
  int i;
  read_sensors(state, in);
  for (i = 0; i < neurons; ++i) {
    const float before = state->value[first_neuron + i];
    const float aim = 2.0f * logistic(sum_links(bias[i], state->value, first_hidden[i], first_hidden[i + 1])) - 1.0f;
    const float after = fused(step[i], aim - before, before);
    state->next[i] = after < 1e-9f && after > -1e-9f ? 0.0f : after;
  }
  for (i = 0; i < neurons; ++i) state->value[first_neuron + i] = state->next[i];
  for (i = 0; i < sums; ++i)
    state->sum[i] = sum_links(0.0f, state->value, first_sum[i], first_sum[i + 1]);
$waves}

)";

constexpr std::string_view wave_text = R"(  for (i = 0; i < $P_LEGS; ++i) {
    const int stands = state->timer[i] < 0;
    const float turns = (float)state->timer[i] * per_part;
    state->wave[i] = stands ? 0.0f : sine(turns * 3.14159274f);
    state->wave[$P_LEGS + i] = stands ? 0.0f : sine((turns + 0.25f) * 3.14159274f);
  }
  for (i = 0; i < 2 * $P_LEGS; ++i)
    state->pull[i] = sum_links(0.0f, state->wave, first_pull[i], first_pull[i + 1]);
)";

constexpr std::string_view coupled_text = R"(  {
    const float ahead = state->pull[leg] * state->wave[$P_LEGS + leg];
    const float behind = state->pull[$P_LEGS + leg] * state->wave[leg];
    rho = rho + (ahead - behind);
  }
)";

constexpr std::string_view reshape_text =
    R"(/* A target's distance from the middle of its range, more or less of it, and a shift. */
static float reshaped(const $p_state *state, int joint, float y) {
  const float more = (y - middle_rad[joint]) * within_one(state->sum[$P_LEGS + joint]);
  const float shift = within_one(state->sum[$P_LEGS + $P_JOINTS + joint]) * half_rad[joint];
  return y + more + shift;
}

)";

/// Sensors, neurons, and SUPGs that neurons listen to.
std::size_t rows_of(const SupgTables::Mixed& mixed) {
  return mixed.sensors.size() + mixed.neurons.size() + mixed.listened.size();
}

/// CSR: where the links of each sum begin, and the end.
class LinkLists {
 public:
  std::vector<std::string> add(const std::vector<std::vector<WeightedLink>>& sums) {
    std::vector<std::string> firsts;
    for (const auto& links : sums) {
      firsts.push_back(std::to_string(weights_.size()));
      for (const WeightedLink& link : links) {
        weights_.push_back(c_float(link.weight));
        sources_.push_back(std::to_string(link.source));
      }
    }
    firsts.push_back(std::to_string(weights_.size()));
    return firsts;
  }
  /// C has no empty arrays.
  std::vector<std::string> weights() const { return padded(weights_, "0.0f"); }
  std::vector<std::string> sources() const { return padded(sources_, "0"); }

 private:
  static std::vector<std::string> padded(std::vector<std::string> list, const char* nothing) {
    if (list.empty()) list.emplace_back(nothing);
    return list;
  }
  std::vector<std::string> weights_, sources_;
};

std::vector<std::string> floats(const std::vector<SupgTables::Mixed::Neuron>& neurons,
                                float SupgTables::Mixed::Neuron::*value) {
  std::vector<std::string> list;
  list.reserve(neurons.size());
  for (const auto& neuron : neurons) list.push_back(c_float(neuron.*value));
  if (list.empty()) list.emplace_back("0.0f");
  return list;
}

void add_net_tables(const SupgTables& supg, CText& text) {
  const SupgTables::Mixed& mixed = *supg.mixed;
  LinkLists lists;
  std::vector<std::vector<WeightedLink>> hidden;
  hidden.reserve(mixed.neurons.size());
  for (const auto& neuron : mixed.neurons) hidden.push_back(neuron.links);
  auto sums = mixed.rates;
  sums.insert(sums.end(), mixed.amplitudes.begin(), mixed.amplitudes.end());
  sums.insert(sums.end(), mixed.shifts.begin(), mixed.shifts.end());
  const auto first_hidden = lists.add(hidden), first_sum = lists.add(sums);
  const auto first_pull = lists.add(mixed.pulls);
  text.line("enum {{ neurons = {}, first_neuron = {}, sums = {} }};", mixed.neurons.size(),
            mixed.sensors.size(), sums.size());
  text.line(
      "/* Links of neurons, of legs' rates, joints' amplitudes and shifts{}: from each first one on. */",
      mixed.pulls.empty() ? "" : ", and of couplings");
  text.array(fmt::format("static const float weight[{}]", lists.weights().size()), lists.weights());
  const std::string link = unsigned_type(lists.weights().size());
  text.array(
      fmt::format("static const {} source[{}]", unsigned_type(std::max(rows_of(mixed), 2 * supg.legs.size())),
                  lists.sources().size()),
      lists.sources());
  text.array(fmt::format("static const {} first_hidden[{}]", link, first_hidden.size()), first_hidden);
  text.array(fmt::format("static const {} first_sum[{}]", link, first_sum.size()), first_sum);
  if (!mixed.pulls.empty())
    text.array(fmt::format("static const {} first_pull[{}]", link, first_pull.size()), first_pull);
  const std::size_t neurons = std::max<std::size_t>(1, mixed.neurons.size());
  text.array(fmt::format("static const float bias[{}]", neurons),
             floats(mixed.neurons, &SupgTables::Mixed::Neuron::bias));
  text.array(fmt::format("static const float step[{}]", neurons),
             floats(mixed.neurons, &SupgTables::Mixed::Neuron::step));
  std::vector<std::string> middles, halves;
  for (const auto& [middle, half] : mixed.ranges_rad) {
    middles.push_back(c_float(middle));
    halves.push_back(c_float(half));
  }
  const std::string upper = upper_case(text.prefix());
  text.array(fmt::format("static const float middle_rad[{}_JOINTS]", upper), middles);
  text.array(fmt::format("static const float half_rad[{}_JOINTS]", upper), halves);
  if (!mixed.pulls.empty())
    text.line("static const float per_part = {}; /* of a period */",
              c_float(1.0f / static_cast<float>(supg.period_ticks * controllers::parts_per_tick)));
  text.line("");
}

void add_read_sensors(const SupgTables::Mixed& mixed, CText& text) {
  text.line("static void read_sensors({0}_state *state, const {0}_sensors *in) {{", text.prefix());
  if (!mixed.sensors.empty()) text.line("  float product;");
  for (std::size_t s = 0; s < mixed.sensors.size(); ++s) {
    const controllers::LegSensor& sensor = mixed.sensors[s];
    text.line("  product = {} * {}; /* {} */", c_sensor_member(sensor.sensor), c_float(sensor.gain),
              in_comment(mixed.sensor_names[s]));
    text.line("  state->value[{0}] = sensed_as(product - {1}, state->value[{0}]);", s, c_float(sensor.shift));
  }
  text.line("  (void)state, (void)in;");
  text.line("}}");
  text.line("");
}

/// sin 2x, of which a clock's text has all but the argument.
void add_sine(CText& text) {
  std::string body(c_clock_sine);
  body = replaced(body, "float x, y,", "float y,");
  body =
      replaced(body, "  x = (float)((turns - (double)(uint64_t)(turns + 0.5)) * 3.141592653589793);\n", "");
  text.line("/* sin 2x */");
  text.line("static float sine(float x) {{");
  text.block(body);
}

}  // namespace

void add_mixed_state(const SupgTables::Mixed& mixed, CText& text) {
  const std::string upper = upper_case(text.prefix());
  text.line("  float value[{}]; /* sensors, neurons, SUPGs that neurons listen to */",
            std::max<std::size_t>(1, rows_of(mixed)));
  text.line("  float next[{}];  /* scratch */", std::max<std::size_t>(1, mixed.neurons.size()));
  text.line("  float sum[{0}_LEGS + 2 * {0}_JOINTS]; /* of legs' rates, joints' amplitudes and shifts */",
            upper);
  if (!mixed.pulls.empty())
    text.line("  float wave[2 * {0}_LEGS], pull[2 * {0}_LEGS]; /* phases, and what others pull by */", upper);
}

void add_mixed(const SupgTables& supg, CText& text) {
  const SupgTables::Mixed& mixed = *supg.mixed;
  text.block(c_float_bits);
  add_net_tables(supg, text);
  text.block(c_fused);
  const float per_x = 2.0f * controllers_log2_e();
  text.line("/* 1/(1 + e^(-2x)) = (1 + tanh x)/2 */");
  text.line("static float logistic(float x) {{");
  text.line("  const float scale = {}, largest = {};", c_float(-per_x), c_float(largest_exponent() / per_x));
  text.block(c_logistic);
  text.block(c_sum);
  if (!mixed.pulls.empty()) add_sine(text);
  add_read_sensors(mixed, text);
  text.block(replaced(net_text, "$waves", mixed.pulls.empty() ? "" : wave_text));
  text.block(reshape_text);
}

std::string c_mixed_growth(const SupgTables::Mixed& mixed) {
  std::string text = "  rho = state->sum[leg];\n";
  if (!mixed.pulls.empty()) text += coupled_text;
  return text;
}

std::string c_mixed_init(const SupgTables::Mixed& mixed) {
  return fmt::format("  for (leg = 0; leg < {}; ++leg) state->value[leg] = 0.0f;\n",
                     std::max<std::size_t>(1, rows_of(mixed)));
}

std::string c_mixed_end(const SupgTables::Mixed& mixed) {
  std::string text;
  const std::size_t first = mixed.sensors.size() + mixed.neurons.size();
  for (std::size_t i = 0; i < mixed.listened.size(); ++i) {
    const auto& [joint, per_half] = mixed.listened[i];
    text += fmt::format("  state->value[{0}] = (targets->angle_rad[{1}] - middle_rad[{1}]) * {2};\n",
                        first + i, joint, c_float(per_half));
  }
  return text;
}

}  // namespace amble::exporting
