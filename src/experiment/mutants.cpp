#include "amble/experiment/mutants.hpp"

#include <cmath>
#include <memory>
#include <span>

#include "amble/core/index.hpp"
#include "amble/core/random.hpp"
#include "amble/experiment/episodes.hpp"
#include "amble/experiment/evaluator.hpp"
#include "amble/neat/innovations.hpp"
#include "amble/neat/mutation.hpp"
#include "amble/score/behaviour.hpp"

namespace amble::experiment {
namespace {

/// The genome itself, then its mutants.
std::vector<neat::Genome> family(const Problem& problem, const neat::Settings& neat,
                                 const neat::Genome& genome, std::int64_t seed, int count) {
  std::vector<neat::Genome> genomes(to_index(count) + 1, genome);
  for (std::size_t i = 1; i < genomes.size(); ++i) {
    auto innovations = neat::Innovations::beyond(genome, neat.innovations.key);
    Stream stream(static_cast<std::uint64_t>(seed), Purpose::mutants, 0, static_cast<std::uint32_t>(i - 1));
    neat::mutate(genomes[i], neat, problem.cppn.recurrent, innovations, stream);
  }
  return genomes;
}

/// The duty factor of each leg.
std::unique_ptr<const score::Behaviour> duty_factors(const robot::RobotSpec& robot) {
  score::BehaviourSettings settings;
  for (const auto& leg : robot.legs) {
    settings.descriptors.push_back({"duty_factor", leg.name});
    settings.leg_names.push_back(leg.name);
  }
  return score::make_behaviour("descriptors", settings);
}

double mean_difference(std::span<const float> some, std::span<const float> others) {
  double sum = 0.0;
  for (std::size_t i = 0; i < some.size(); ++i) sum += std::abs(double{some[i]} - double{others[i]});
  return some.empty() ? 0.0 : sum / static_cast<double>(some.size());
}

}  // namespace

std::optional<std::vector<record::Mutant>> try_mutants(const Problem& problem, const neat::Settings& neat,
                                                       const neat::Genome& genome, std::int64_t seed,
                                                       const MutantSettings& settings, int jobs,
                                                       const std::atomic<bool>& stop) {
  Problem same = problem;
  same.noise.score = trial::EpisodeScore::mean;
  const auto ground = same.make_ground(ground_of(unseen_key(seed)));
  const auto scenarios = unseen_scenarios(same, seed, 0, settings.episodes, ground.get());
  const auto gait = duty_factors(same.robot);
  const auto genomes = family(same, neat, genome, seed, settings.count);
  Evaluator evaluator(same, record::PathSampling(), jobs, gait->measures());
  const auto result = evaluator.evaluate(genomes, stop, scenarios, ground);
  if (!result) return std::nullopt;

  const auto scores = objectives(same, *result);
  const auto own = gait->of(result->of_genome(0));
  std::vector<record::Mutant> mutants;
  for (std::size_t i = 1; i < genomes.size(); ++i)
    mutants.push_back({.kept = scores.front() > 0.0 ? scores[i] / scores.front() : 0.0,
                       .change = mean_difference(gait->of(result->of_genome(i)), own)});
  return mutants;
}

}  // namespace amble::experiment
