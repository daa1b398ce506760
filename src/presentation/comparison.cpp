#include "amble/presentation/comparison.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <mutex>
#include <utility>

#include "amble/core/error.hpp"
#include "amble/core/index.hpp"
#include "amble/experiment/episodes.hpp"
#include "amble/physics/engine.hpp"
#include "amble/record/recording.hpp"

namespace amble::presentation {
namespace {

/// Engines of robots' own models are for those that carry one, intact; the others for servos that do not hold
/// their torques.
bool can_simulate(std::string_view engine, const experiment::Problem& problem) {
  if (physics::engine_traits(engine).of_original_model)
    return problem.robot.original && !problem.damage.changes_body();
  return std::ranges::none_of(problem.robot.joints,
                              [](const robot::Joint& joint) { return joint.servo.hold_torque; });
}

/// The requested engines and every champion's own, with which the others are compared.
std::vector<std::string> engines_of(const std::vector<std::string>& requested,
                                    const std::vector<NamedChampion>& champions) {
  for (const auto& engine : requested) physics::check_engine_name(engine, "--engines: ");
  const auto wanted = [&](const std::string& name) {
    const bool asked = requested.empty()
                           ? std::ranges::all_of(champions,
                                                 [&](const NamedChampion& named) {
                                                   return !physics::engine_traits(name).only_if_named &&
                                                          can_simulate(name, named.champion.problem);
                                                 })
                           : std::ranges::count(requested, name) > 0;
    return asked || std::ranges::any_of(champions, [&](const NamedChampion& named) {
             return named.champion.problem.engine == name;
           });
  };
  std::vector<std::string> engines;
  for (const auto& name : physics::engine_names())
    if (wanted(std::string(name))) engines.emplace_back(name);
  return engines;
}

/// The trials that tell what a champion typically does, the same in all engines.
std::vector<trial::ScenarioKey> typical_keys(const experiment::Champion& champion, int trials) {
  trial::ScenarioKey key = experiment::episode_key(experiment::EpisodeSet::typical, champion.seed);
  std::vector<trial::ScenarioKey> keys;
  for (int i = 0; i < trials; ++i, ++key.episode) keys.push_back(key);
  return keys;
}

/// Noise that evolution has not used: its episodes have lower numbers.
std::vector<trial::ScenarioKey> unseen_noise(const experiment::Champion& champion, std::uint32_t episodes) {
  std::vector<trial::ScenarioKey> keys;
  for (std::uint32_t e = 0; e < episodes; ++e) keys.push_back(champion.unseen_scenario_key(e));
  return keys;
}

/// One key for each trial in an engine; none: one trial without noise.
std::vector<trial::ScenarioKey> trial_keys(const experiment::Champion& champion,
                                           const CompareOptions& options) {
  if (options.disturbance.undisturbed) return {};
  if (options.episodes) return unseen_noise(champion, *options.episodes);
  const int asked = options.disturbance.trials;
  return typical_keys(champion, asked > 0 ? asked : experiment::running_trials);
}

std::optional<ComparedChampion> row_of(const NamedChampion& named, double seconds,
                                       const std::vector<std::string>& engines, const CompareOptions& options,
                                       const std::function<void()>& on_trial, const std::atomic<bool>& stop) {
  auto [name, champion] = named;
  const experiment::RefereeOptions referee_options{.seconds = seconds,
                                                   .jobs = static_cast<int>(engines.size()),
                                                   .noise = trial_keys(champion, options),
                                                   .on_trial = on_trial};
  std::string under = "without noise";
  if (!options.disturbance.undisturbed) {
    const auto level = level_of(champion.problem, options.disturbance);
    champion.problem.noise = level.noise;
    under = level.under();
  }
  try {
    auto results =
        experiment::try_in_engines(champion.problem, champion.genome, engines, referee_options, stop);
    if (!results) return std::nullopt;
    return ComparedChampion{.name = name,
                            .home = champion.problem.engine,
                            .trial_s = seconds,
                            .under = under,
                            .in = std::move(*results)};
  } catch (const UserError& error) {
    fail(error.code(), "{}: {} (--engines chooses engines)", name, error.what());
  }
}

}  // namespace

double ComparedChampion::home_m() const {
  return std::ranges::find(in, home, &experiment::EngineResult::engine)->distance_m();
}

std::optional<std::vector<ComparedChampion>> compare(const std::vector<NamedChampion>& champions,
                                                     const CompareOptions& options,
                                                     const std::atomic<bool>& stop) {
  const auto engines = engines_of(options.engines, champions);
  const std::size_t lengths = std::max<std::size_t>(options.seconds.size(), 1);
  std::size_t trials = 0;
  for (const auto& named : champions)
    trials += lengths * engines.size() * std::max<std::size_t>(trial_keys(named.champion, options).size(), 1);
  std::mutex counting;
  std::size_t done = 0;
  const auto count = [&] {
    const std::lock_guard lock(counting);
    ++done;
    if (options.on_trial) options.on_trial(done, trials);
  };
  std::vector<ComparedChampion> rows;
  for (const auto& named : champions) {
    auto lengths_s = options.seconds;
    if (lengths_s.empty()) lengths_s.push_back(named.champion.problem.trial.duration_s);
    for (const double length_s : lengths_s) {
      auto row = row_of(named, length_s, engines, options, count, stop);
      if (!row) return std::nullopt;
      rows.push_back(std::move(*row));
    }
  }
  return rows;
}

io::Json comparison_json(const std::vector<ComparedChampion>& rows,
                         const std::vector<experiment::ComparedMap>& maps) {
  io::Json list = io::Json::array();
  for (const auto& row : rows) {
    io::Json results = io::Json::array();
    for (const auto& result : row.in) {
      io::Json trials = io::Json::array();
      for (const auto& trial : result.trials)
        trials.push_back({{"distance_m", trial.distance_m},
                          {"seconds", trial.seconds},
                          {"outcome", record::outcome_names[to_index(trial.outcome)]}});
      results.push_back(
          {{"engine", result.engine}, {"distance_m", result.distance_m()}, {"trials", std::move(trials)}});
      if (const auto kept = experiment::share_kept(result.distance_m(), row.home_m()))
        results.back()["kept"] = *kept;
    }
    list.push_back({{"champion", row.name},
                    {"evolved_in", row.home},
                    {"trial_s", row.trial_s},
                    {"under", row.under},
                    {"results", std::move(results)}});
    const auto map = std::ranges::find(maps, row.name, &experiment::ComparedMap::name);
    if (map != maps.end()) list.back()["map"] = map_json(*map);
  }
  return list;
}

}  // namespace amble::presentation
