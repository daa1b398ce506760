#include "amble/experiment/problem/problem.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "amble/core/error.hpp"
#include "amble/damage/stages.hpp"
#include "amble/experiment/problem/episode_set.hpp"
#include "amble/io/json_file.hpp"
#include "amble/neat/genome_io.hpp"
#include "amble/physics/damaged_engine.hpp"
#include "amble/robot/json.hpp"
#include "amble/robot/original_model.hpp"
#include "amble/robot/pose.hpp"

namespace amble::experiment {
namespace {

/// What makes a controller hear commands.
std::string hearing_key(const controllers::ControllerSettings& controller) {
  if (controller.differential.any()) return "controller.differential";
  if (controller.switching.any()) return "controller.switching";
  if (controller.kind == "supg") return "controller.supg.modulation.sensors";
  return "controller.kind";
}

constexpr int robot_version = 1;

/// The gaits' genomes as controllers.
std::vector<std::unique_ptr<controllers::Parameters>> decoded_gaits(
    const controllers::SwitchingSettings& settings, const controllers::Architecture& architecture,
    const cppn::Settings& cppn) {
  std::vector<std::unique_ptr<controllers::Parameters>> gaits;
  for (std::size_t i = 0; i < settings.gaits.size(); ++i) {
    const std::string key = fmt::format("controller.switching.gaits[{}].genome", i);
    const neat::Genome genome = neat::parse_genome(settings.gaits[i].genome, key);
    try {
      neat::validate(genome, static_cast<int>(architecture.cppn_inputs().size()),
                     static_cast<int>(architecture.cppn_outputs().size()), cppn.recurrent);
    } catch (const UserError& error) {
      fail(ExitCode::bad_file, "{}: {}", key, error.what());
    }
    gaits.push_back(architecture.decode(cppn::Network(genome, cppn)));
  }
  return gaits;
}

}  // namespace

void Problem::complete() {
  trial.validate();
  ground.validate();
  command.validate(trial);
  noise.validate(trial, ground.start_place_m > 0.0 || controller.sensing.is_noisy() || command.varies());
  score.validate();
  damage.validate(robot);
  check_start();
  // Champion files have the nodes themselves, however the config came by them.
  controller.substrate = controllers::substrate_of(controller, robot);
  make_architecture();
  make_engine();  // throws if the engine cannot simulate the robot
}

void Problem::make_architecture() {
  auto made = controllers::make_architecture(controller, robot, trial.timestep_s);
  if (controller.switching.any()) {
    auto gaits = decoded_gaits(controller.switching, *made, cppn);
    made = controllers::with_gaits(std::move(made), std::move(gaits), controller, robot);
  }
  architecture = std::move(made);
  if (architecture->extra_senses().commands() && command.kind == trial::CommandKind::none)
    fail_setting({"command.kind", hearing_key(controller)},
                 "command.kind = \"none\": the controller senses commands, and there are none; expected "
                 "fixed or random");
}

std::unique_ptr<physics::Engine> Problem::make_engine(bool torques) const {
  const robot::ExtraSenses sensed =
      architecture != nullptr ? architecture->extra_senses() : robot::ExtraSenses();
  const bool needed = torques || sensed.torque || make_score().measures().need_torques();
  return physics::make_damaged_engine(engine, robot, damage,
                                      {.timestep_s = trial.timestep_s,
                                       .torques = needed,
                                       .loads = sensed.load,
                                       .ground_friction = ground.friction,
                                       .own = engine_own});
}

std::unique_ptr<controllers::Parameters> Problem::decode(const neat::Genome& genome) const {
  return architecture->decode(cppn::Network(genome, cppn));
}

score::Score Problem::make_score() const {
  return score::Score(score, trial.steps() * trial.timestep_s, weight_n());
}

double Problem::mass_kg() const {
  return damage.changes_body() ? damage::robot_at_start(robot, damage).total_mass_kg()
                               : robot.total_mass_kg();
}

double Problem::weight_n() const {
  return mass_kg() * norm(robot.gravity_m_s2);
}

trial::Protocol Problem::protocol(const record::PathSampling& path, const record::Measures& measures) const {
  record::Measures all = make_score().measures();
  all |= measures;
  std::vector<trial::NumbTouch> numb;
  for (const damage::NumbFoot& foot : damage::numb_feet(robot, damage))
    numb.push_back({foot.leg, damage::first_step(foot.from_s, trial.timestep_s)});
  std::vector<double> max_torque_nm;
  for (const robot::Joint& joint : robot.joints)
    max_torque_nm.push_back(joint.has_motor() ? joint.servo.max_torque_nm : 0.0);
  return {.steps = trial.steps(),
          .timestep_s = trial.timestep_s,
          .first_command = trial.first_command,
          .path = path,
          .measures = all,
          .numb = std::move(numb),
          .sensing = {architecture->extra_senses(),
                      controllers::sensor_models(controller.sensing, robot, trial.timestep_s),
                      static_cast<float>(controller.sensing.heading.lead_rad)},
          .commands = trial::planned_commands(command, trial.steps(), trial.timestep_s),
          .fall = robot.fall_rule(),
          .max_torque_nm = std::move(max_torque_nm),
          .start_rotation = robot.bodies[0].rotation};
}

void Problem::set_ground(const ground::Settings& other) {
  other.validate();
  if (other.friction < 0.0 && ground.friction >= 0.0)
    fail_setting({"ground.friction"},
                 "ground.friction = -1: the robot's own friction is no longer known here; "
                 "expected a number");
  Problem changed = *this;
  if (other.slope_x != ground.slope_x || other.slope_y != ground.slope_y)
    // On a slope it leans for that.
    changed.robot.gravity_m_s2 = other.tilted(ground.slope_x == 0.0 && ground.slope_y == 0.0
                                                  ? robot.gravity_m_s2
                                                  : Vec3{0.0, 0.0, -norm(robot.gravity_m_s2)});
  if (other.friction >= 0.0) changed.robot.contact.friction = other.friction;
  changed.ground = other;
  changed.check_start();
  *this = std::move(changed);
}

void Problem::set_damage(const damage::Settings& other) {
  other.validate(robot);
  Problem changed = *this;
  changed.damage = other;
  changed.make_engine();
  *this = std::move(changed);
}

void Problem::set_commands(const trial::CommandSettings& other) {
  other.validate(trial);
  command = other;
}

void Problem::set_differential(const controllers::DifferentialSettings& other) {
  Problem changed = *this;
  changed.controller.differential = other;
  changed.make_architecture();
  *this = std::move(changed);
}

void Problem::check_start() const {
  if (!ground.has_field()) return;
  const auto start = robot::start_poses(robot);
  const ground::Key grown{.generation = static_cast<std::uint32_t>(ground.grow_generations)};
  ground::HeightField surface = ground::make_field(ground, grown);
  constexpr double slack_m = 1e-3;
  const double allowed_m = std::min(0.0, robot::clearance_m(robot, start)) - slack_m;
  // Most robots stand on the flat place, and a Ground takes long to make.
  if (ground::least_clearance_m(surface, robot, start) >= allowed_m) return;
  if (ground::Ground(std::move(surface), robot).clearance_m(robot, start) < allowed_m)
    fail_setting({"ground.start_radius_m", "ground.kind"},
                 "ground.start_radius_m = {}: the robot starts in the ground; expected a larger flat place",
                 ground.start_radius_m);
}

std::shared_ptr<const ground::Ground> Problem::make_ground(const ground::Key& key) const {
  if (!ground.has_field()) return nullptr;
  return std::make_shared<const ground::Ground>(ground::make_field(ground, key), robot);
}

ground::Key ground_of(const trial::ScenarioKey& key) {
  return {.seed = key.seed, .generation = key.generation, .set = ground_number(key.episode)};
}

std::shared_ptr<const ground::Ground> GenerationGround::of(const Problem& problem, std::int64_t seed,
                                                           int generation) {
  const ground::Key key = normalised(problem.ground, {.seed = static_cast<std::uint64_t>(seed),
                                                      .generation = static_cast<std::uint32_t>(generation)});
  if (key != key_) ground_ = problem.make_ground(key);
  key_ = key;
  return ground_;
}

trial::Scenario Problem::scenario(const trial::ScenarioKey& key, const ground::Ground* on) const {
  return trial::draw_scenario(noise, robot, trial.steps(), trial.timestep_s, key,
                              {.ground = on, .place_m = ground.start_place_m}, command);
}

bool Problem::trials_vary() const {
  return noise.any() || ground.start_place_m > 0.0 || controller.sensing.is_noisy() ||
         (command.varies() && architecture->extra_senses().commands());
}

std::vector<trial::Scenario> Problem::scenarios(std::int64_t seed, int generation,
                                                const ground::Ground* on) const {
  std::vector<trial::Scenario> all;
  if (!trials_vary()) return all;
  for (int episode = 0; episode < noise.episodes; ++episode)
    all.push_back(scenario({.seed = static_cast<std::uint64_t>(seed),
                            .generation = static_cast<std::uint32_t>(generation),
                            .episode = static_cast<std::uint32_t>(episode)},
                           on));
  return all;
}

robot::RobotSpec robot_from_text(const std::string& text, const std::string& what) {
  const auto sealed = io::unseal_json("amble-robot", robot_version, text, what);
  const io::JsonView root(sealed.document, what);
  robot::RobotSpec robot = robot::from_json(root.at("robot"));
  if (root.has("original_model"))
    robot.original = robot::original_model_from_json(root.at("original_model"), robot);
  return robot;
}

std::string robot_file_text(const robot::RobotSpec& robot) {
  io::Json document{{"robot", robot::to_json(robot)}};
  if (robot.original) document["original_model"] = robot::to_json(*robot.original);
  return io::sealed_json("amble-robot", robot_version, document);
}

}  // namespace amble::experiment
