#include "amble/experiment/config.hpp"

#include <algorithm>

#include "amble/core/error.hpp"
#include "amble/io/toml_settings.hpp"
#include "amble/physics/engine.hpp"
#include "amble/score/path_behaviour.hpp"

namespace amble::experiment {

void Config::describe(io::SettingsVisitor& visitor) {
  visitor.text("name", name, {"what this experiment is called in files and figures"});
  visitor.text("robot", robot, {"robot file, relative to the config file"});
  visitor.number("drop_m", drop_m, {0.0, 1.0},
                 {"each trial starts with the robot let go so high above its start pose, m",
                  "Morse et al. 2013 and the authors' code: feet on the ground (0)"});
  visitor.text("engine", engine, {"physics engine: ode, batch or mujoco", "Morse et al. 2013, sec. 4 (ode)"});
  visitor.texts("referees", referees,
                {"engines in which each new champion is tried again; its file says how far it comes there"});
  visitor.integer("seed", seed, {0, 9007199254740992.0}, {"seed of all randomness"});
  visitor.integer("generations", generations, {1, 1e9},
                  {"generations to evaluate, the initial one included", "Morse et al. 2013, sec. 4"});
  neat.describe(visitor);
  visitor.table("cppn", cppn, {"the compositional pattern producing network"});
  visitor.table("controller", controller, {"how a CPPN becomes a controller"});
  visitor.table("trial", trial, {"one trial of one controller"});
  visitor.table("noise", noise, {"noise in trials, and how many of them make an evaluation; off by default"});
  visitor.table("search", search, {"what selects parents"});
}

void Config::validate() const {
  if (robot.empty()) fail(ExitCode::bad_input, "key 'robot' is missing: expected the path of a robot file");
  physics::check_engine_name(engine);
  check_referees();
  neat.validate();
  trial.validate();
  noise.validate(trial);
  if (search.kind == search::Kind::novelty) search.novelty.validate(behaviour_length());
}

void Config::check_referees() const {
  for (auto referee = referees.begin(); referee != referees.end(); ++referee) {
    physics::check_engine_name(*referee, "referees: ");
    if (*referee == engine)
      fail(ExitCode::bad_input, "referees: '{}' is the engine of the run itself", *referee);
    if (std::find(referees.begin(), referee, *referee) != referee)
      fail(ExitCode::bad_input, "referees: '{}' is named twice", *referee);
  }
}

std::size_t Config::behaviour_length() const {
  return score::path_behaviour_length(trial.steps(), search.path_stride());
}

std::string Config::to_toml() const {
  Config copy = *this;
  return io::settings_to_toml([&copy](io::SettingsVisitor& visitor) { copy.describe(visitor); });
}

Config load_config(const std::filesystem::path& path, const Overrides& overrides) {
  auto document = io::TomlDocument::read(path);
  for (const auto& assignment : overrides.assignments) document.set(assignment);
  if (overrides.seed) document.set("seed=" + std::to_string(*overrides.seed));
  if (overrides.generations) document.set("generations=" + std::to_string(*overrides.generations));

  Config config;
  const auto reader = document.reader();
  config.describe(*reader);
  reader->finish();
  try {
    config.validate();
  } catch (const UserError& error) {
    fail(error.code(), "{}: {}", path.string(), error.what());
  }
  const std::filesystem::path robot = config.robot;
  if (robot.is_relative()) config.robot = (document.folder_of("robot") / robot).lexically_normal().string();
  return config;
}

}  // namespace amble::experiment
