#include "amble/experiment/plan/config.hpp"
#include "amble/damage/stages.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <memory>

#include "amble/core/error.hpp"
#include "amble/experiment/problem/episode_set.hpp"
#include "amble/experiment/problem/problem_json.hpp"
#include "amble/io/json_file.hpp"
#include "amble/io/toml_settings.hpp"
#include "amble/physics/engine_kinds.hpp"

namespace amble::experiment {
namespace {

/// "physics engine: ode, batch or mujoco".
std::string engine_description() {
  const auto names = physics::engine_names();
  return fmt::format("physics engine: {} or {}", fmt::join(names.begin(), names.end() - 1, ", "),
                     names.back());
}

}  // namespace

void Config::describe(io::SettingsVisitor& visitor) {
  const std::string engines = engine_description();
  visitor.text("name", name, {"what this experiment is called in files and figures"});
  visitor.text("robot", robot, {"robot file, relative to the config file"});
  visitor.number("drop_m", drop_m, {0.0, 1.0},
                 {"each trial starts with the robot dropped from this height above its start pose, m",
                  "Morse et al. 2013 and the authors' code: feet on the ground (0)"});
  visitor.text("engine", engine, {engines, "Morse et al. 2013, sec. 4 (ode)"});
  visitor.texts("referees", referees,
                {"engines in which each new champion is run again; its file records the distances there"});
  visitor.integer("seed", seed, {0, static_cast<double>(largest_seed)}, {"seed of all randomness"});
  visitor.integer("generations", generations, {1, most_generations},
                  {"generations to evaluate, the initial one included", "Morse et al. 2013, sec. 4"});
  if (const auto* kind = physics::find_engine(engine); kind != nullptr && !kind->numbers.empty()) {
    visitor.begin("engine_own", {"settings of this engine"});
    engine_own.describe(visitor, kind->numbers);
    visitor.end();
  }
  neat.describe(visitor);
  visitor.table("cppn", cppn, {"the compositional pattern producing network"});
  visitor.table("controller", controller, {"how a CPPN becomes a controller"});
  visitor.table("trial", trial, {"one trial of one controller"});
  visitor.table("noise", noise, {"noise in trials, and how many of them make an evaluation; off by default"});
  visitor.table("command", command, {"what robots are told to do in trials: nothing by default"});
  visitor.table("evaluation", evaluation,
                {"how trials are spent under noise; by default alike for all genomes"});
  visitor.table("ground", ground, {"what robots walk on: flat by default"});
  visitor.table("damage", damage, {"what is wrong with the robot: nothing by default"});
  visitor.table("score", score, {"what makes a gait good"});
  visitor.table("search", search, {"what selects parents"});
  visitor.table("champion", champion, {"which of the generations' best is the run's champion"});
}

void ChampionSettings::describe(io::SettingsVisitor& visitor) {
  visitor.integer("episodes", episodes, {0, most_evolution_episodes},
                  {"further trials under noise, the same throughout the run, that decide whether the best of "
                   "a generation becomes the champion; 0: its evaluation decides, luck included"});
  visitor.choice("score", score, champion_score_names,
                 {"what counts of their scores; median: what the walker typically does"});
}

trial::EpisodeScore ChampionSettings::episode_score(trial::EpisodeScore of_evolution) const {
  switch (score) {
    case ChampionScore::mean:
      return trial::EpisodeScore::mean;
    case ChampionScore::worst:
      return trial::EpisodeScore::worst;
    case ChampionScore::median:
      return trial::EpisodeScore::median;
    case ChampionScore::lower_quartile:
      return trial::EpisodeScore::lower_quartile;
    case ChampionScore::as_in_evolution:
      break;
  }
  return of_evolution;
}

void Config::validate() const {
  if (robot.empty())
    fail_setting(
        {"robot"},
        "'robot' = \"\": expected the path of a robot file, as in a config that may include this one");
  if (!physics::is_engine(engine))
    fail_setting({"engine"}, "'engine' = \"{}\": expected {}", engine,
                 fmt::join(physics::engine_names(), ", "));
  check_referees();
  neat.validate();
  trial.validate();
  ground.validate();
  command.validate(trial);
  noise.validate(trial, ground.start_place_m > 0.0 || controller.sensing.is_noisy() || command.varies());
  score.validate();
  check_evaluation();
  check_tracking();
  if (champion.episodes > 0 && !disturbed())
    fail_setting({"champion.episodes"},
                 "champion.episodes = {}: without any noise they would all be the same; expected 0",
                 champion.episodes);
  search::strategy_kind(search).validate(search, make_behaviour()->length());
  if (search.kind == "cma-es" && neat.population.size < search::least_cma_es_candidates)
    fail_setting({"population.size", "search.kind"},
                 "population.size = {}: CMA-ES needs at least {} candidates a round", neat.population.size,
                 search::least_cma_es_candidates);
}

bool Config::disturbed() const {
  return noise.any() || ground.start_place_m > 0.0 || controller.sensing.is_noisy() || command.varies();
}

void Config::check_tracking() const {
  if (command.kind != trial::CommandKind::none) return;
  for (std::size_t i = 0; i < score.terms.size(); ++i)
    if (score.terms[i].quantity == "tracking")
      fail_setting({fmt::format("score.terms[{}].quantity", i), "command.kind"},
                   "score.terms[{}].quantity = \"tracking\": there are no commands to follow, and standing "
                   "still would be best; expected commands (command.kind) or another quantity",
                   i);
}

void Config::check_evaluation() const {
  if (evaluation.finalists > 0.0 && !disturbed())
    fail_setting(
        {"evaluation.finalists"},
        "evaluation.finalists = {}: without any noise their trials would all be the same; expected 0",
        evaluation.finalists);
  if (evaluation.draw == Draw::once && ground.grow_generations > 0)
    fail_setting({"evaluation.draw", "ground.grow_generations"},
                 "evaluation.draw = \"once\": the ground of generation 0 in all of them would never grow; "
                 "expected ground.grow_generations = 0, or \"each_generation\"");
  const int most = evaluation.episodes_of_best(noise.episodes);
  if (most > static_cast<int>(most_evolution_episodes))
    fail_setting({"evaluation.finalist_episodes", "noise.episodes"},
                 "noise.episodes + evaluation.finalist_episodes = {}: expected at most {}", most,
                 most_evolution_episodes);
  if (evaluation.finalists > 0.0 && search.kind == "map-elites")
    fail_setting({"evaluation.finalists", "search.kind"},
                 "evaluation.finalists = {}: a map compares each candidate with its own cell; expected 0",
                 evaluation.finalists);
}

void Config::check_referees() const {
  for (auto referee = referees.begin(); referee != referees.end(); ++referee) {
    if (!physics::is_engine(*referee))
      fail_setting({"referees"}, "'referees' names \"{}\": expected {}", *referee,
                   fmt::join(physics::engine_names(), ", "));
    if (*referee == engine)
      fail_setting({"referees", "engine"}, "'referees' names \"{}\", the engine of the run itself", *referee);
    if (std::find(referees.begin(), referee, *referee) != referee)
      fail_setting({"referees"}, "'referees' names \"{}\" twice", *referee);
  }
}

UserError Config::with_location(const SettingError& error) const {
  const std::string place = locate_setting ? locate_setting(error.keys()) + ": " : "";
  return UserError(place + error.what(), error.code());
}

std::unique_ptr<const score::Behaviour> Config::make_behaviour(const robot::RobotSpec* robot_spec) const {
  score::BehaviourSettings settings{
      .steps = trial.steps(),
      .path = {.stride = search.novelty.path_stride, .first_step = search.novelty.path_first_step},
      .score = score,
      .duration_s = trial.steps() * trial.timestep_s};
  for (const auto& descriptor : search.map_elites.descriptors)
    settings.descriptors.push_back({descriptor.quantity, descriptor.leg});
  if (robot_spec) {
    const double mass_kg = damage.changes_body() ? damage::robot_at_start(*robot_spec, damage).total_mass_kg()
                                                 : robot_spec->total_mass_kg();
    settings.weight_n = mass_kg * norm(robot_spec->gravity_m_s2);
    for (const auto& leg : robot_spec->legs) settings.leg_names.push_back(leg.name);
  }
  return score::make_behaviour(search::strategy_kind(search).behaviour, settings);
}

std::string Config::identity() const {
  Config copy = *this;
  copy.name.clear();
  copy.robot.clear();
  copy.seed = 0;
  copy.generations = 1;
  io::Json values = io::Json::object();
  copy.describe(*io::json_writer(values));
  // Later tables and keys are omitted at their defaults, so that earlier results still match.
  leave_out_implied(values, copy.score, copy.ground, copy.damage, copy.command);
  if (copy.search.kind != "map-elites") {
    values.at("search").erase("map_elites");
  } else if (!copy.search.map_elites.tries_candidates_again()) {
    values.at("search").at("map_elites").erase("trials");
    values.at("search").at("map_elites").erase("challenger_share");
  }
  if (copy.evaluation.is_default()) values.erase("evaluation");
  if (copy.champion.is_default())
    values.erase("champion");
  else if (copy.champion.score == ChampionScore::as_in_evolution)
    values.at("champion").erase("score");
  return values.dump();
}

std::string Config::to_toml() const {
  Config copy = *this;
  return io::settings_to_toml([&copy](io::SettingsVisitor& visitor) { copy.describe(visitor); });
}

int candidates_per_generation(const Config& config) {
  return search::strategy_kind(config.search).candidates(config.search, config.neat);
}

}  // namespace amble::experiment
