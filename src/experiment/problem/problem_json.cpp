#include "amble/experiment/problem/problem_json.hpp"

#include <fmt/format.h>
#include <charconv>
#include <cstddef>
#include <system_error>

#include "amble/physics/engine_kinds.hpp"
#include "amble/robot/json.hpp"
#include "amble/robot/original_model.hpp"

namespace amble::experiment {

io::Json problem_json(const Problem& problem) {
  io::Json json{{"cppn", io::settings_to_json(problem.cppn)},
                {"controller", io::settings_to_json(problem.controller)},
                {"engine", problem.engine},
                {"trial", io::settings_to_json(problem.trial)},
                {"robot", robot::to_json(problem.robot)},
                {"score", io::settings_to_json(problem.score)},
                {"ground", io::settings_to_json(problem.ground)},
                {"damage", io::settings_to_json(problem.damage)},
                {"command", io::settings_to_json(problem.command)}};
  if (!problem.engine_own.numbers.empty()) json["engine_own"] = problem.engine_own.numbers;
  leave_out_implied(json, problem.score, problem.ground, problem.damage, problem.command);
  return json;
}

Problem problem_from_json(const io::JsonView& root) {
  Problem problem{
      .robot = robot::from_json(root.at("robot")),
      .engine = root.at("engine").text(),
      .cppn = io::settings_from_json<cppn::Settings>(root.at("cppn")),
      .controller = io::settings_from_json<controllers::ControllerSettings>(root.at("controller")),
      .trial = io::settings_from_json<trial::Settings>(root.at("trial")),
      .noise = {},
      .score = {},
      .ground = {},
      .damage = {},
      .architecture = nullptr};
  if (root.has("original_model"))
    problem.robot.original = robot::original_model_from_json(root.at("original_model"), problem.robot);
  if (root.has("noise"))
    problem.noise = io::settings_from_json<trial::NoiseSettings>(root.at("noise").at("settings"));
  if (root.has("score")) problem.score = io::settings_from_json<score::Settings>(root.at("score"));
  if (root.has("ground")) problem.ground = io::settings_from_json<ground::Settings>(root.at("ground"));
  if (root.has("damage")) problem.damage = io::settings_from_json<damage::Settings>(root.at("damage"));
  if (root.has("command"))
    problem.command = io::settings_from_json<trial::CommandSettings>(root.at("command"));
  if (const auto* kind = physics::find_engine(problem.engine); kind != nullptr)
    for (const io::OwnNumber& number : kind->numbers)
      problem.engine_own.numbers[number.name] = root.at("engine_own").at(number.name).finite_number();
  problem.complete();
  return problem;
}

void leave_out_implied(io::Json& json, const score::Settings& score, const ground::Settings& ground,
                       const damage::Settings& damage, const trial::CommandSettings& command) {
  if (score.is_distance()) json.erase("score");
  if (ground.is_default()) json.erase("ground");
  if (damage.is_default()) json.erase("damage");
  if (command.is_default()) json.erase("command");
}

namespace {

constexpr std::size_t digits_per_step = 8;

}  // namespace

std::string trace_text(const std::vector<std::uint32_t>& trace) {
  std::string text;
  for (const auto hash : trace) text += fmt::format("{:08x}", hash);
  return text;
}

std::vector<std::uint32_t> parse_trace(const io::JsonView& view) {
  const std::string text = view.text();
  if (text.size() % digits_per_step != 0) view.bad("eight hexadecimal digits per step");
  std::vector<std::uint32_t> trace(text.size() / digits_per_step);
  for (std::size_t i = 0; i < trace.size(); ++i) {
    const char* const first = text.data() + i * digits_per_step;
    const auto [end, error] = std::from_chars(first, first + digits_per_step, trace[i], 16);
    if (error != std::errc() || end != first + digits_per_step) view.bad("eight hexadecimal digits per step");
  }
  return trace;
}

}  // namespace amble::experiment
