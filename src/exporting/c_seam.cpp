#include "amble/exporting/c_parts.hpp"

/// controllers::SeamSmoother in C, operation by operation.
namespace amble::exporting {
namespace {

constexpr std::string_view continued = R"(/* What a leg's timer will be in this tick if it does not jump. */
static $timer continued_timer(const $p_state *state, int leg) {
$start  if (state->timer[leg] == stopped) return stopped;
  return ($timer)(state->timer[leg] + 1 < period ? state->timer[leg] + 1 : period);
}

)";

constexpr std::string_view limited = R"(static float limited(float value_rad, int joint) {
  const float above = value_rad > limit_rad[joint][0] ? value_rad : limit_rad[joint][0];
  return above < limit_rad[joint][1] ? above : limit_rad[joint][1];
}

)";

constexpr std::string_view dust =
    R"(static float without_dust(float value_rad) { return value_rad > 1e-9f || value_rad < -1e-9f ? value_rad : 0.0f; }

)";

constexpr std::string_view start_at_once = "  if (state->wait[leg] == 0) return first_timer[leg];\n";

constexpr std::string_view smoothed_begin =
    R"(/* The target of a joint whose pattern would be at continued_rad without a jump, and is at present_rad. */
static float smoothed($p_state *state, int joint, float continued_rad, float present_rad, int jumped) {
)";

constexpr std::string_view residual =
    R"(  const float left_rad = without_dust(residual_decay * state->residual_rad[joint]);
  float y_rad = limited(continued_rad + left_rad, joint);
  state->residual_rad[joint] = jumped ? y_rad - present_rad : left_rad;
)";

constexpr std::string_view no_residual = R"(  float y_rad = present_rad;
  (void)continued_rad, (void)jumped;
)";

constexpr std::string_view filter = R"(  int stage;
  for (stage = 0; stage < filter_order; ++stage) {
    float *const z_rad = &state->stage_rad[stage][joint];
    const float way_rad = filter_share * (y_rad - *z_rad);
    *z_rad = without_dust(*z_rad + way_rad);
    y_rad = *z_rad;
  }
  y_rad = limited(y_rad, joint);
)";

constexpr std::string_view init_residual =
    "  for (joint = 0; joint < $P_JOINTS; ++joint) state->residual_rad[joint] = 0.0f;\n";

constexpr std::string_view init_filter = R"(  for (stage = 0; stage < filter_order; ++stage)
    for (joint = 0; joint < $P_JOINTS; ++joint) {
      leg = leg_of_joint[joint];
      state->stage_rad[stage][joint] = READ_TARGET(&pattern[joint][leg < 0 ? 0 : $first + 1]);
    }
)";

}  // namespace

void add_seam_state(const SupgTables::Seam& seam, CText& text) {
  const std::string upper = upper_case(text.prefix());
  if (seam.residual_decay > 0.0f)
    text.line("  float residual_rad[{}_JOINTS]; /* what is left of jumps */", upper);
  if (seam.filter_order > 0)
    text.line("  float stage_rad[{}][{}_JOINTS]; /* of the low-pass filter */", seam.filter_order, upper);
}

void add_limits(const std::vector<std::array<float, 2>>& limits_rad, CText& text) {
  std::vector<std::vector<std::string>> limits;
  limits.reserve(limits_rad.size());
  for (const auto& [lower_rad, upper_rad] : limits_rad)
    limits.push_back({c_float(lower_rad), c_float(upper_rad)});
  text.array(fmt::format("static const float limit_rad[{}_JOINTS][2]", upper_case(text.prefix())), limits);
  text.line("");
  text.block(limited);
}

void add_smoothing(const SupgTables::Seam& seam, CText& text) {
  if (seam.residual_decay > 0.0f)
    text.line("static const float residual_decay = {};", c_float(seam.residual_decay));
  if (seam.filter_order > 0) {
    text.line("static const float filter_share = {};", c_float(seam.filter_share));
    text.line("enum {{ filter_order = {} }};", seam.filter_order);
  }
  text.line("");
  text.block(dust);
  text.block(smoothed_begin);
  text.block(seam.residual_decay > 0.0f ? residual : no_residual);
  if (seam.filter_order > 0) text.block(filter);
  text.block("  return y_rad;\n}\n\n");
}

void add_seam(const SupgTables& supg, const std::string& timer, CText& text) {
  add_limits(supg.limits_rad, text);
  const std::string start = supg.seam->starts_at_once ? std::string(start_at_once) : std::string();
  text.block(replaced(replaced(continued, "$start", start), "$timer", timer));
  add_smoothing(*supg.seam, text);
}

std::string c_residual_init() {
  return std::string(init_residual);
}

std::string c_seam_init(const SupgTables::Seam& seam) {
  std::string text;
  if (seam.residual_decay > 0.0f) text += init_residual;
  if (seam.filter_order > 0)
    text += replaced(init_filter, "$first", seam.starts_at_once ? "first_timer[leg]" : "stopped");
  return text;
}

}  // namespace amble::exporting
