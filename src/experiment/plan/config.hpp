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

inline constexpr std::int64_t largest_seed = std::int64_t{1} << 53;  ///< as a JSON number it is exact
inline constexpr int most_generations = 1'000'000'000;

/// How the trials that decide on a champion are combined: as those of an evaluation (NoiseSettings::score),
/// or as trial::EpisodeScore says.
enum class ChampionScore { as_in_evolution, mean, worst, median, lower_quartile };
inline constexpr std::array<std::string_view, 5> champion_score_names{"as_in_evolution", "mean", "worst",
                                                                      "median", "lower_quartile"};

/// How a run chooses its champion among the best of the generations.
struct ChampionSettings {
  int episodes = 0;  ///< 0: by the objective of its evaluation
  ChampionScore score = ChampionScore::as_in_evolution;

  void describe(io::SettingsVisitor& visitor);
  bool is_default() const { return episodes == 0; }
  trial::EpisodeScore episode_score(trial::EpisodeScore of_evolution) const;
};

/// Everything that determines the result of a run, except the robot's own data. docs/SETTINGS.md lists each
/// key with its source.
struct Config {
  std::string name = "unnamed";
  std::string robot;    ///< robot file (TOML side file, or robot.json of a run folder)
  double drop_m = 0.0;  ///< height above the start pose at which every trial starts
  std::string engine = "ode";
  io::OwnSettings engine_own;         ///< of an engine that a program or a plugin has added
  std::vector<std::string> referees;  ///< engines in which each new champion is tried again
  std::int64_t seed = 1;
  int generations = 800;
  neat::Settings neat;
  cppn::Settings cppn;
  controllers::ControllerSettings controller;
  trial::Settings trial;
  trial::NoiseSettings noise;
  trial::CommandSettings command = {};
  EvaluationSettings evaluation;
  score::Settings score;
  ground::Settings ground;
  damage::Settings damage;
  search::Settings search;
  ChampionSettings champion;
  /// Where one of these keys was set ("FILE:LINE"), for errors found later; empty unless read from a file.
  std::function<std::string(const std::vector<std::string>& keys)> locate_setting;

  void describe(io::SettingsVisitor& visitor);
  /// Rules that involve several settings. Throws SettingError.
  void validate() const;
  /// The error with its location prepended, if that is known.
  UserError with_location(const SettingError& error) const;
  /// The behaviour that the search compares. `robot_spec`: the problem's; null for its length and sampling
  /// alone. Throws SettingError if it does not fit.
  std::unique_ptr<const score::Behaviour> make_behaviour(const robot::RobotSpec* robot_spec = nullptr) const;
  /// All settings but the seed, and but `name`, `robot` and `generations`, which change no evaluation, as
  /// compact JSON without comments: equal for configs that give the same run for the same seed and robot.
  std::string identity() const;
  /// The whole config as TOML with comments; reads back to the same values.
  std::string to_toml() const;

 private:
  void check_referees() const;
  void check_evaluation() const;
  void check_tracking() const;
  /// Whether trials differ.
  bool disturbed() const;
};

/// Genomes evaluated in a generation: of a population, or of a batch.
int candidates_per_generation(const Config& config);

}  // namespace amble::experiment
