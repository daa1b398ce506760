#include "amble/experiment/switching_champion.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "amble/core/error.hpp"
#include "amble/experiment/champion_choice.hpp"
#include "amble/neat/genome_io.hpp"

namespace amble::experiment {
namespace {

/// Where a descriptor has a quantity.
std::size_t dimension_of(const Config& config, std::string_view quantity) {
  const auto& descriptors = config.search.map_elites.descriptors;
  const auto found = std::ranges::find(descriptors, quantity, &search::DescriptorSettings::quantity);
  if (found == descriptors.end())
    fail(ExitCode::bad_input,
         "{}: the map has no dimension {}; expected one of speeds and turns, as configs/steer/map.toml makes",
         config.name, quantity);
  return static_cast<std::size_t>(found - descriptors.begin());
}

/// The best elite of each cell of the corrected map, if it is worth half of the best of all.
std::vector<PickedGait> candidates(const Repertoire& repertoire, const CorrectedMap& corrected) {
  const std::size_t speed = dimension_of(repertoire.config, "own_speed");
  const std::size_t turn = dimension_of(repertoire.config, "yaw_rate");
  std::map<std::uint32_t, std::uint32_t> best;
  double most = 0.0;
  for (std::uint32_t number = 0; number < corrected.elites.size(); ++number) {
    const TypicalElite& elite = corrected.elites[number];
    if (elite.typical_cell == search::Elites::none) continue;
    most = std::max(most, elite.objective);
    const auto [entry, is_new] = best.try_emplace(elite.typical_cell, number);
    if (!is_new && elite.objective > corrected.elites[entry->second].objective) entry->second = number;
  }
  std::vector<PickedGait> found;
  for (const auto& [cell, number] : best) {
    const TypicalElite& elite = corrected.elites[number];
    if (elite.objective < 0.5 * most) continue;
    found.push_back(
        {number, static_cast<double>(elite.descriptor[speed]), static_cast<double>(elite.descriptor[turn])});
  }
  if (found.empty())
    fail(ExitCode::bad_input, "{}: no elite of the map does anything in new trials", repertoire.config.name);
  return found;
}

double range_of(const std::vector<PickedGait>& gaits, double PickedGait::*part) {
  const auto [least, most] = std::ranges::minmax_element(gaits, {}, part);
  const double range = (*most).*part - (*least).*part;
  return range > 0.0 ? range : 1.0;
}

/// A number of two decimals that is no larger.
double rounded_down(double value) {
  return std::floor(100.0 * value) / 100.0;
}

/// Commands that the gaits can follow.
trial::CommandSettings commands_within(const std::vector<PickedGait>& gaits) {
  trial::CommandSettings commands{.kind = trial::CommandKind::random};
  const auto [slowest, fastest] = std::ranges::minmax_element(gaits, {}, &PickedGait::speed_m_s);
  const auto [right, left] = std::ranges::minmax_element(gaits, {}, &PickedGait::turn_rad_s);
  commands.most_speed_m_s = std::max(0.0, rounded_down(fastest->speed_m_s));
  commands.least_speed_m_s = std::clamp(0.25 * commands.most_speed_m_s, 0.0, commands.most_speed_m_s);
  commands.most_turn_rad_s = rounded_down(std::max(0.0, std::min(left->turn_rad_s, -right->turn_rad_s)));
  return commands;
}

neat::Genome genome_of(const Repertoire& repertoire, const PickedGait& gait) {
  return neat::expand(repertoire.elites[gait.number].genome, "archive.bin");
}

}  // namespace

void check_can_switch(const Config& config) {
  if (!fills_map(config))
    fail(ExitCode::bad_input,
         "the config has search.kind = \"{}\"; expected \"map-elites\", as in configs/steer/map.toml",
         config.search.kind);
  dimension_of(config, "own_speed");
  dimension_of(config, "yaw_rate");
  if (config.controller.kind != "supg")
    fail(ExitCode::bad_input,
         "{}: legs take over another gait at the triggers of SUPGs, and the controller is of kind \"{}\"",
         config.name, config.controller.kind);
}

std::vector<PickedGait> pick_gaits(const Repertoire& repertoire, const CorrectedMap& corrected, int count) {
  std::vector<PickedGait> left = candidates(repertoire, corrected);
  const double speeds = range_of(left, &PickedGait::speed_m_s);
  const double turns = range_of(left, &PickedGait::turn_rad_s);
  const auto straight = [&](const PickedGait& gait) {
    return gait.speed_m_s / speeds - 2.0 * std::abs(gait.turn_rad_s) / turns;
  };
  std::vector<PickedGait> picked;
  std::vector<double> apart(left.size(), std::numeric_limits<double>::infinity());
  auto next = static_cast<std::size_t>(std::ranges::max_element(left, {}, straight) - left.begin());
  while (picked.size() < static_cast<std::size_t>(count) && apart[next] > 0.0) {
    picked.push_back(left[next]);
    for (std::size_t i = 0; i < left.size(); ++i)
      apart[i] = std::min(apart[i], std::hypot((left[i].speed_m_s - left[next].speed_m_s) / speeds,
                                               (left[i].turn_rad_s - left[next].turn_rad_s) / turns));
    next = static_cast<std::size_t>(std::ranges::max_element(apart) - apart.begin());
  }
  return picked;
}

std::optional<Champion> switching_champion(const Repertoire& repertoire, const std::vector<PickedGait>& gaits,
                                           double heading_gain, int jobs, const std::atomic<bool>& stop) {
  Problem problem = repertoire.problem;
  problem.controller.switching = {.heading_gain = heading_gain};
  for (const PickedGait& gait : gaits)
    problem.controller.switching.gaits.push_back({.speed_m_s = gait.speed_m_s,
                                                  .turn_rad_s = gait.turn_rad_s,
                                                  .genome = neat::genome_text(genome_of(repertoire, gait))});
  problem.command = commands_within(gaits);
  problem.trial.duration_s = 15.0;
  problem.score = {.terms = {{.quantity = "tracking"}}};
  problem.complete();
  const search::Elite& first = repertoire.elites[gaits.front().number];
  const neat::Genome genome = genome_of(repertoire, gaits.front());
  StageTimes times;
  return try_champion(repertoire.config, problem,
                      {.generation = static_cast<int>(first.round),
                       .index = static_cast<int>(first.candidate),
                       .genome = genome,
                       .objective = std::nullopt},
                      jobs, times, stop);
}

}  // namespace amble::experiment
