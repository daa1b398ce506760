#include "amble/experiment/mutants.hpp"

#include <algorithm>
#include <cmath>
#include <memory>

#include "amble/core/random.hpp"
#include "amble/experiment/episodes.hpp"
#include "amble/experiment/evaluator.hpp"
#include "amble/neat/innovations.hpp"
#include "amble/neat/mutation.hpp"
#include "amble/score/behaviour.hpp"

namespace amble::experiment {
namespace {

constexpr int block = 1024;  ///< genomes evaluated at a time, so that many mutants take no more memory

neat::Genome mutant_of(const neat::Genome& parent, const neat::Settings& neat, bool recurrent,
                       std::int64_t seed, int number) {
  neat::Genome genome = parent;
  auto innovations = neat::Innovations::beyond(parent, neat.innovations.key);
  Stream stream(static_cast<std::uint64_t>(seed), Purpose::mutants, 0, static_cast<std::uint32_t>(number));
  neat::mutate(genome, neat, recurrent, innovations, stream);
  return genome;
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

/// How a genome walks, in the mean over the trials.
struct Walk {
  double score = 0.0;
  std::vector<float> gait;
};

/// The trials that all genomes meet.
class Trials {
 public:
  Trials(const Problem& problem, std::span<const trial::ScenarioKey> keys, int jobs)
      : problem_(with_mean_scores(problem)),
        gait_(duty_factors(problem.robot)),
        evaluator_(problem_, record::PathSampling(), jobs, gait_->measures()),
        ground_(problem_.make_ground(keys.empty() ? problem.ground_key : ground_of(keys.front()))) {
    for (const auto& key : keys) scenarios_.push_back(problem_.scenario(key, ground_.get()));
  }

  std::optional<std::vector<Walk>> of(std::span<const neat::Genome> genomes, const std::atomic<bool>& stop) {
    const auto result = evaluator_.evaluate(genomes, stop, scenarios_, ground_);
    if (!result) return std::nullopt;
    const auto scores = objectives(problem_, *result);
    std::vector<Walk> walks;
    for (std::size_t i = 0; i < genomes.size(); ++i)
      walks.push_back({scores[i], gait_->of(result->of_genome(i))});
    return walks;
  }

 private:
  static Problem with_mean_scores(Problem problem) {
    problem.noise.score = trial::EpisodeScore::mean;
    return problem;
  }

  Problem problem_;
  std::unique_ptr<const score::Behaviour> gait_;
  Evaluator evaluator_;
  std::shared_ptr<const ground::Ground> ground_;
  std::vector<trial::Scenario> scenarios_;
};

}  // namespace

std::optional<MutationOutcome> try_mutants(const Problem& problem, const neat::Settings& neat,
                                           const neat::Genome& genome, int count, std::int64_t seed,
                                           std::span<const trial::ScenarioKey> keys, int jobs,
                                           const std::atomic<bool>& stop) {
  Trials trials(problem, keys, jobs);
  const auto own = trials.of(std::span(&genome, 1), stop);
  if (!own) return std::nullopt;
  const Walk& parent = own->front();
  MutationOutcome outcome{.score = parent.score, .mutants = {}};
  for (int first = 0; first < count; first += block) {
    std::vector<neat::Genome> mutants;
    for (int i = first; i < std::min(first + block, count); ++i)
      mutants.push_back(mutant_of(genome, neat, problem.cppn.recurrent, seed, i));
    const auto walks = trials.of(mutants, stop);
    if (!walks) return std::nullopt;
    for (const Walk& walk : *walks)
      outcome.mutants.push_back({.kept = parent.score > 0.0 ? walk.score / parent.score : 0.0,
                                 .change = mean_difference(walk.gait, parent.gait)});
  }
  return outcome;
}

}  // namespace amble::experiment
