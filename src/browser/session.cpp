#include "amble/browser/session.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

#include "amble/core/error.hpp"
#include "amble/core/hash.hpp"
#include "amble/core/index.hpp"
#include "amble/damage/stages.hpp"
#include "amble/ground/kinds.hpp"
#include "amble/io/json_file.hpp"
#include "amble/record/recording.hpp"
#include "amble/robot/json.hpp"

namespace amble::browser {
namespace {

using experiment::LiveTrial;

template <typename Settings>
Settings settings_of(const std::string& json, const std::string& what) {
  const io::Json parsed = io::parse_json(json, what);
  return io::settings_from_json<Settings>(io::JsonView(parsed, what));
}

std::vector<std::string> column_names(const experiment::Problem& problem, const LiveTrial& trial) {
  std::vector<std::string> joints, legs;
  for (const auto& joint : problem.robot.joints) joints.push_back(joint.name);
  for (const auto& leg : problem.robot.legs) legs.push_back(leg.name);
  std::vector<std::string> names{"step", "fallen", "time_s"};
  for (auto& name : record::standard_columns(joints, legs)) names.push_back(std::move(name));
  for (auto& name : trial.controllers().state_names()) names.push_back(std::move(name));
  if (trial.obeys()) std::ranges::move(record::command_columns(), std::back_inserter(names));
  return names;
}

/// How fast what was asked for in evolution is, so that a page asks for no more.
io::Json commands_of(const trial::CommandSettings& settings) {
  double least_m_s = settings.least_speed_m_s, most_m_s = settings.most_speed_m_s,
         turn_rad_s = settings.most_turn_rad_s;
  if (settings.kind == trial::CommandKind::fixed) {
    least_m_s = most_m_s = turn_rad_s = 0.0;
    for (const trial::CommandStretch& stretch : settings.stretches) {
      least_m_s = std::min(least_m_s, stretch.speed_m_s);
      most_m_s = std::max(most_m_s, stretch.speed_m_s);
      turn_rad_s = std::max(turn_rad_s, std::abs(stretch.turn_rad_s));
    }
  }
  return {{"least_speed_m_s", std::min(least_m_s, 0.0)},
          {"most_speed_m_s", most_m_s},
          {"most_turn_rad_s", turn_rad_s}};
}

}  // namespace

Session::Session(const std::string& champion)
    : champion_(experiment::parse_champion_for(engine, champion, "champion")),
      evolved_in_(io::parse_json(champion, "champion").at("engine").get<std::string>()),
      record_{.champion = hex(hash_text(champion)), .engine = engine, .inputs = {}, .trace = {}} {
  restart(true);
}

void Session::restart(bool as_evolved) {
  // What it has now becomes an input before the first step.
  experiment::Input now{.ground = {}, .damage = {}};
  if (as_evolved) told_.reset();
  if (trial_ && !as_evolved) {
    now.ground = trial_->problem().ground;
    now.damage = trial_->problem().damage;
    now.command = told_;
  }
  record_.inputs.clear();
  record_.trace.clear();
  trial_ = std::make_unique<LiveTrial>(champion_.problem, champion_.genome);
  controller_state_.resize(trial_->controllers().state_names().size());
  if (now.ground && io::settings_to_json(*now.ground) == io::settings_to_json(champion_.problem.ground))
    now.ground.reset();
  if (now.damage && io::settings_to_json(*now.damage) == io::settings_to_json(champion_.problem.damage))
    now.damage.reset();
  if (now.ground || now.damage || now.command) note(std::move(now));
}

void Session::note(experiment::Input input) {
  input.step = trial_->steps() + 1;
  trial_->apply(input);
  record_.inputs.push_back(std::move(input));
}

void Session::push(Vec3 impulse_n_s) {
  for (const double part : {impulse_n_s.x, impulse_n_s.y, impulse_n_s.z})
    if (!std::isfinite(static_cast<float>(part)))
      fail(ExitCode::bad_input, "push: expected three numbers, N s");
  note({.push_n_s = impulse_n_s});
}

void Session::lift(double height_m) {
  note({.lift_m = height_m});
}

void Session::command(trial::Command command) {
  if (!std::isfinite(command.speed_m_s) || !std::isfinite(command.turn_rad_s))
    fail(ExitCode::bad_input, "command: expected two numbers, m/s and rad/s");
  note({.command = command});
  told_ = command;
}

void Session::set_ground(const std::string& json) {
  note({.ground = settings_of<ground::Settings>(json, "ground")});
}

void Session::set_damage(const std::string& json) {
  note({.damage = settings_of<damage::Settings>(json, "damage")});
}

int Session::step(int count) {
  if (count < 0) fail(ExitCode::bad_input, "step: {}: expected 0 or more", count);
  for (int i = 0; i < count; ++i) {
    if (!trial_->step()) return i;
    record_.trace.push_back(static_cast<std::uint32_t>(trial_->engine().state_hash(LiveTrial::lane)));
  }
  return count;
}

std::string Session::describe() const {
  const experiment::Problem& problem = trial_->problem();
  io::Json kinds = io::Json::array();
  for (const auto& kind : ground::kinds()) kinds.push_back(kind.name);
  const io::Json json{
      {"experiment", champion_.experiment},
      {"seed", champion_.seed},
      {"generation", champion_.generation},
      {"engine", problem.engine},
      {"evolved_in", evolved_in_},
      {"ground_kinds", kinds},
      {"timestep_s", problem.trial.timestep_s},
      {"duration_s", problem.trial.duration_s},
      {"mass_kg", problem.robot.total_mass_kg()},
      {"recorded_steps", evolved_in_ == engine ? champion_.trace.size() : 0},
      {"distance_m", champion_.result.distance_m},
      {"columns", column_names(problem, *trial_)},
      {"cppn_inputs", problem.architecture->cppn_inputs()},
      {"cppn_outputs", problem.architecture->cppn_outputs()},
      {"cppn_linear", cppn::linear_names[static_cast<std::size_t>(problem.cppn.linear)]},
      {"robot", robot::to_json(damage::as_drawn(problem.robot, problem.damage))},
      {"controller",
       io::parse_json(problem.architecture->parameters_json(trial_->parameters()), "controller")},
      {"ground", io::settings_to_json(problem.ground)},
      {"friction", io::json_number(problem.robot.contact.friction)},
      {"damage", io::settings_to_json(problem.damage)},
      {"commands", trial_->obeys() ? commands_of(problem.command) : io::Json()}};
  return json.dump(-1, ' ', false, io::Json::error_handler_t::replace);
}

const std::vector<double>& Session::state() {
  const physics::Engine& physics = trial_->engine();
  constexpr int lane = LiveTrial::lane;
  const auto pose = physics.root_pose(lane);
  const Vec3 com_m = physics.com_m(lane);
  state_ = {static_cast<double>(trial_->steps()),
            trial_->fallen() ? 1.0 : 0.0,
            trial_->steps() * trial_->problem().trial.timestep_s,
            pose.position_m.x,
            pose.position_m.y,
            pose.position_m.z,
            pose.rotation.w,
            pose.rotation.x,
            pose.rotation.y,
            pose.rotation.z,
            com_m.x,
            com_m.y,
            com_m.z};
  const auto put_lane = [&](const LaneArray& rows) {
    for (int row = 0; row < rows.rows(); ++row) state_.push_back(static_cast<double>(rows.at(row, lane)));
  };
  put_lane(physics.sensors().joint_angle_rad);
  put_lane(trial_->targets_rad());
  put_lane(physics.sensors().touch);
  trial_->controllers().state(lane, controller_state_);
  state_.insert(state_.end(), controller_state_.begin(), controller_state_.end());
  if (trial_->obeys()) {
    const trial::Command told = trial_->told();
    state_.insert(state_.end(), {static_cast<double>(told.speed_m_s), static_cast<double>(told.turn_rad_s)});
  }
  return state_;
}

const float* Session::heights_m() const {
  const ground::Ground* const ground = trial_->engine().ground();
  return ground != nullptr ? ground->surface().heights_m().data() : nullptr;
}

int Session::steps_as_recorded() const {
  if (evolved_in_ != engine) return 0;
  LiveTrial again(champion_.problem, champion_.genome);
  for (std::size_t i = 0; i < champion_.trace.size(); ++i) {
    if (!again.step()) return static_cast<int>(i);
    if (static_cast<std::uint32_t>(again.engine().state_hash(LiveTrial::lane)) != champion_.trace[i])
      return static_cast<int>(i);
  }
  return static_cast<int>(champion_.trace.size());
}

std::string Session::inputs() const {
  experiment::LiveInputs done = record_;
  const auto last = static_cast<int>(done.trace.size());
  std::erase_if(done.inputs, [last](const experiment::Input& input) { return input.step > last; });
  return experiment::inputs_text(done);
}

}  // namespace amble::browser
