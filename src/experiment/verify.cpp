#include "amble/experiment/verify.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <span>
#include <vector>

#include "amble/core/error.hpp"
#include "amble/core/index.hpp"
#include "amble/experiment/champion.hpp"
#include "amble/experiment/problem/problem_json.hpp"
#include "amble/experiment/replay.hpp"
#include "amble/io/file.hpp"
#include "amble/io/json_file.hpp"

namespace amble::experiment {
namespace {

/// A trial recorded in a champion's file.
struct Recorded {
  const TrialResult& result;
  const std::vector<std::uint32_t>& trace;
  std::string prefix;  ///< of messages about it
};

/// Appends descriptions of the differences between a recorded trial and its repetition.
void compare(const Recorded& old, const Replay& again, double timestep_s, std::vector<std::string>& found) {
  const auto [old_end, new_end] = std::ranges::mismatch(old.trace, again.trace);
  if (old_end != old.trace.end() || new_end != again.trace.end()) {
    const auto step = old_end - old.trace.begin() + 1;
    found.push_back(fmt::format("{}first differing step {} (t = {:.2f} s)", old.prefix, step,
                                static_cast<double>(step) * timestep_s));
  }
  if (old.result.distance_m != again.result.distance_m)
    found.push_back(fmt::format("{}distance {} m recorded, {} m now", old.prefix, old.result.distance_m,
                                again.result.distance_m));
  if (old.result.score != again.result.score)
    found.push_back(
        fmt::format("{}score {} recorded, {} now", old.prefix, old.result.value(), again.result.value()));
  if (old.result.outcome != again.result.outcome || old.result.steps != again.result.steps) {
    const auto words = [](const TrialResult& result) {
      return fmt::format("{} after {} steps", record::outcome_names[to_index(result.outcome)], result.steps);
    };
    found.push_back(fmt::format("{}{} recorded, {} now", old.prefix, words(old.result), words(again.result)));
  }
}

/// Runs all trials of a champion again; returns descriptions of the differences. Nothing if `stop` was set.
std::optional<std::vector<std::string>> differences(const Champion& champion, const std::atomic<bool>& stop) {
  std::vector<std::string> found;
  const double timestep_s = champion.problem.trial.timestep_s;
  const auto again = replay(champion.problem, champion.genome, {}, stop);
  if (!again) return std::nullopt;
  compare({champion.result, champion.trace, ""}, *again, timestep_s, found);
  for (std::size_t i = 0; i < champion.episodes.size(); ++i) {
    ReplayOptions options;
    options.noise = champion.scenario_key(i);
    const auto disturbed = replay(champion.problem, champion.genome, options, stop);
    if (!disturbed) return std::nullopt;
    const auto& [result, trace] = champion.episodes[i];
    compare({result, trace, fmt::format("under noise {}: ", i)}, *disturbed, timestep_s, found);
  }
  return found;
}

std::string agreement(const Champion& champion) {
  std::string text =
      fmt::format("agrees: {:.3f} m, {} steps", champion.result.distance_m, champion.result.steps);
  if (!champion.episodes.empty())
    text += fmt::format("; under noise {} ({} of {})",
                        score::with_unit(fmt::format("{:.3f}", champion.objective()), champion.problem.score),
                        trial::episode_score_names[to_index(champion.problem.noise.score)],
                        champion.episodes.size());
  return text;
}

/// Appends descriptions of what shows that a champion is not of the run `origin`.
void compare(const Champion& champion, const std::filesystem::path& path, const Origin& origin,
             std::vector<std::string>& found) {
  if (champion.seed != origin.config.seed)
    found.push_back(fmt::format("its seed is {}, the run's {}", champion.seed, origin.config.seed));
  if (path.filename() != RunPaths("").champion(champion.generation).filename())
    found.push_back(fmt::format("it is of generation {}, not of that in its name", champion.generation));
  const auto own = problem_json(champion.problem), expected = problem_json(origin.problem);
  for (const auto& [key, value] : expected.items())
    if (own.value(key, io::Json()) != value) found.push_back(fmt::format("its {} is not the run's", key));
  for (const auto& [key, value] : own.items())
    if (!expected.contains(key)) found.push_back(fmt::format("its {} is not the run's", key));
  const auto& noise = champion.problem.noise;
  trial::NoiseSettings expected_noise = origin.problem.noise;
  expected_noise.episodes = origin.config.evaluation.episodes_of_best(expected_noise.episodes);
  // Without noise a champion's file has no settings of noise.
  if ((noise.any() || expected_noise.any()) &&
      io::settings_to_json(noise) != io::settings_to_json(expected_noise))
    found.push_back("its noise is not the run's");

  const auto generation = to_index(champion.generation);
  if (generation >= origin.table.count()) return;  // ahead of the table, if the run was killed then
  const double best = origin.table.best[generation];
  // With `champion.episodes` a champion may have the objective of the one before, which the table cannot
  // tell.
  if (origin.config.champion.is_default() && !record::keeps_champion(origin.table, generation))
    found.push_back("the run kept no champion of its generation");
  else if (champion.objective() != best)
    found.push_back(fmt::format("it reached {}, the run's {}", champion.objective(), best));
}

}  // namespace

Origin origin_of(const RunPaths& paths) {
  Origin origin{.config = load_config(paths.config, {}), .problem = {}};
  origin.problem = Problem::make(origin.config, load_robot_file(paths.robot));
  return origin;
}

std::optional<Verification> verify_champion(const std::filesystem::path& path, const std::atomic<bool>& stop,
                                            const Origin* origin) {
  const std::string text = io::read_file(path);
  try {
    const auto [champion, altered] = parse_champion(text, path.string(), io::Altered::accept);
    auto found = differences(champion, stop);
    if (!found) return std::nullopt;
    if (origin != nullptr) compare(champion, path, *origin, *found);
    if (altered) found->insert(found->begin(), "the file was altered (checksum)");
    if (!found->empty()) return Verification{false, fmt::format("differs: {}", fmt::join(*found, "; "))};
    return Verification{true, agreement(champion)};
  } catch (const UserError& error) {
    return Verification{false, fmt::format("unsound: {}", error.what())};
  }
}

}  // namespace amble::experiment
