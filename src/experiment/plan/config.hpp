#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "amble/controllers/factory.hpp"
#include "amble/core/error.hpp"
#include "amble/cppn/settings.hpp"
#include "amble/damage/settings.hpp"
#include "amble/experiment/problem/evaluation_settings.hpp"
#include "amble/ground/settings.hpp"
#include "amble/io/own_settings.hpp"
#include "amble/io/settings.hpp"
#include "amble/neat/settings.hpp"
#include "amble/record/trajectory.hpp"
#include "amble/robot/spec.hpp"
#include "amble/score/behaviour.hpp"
#include "amble/score/score.hpp"
#include "amble/search/strategies.hpp"
#include "amble/trial/commands.hpp"
#include "amble/trial/noise_settings.hpp"
#include "amble/trial/settings.hpp"

namespace amble::experiment {

/// Largest Config::seed: as a JSON number it is exact.
inline constexpr std::int64_t largest_seed = std::int64_t{1} << 53;
/// Largest Config::generations.
inline constexpr int most_generations = 1'000'000'000;

/// How the trials that decide on a champion are combined.
enum class ChampionScore {
  as_in_evolution,  ///< as those of an evaluation (trial::NoiseSettings::score)
  mean,             ///< trial::EpisodeScore::mean
  worst,            ///< trial::EpisodeScore::worst
  median,           ///< trial::EpisodeScore::median
  lower_quartile    ///< trial::EpisodeScore::lower_quartile
};
/// As configs write them, by ChampionScore.
inline constexpr std::array<std::string_view, 5> champion_score_names{"as_in_evolution", "mean", "worst",
                                                                      "median", "lower_quartile"};

/// How a run chooses its champion among the best of the generations.
struct ChampionSettings {
  /// Further trials under noise that decide, the same throughout the run, 0 … 1000. 0: the objective of its
  /// evaluation decides, luck included.
  int episodes = 0;
  ChampionScore score = ChampionScore::as_in_evolution;  ///< what counts of their scores

  void describe(io::SettingsVisitor& visitor);  ///< the table [champion]
  /// Whether no further trials decide.
  bool is_default() const { return episodes == 0; }
  /// `score`, with `of_evolution` for as_in_evolution.
  trial::EpisodeScore episode_score(trial::EpisodeScore of_evolution) const;
};

/// Everything that determines the result of a run, except the robot's own data. docs/SETTINGS.md lists each
/// key with its source. A member is the key or the table of its name; those of `neat` are tables of the top
/// level.
struct Config {
  std::string name = "unnamed";  ///< what the experiment is called in files and figures
  std::string robot;             ///< path of a robot file (TOML side file, or robot.json of a run folder)
  double drop_m = 0.0;           ///< height above the start pose at which every trial starts, 0 … 1
  std::string engine = "ode";    ///< one of physics::engine_names()
  io::OwnSettings engine_own;    ///< settings of an engine that has its own
  std::vector<std::string> referees;  ///< other engines in which each new champion is tried again
  std::int64_t seed = 1;              ///< seed of all randomness, 0 … largest_seed
  int generations = 800;              ///< to be evaluated, the initial one included, 1 … most_generations
  neat::Settings neat;                ///< genomes, their variation and species
  cppn::Settings cppn;                ///< how genomes are evaluated
  controllers::ControllerSettings controller;  ///< how a CPPN becomes a controller
  trial::Settings trial;                       ///< length and timestep of a trial
  trial::NoiseSettings noise;           ///< noise in trials, and how many make an evaluation; by default none
  trial::CommandSettings command = {};  ///< what robots are told to do; by default nothing
  EvaluationSettings evaluation;        ///< how trials are spent under noise
  score::Settings score;                ///< what makes a gait good; by default the distance
  ground::Settings ground;              ///< what robots walk on; by default the plane
  damage::Settings damage;              ///< what is wrong with the robot; by default nothing
  search::Settings search;              ///< what selects parents
  ChampionSettings champion;            ///< which of the generations' best is the run's champion
  /// Where one of these keys was set ("FILE:LINE"), for errors found later; empty unless read from a file.
  std::function<std::string(const std::vector<std::string>& keys)> locate_setting;

  void describe(io::SettingsVisitor& visitor);  ///< all of a config
  /// Rules that involve several settings; what depends on the robot is checked by Problem::make(). Throws
  /// SettingError.
  void validate() const;
  /// The error with its location prepended, if that is known.
  UserError with_location(const SettingError& error) const;
  /// The behaviour that the search compares. `robot_spec`: the problem's; null for its length and sampling
  /// alone. Throws SettingError if it does not fit.
  std::unique_ptr<const score::Behaviour> make_behaviour(const robot::RobotSpec* robot_spec = nullptr) const;
  /// All settings but the seed, and but `name`, `robot` and `generations`, which change no evaluation, as
  /// compact JSON without comments: equal for configs that give the same run for the same seed and robot.
  std::string identity() const;
  /// The whole config as TOML with comments; reads back to the same values. `locate_setting` is not in it.
  std::string to_toml() const;

  /// Whether trials differ, as far as a config says: Problem::trials_vary() knows whether commands are heard.
  bool disturbed() const;

 private:
  void check_referees() const;
  void check_evaluation() const;
  void check_tracking() const;
};

/// Genomes evaluated in a generation: of a population, or of a batch.
int candidates_per_generation(const Config& config);

}  // namespace amble::experiment
