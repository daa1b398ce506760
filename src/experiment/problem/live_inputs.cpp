#include "amble/experiment/problem/live_inputs.hpp"

#include <cmath>

#include "amble/experiment/problem/problem_json.hpp"
#include "amble/io/json_file.hpp"

namespace amble::experiment {
namespace {

constexpr std::string_view inputs_format = "amble-inputs";
constexpr int inputs_version = 1;

io::Json input_json(const Input& input) {
  io::Json json{{"step", input.step}};
  if (input.push_n_s) json["push_n_s"] = {input.push_n_s->x, input.push_n_s->y, input.push_n_s->z};
  if (input.lift_m) json["lift_m"] = *input.lift_m;
  if (input.ground) json["ground"] = io::settings_to_json(*input.ground);
  if (input.damage) json["damage"] = io::settings_to_json(*input.damage);
  if (input.command) json["command"] = {input.command->speed_m_s, input.command->turn_rad_s};
  return json;
}

Vec3 parse_push(const io::JsonView& view) {
  if (view.size() != 3) view.bad("three numbers");
  return {view.at(0).finite_number(), view.at(1).finite_number(), view.at(2).finite_number()};
}

trial::Command parse_command(const io::JsonView& view) {
  if (view.size() != 2) view.bad("two numbers, m/s and rad/s");
  return {static_cast<float>(view.at(0).finite_number()), static_cast<float>(view.at(1).finite_number())};
}

Input parse_input(const io::JsonView& view, int first, int last) {
  const std::int64_t step = view.at("step").integer();
  if (step < first || step > last)
    view.at("step").bad("a step of the session, not before that of the last input");
  Input input{.step = static_cast<int>(step)};
  if (view.has("push_n_s")) input.push_n_s = parse_push(view.at("push_n_s"));
  if (view.has("lift_m")) input.lift_m = view.at("lift_m").finite_number();
  if (view.has("ground")) input.ground = io::settings_from_json<ground::Settings>(view.at("ground"));
  if (view.has("damage")) input.damage = io::settings_from_json<damage::Settings>(view.at("damage"));
  if (view.has("command")) input.command = parse_command(view.at("command"));
  return input;
}

}  // namespace

std::string inputs_text(const LiveInputs& session) {
  io::Json list = io::Json::array();
  for (const Input& input : session.inputs) list.push_back(input_json(input));
  return io::sealed_json(inputs_format, inputs_version,
                         {{"champion", session.champion},
                          {"engine", session.engine},
                          {"inputs", std::move(list)},
                          {"trace", trace_text(session.trace)}});
}

LiveInputs parse_inputs(const std::string& text, const std::string& what) {
  const auto sealed = io::unseal_json(inputs_format, inputs_version, text, what);
  const io::JsonView root(sealed.document, what);
  LiveInputs session{.champion = root.at("champion").text(),
                     .engine = root.at("engine").text(),
                     .inputs = {},
                     .trace = parse_trace(root.at("trace"))};
  const auto list = root.at("inputs");
  int first = 1;
  for (std::size_t i = 0; i < list.size(); ++i) {
    session.inputs.push_back(parse_input(list.at(i), first, static_cast<int>(session.trace.size())));
    first = session.inputs.back().step;
  }
  return session;
}

LiveReplay replay_live(const Champion& champion, const LiveInputs& session) {
  LiveTrial trial(champion.problem, champion.genome);
  const Vec3 start_m = trial.engine().com_m(LiveTrial::lane);
  LiveReplay replay;
  auto next = session.inputs.begin();
  for (const std::uint32_t hash : session.trace) {
    for (; next != session.inputs.end() && next->step == trial.steps() + 1; ++next) trial.apply(*next);
    const bool stepped = trial.step();
    if (!replay.first_difference &&
        (!stepped || static_cast<std::uint32_t>(trial.engine().state_hash(LiveTrial::lane)) != hash))
      replay.first_difference = replay.steps + 1;
    if (!stepped) break;
    ++replay.steps;
  }
  const Vec3 moved = trial.engine().com_m(LiveTrial::lane) - start_m;
  replay.distance_m = std::hypot(moved.x, moved.y);
  replay.fallen = trial.fallen();
  return replay;
}

}  // namespace amble::experiment
