#include "amble/experiment/adapt.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <memory>

#include "amble/adaptation/trial_and_error.hpp"
#include "amble/core/error.hpp"
#include "amble/experiment/episodes.hpp"
#include "amble/experiment/evaluator.hpp"
#include "amble/io/json_file.hpp"
#include "amble/io/text.hpp"
#include "amble/neat/genome_io.hpp"
#include "amble/search/map_elites.hpp"

namespace amble::experiment {
namespace {

constexpr int adaptation_version = 1;

/// A map's problem in another engine, with damage.
Problem problem_in(const Repertoire& repertoire, const std::string& engine, const damage::Settings& damage) {
  Problem problem = repertoire.problem;
  problem.noise.score = trial::EpisodeScore::mean;
  problem.engine = engine;
  problem.complete();
  problem.set_damage(damage);
  return problem;
}

/// Trials of elites on one robot in one engine.
class Reality {
 public:
  Reality(const Repertoire& repertoire, const std::string& engine, const damage::Settings& damage, int jobs)
      : repertoire_(repertoire), problem_(problem_in(repertoire, engine, damage)) {
    ground_ = problem_.make_ground(ground_of(episode_key(EpisodeSet::unseen, repertoire.config.seed)));
    evaluator_ = std::make_unique<Evaluator>(problem_, record::PathSampling(), jobs);
  }

  /// Mean objective of an elite over `count` trials, from the `first`-th of those unseen during evolution.
  std::optional<double> trials(std::uint32_t number, int first, int count, const std::atomic<bool>& stop) {
    const neat::Genome genome = neat::expand(repertoire_.elites[number].genome, "archive.bin");
    const auto scenarios =
        unseen_scenarios(problem_, repertoire_.config.seed, first, count, ground_.get(), stop);
    if (!scenarios) return std::nullopt;
    const auto result = evaluator_->evaluate(std::span(&genome, 1), stop, *scenarios, ground_);
    if (!result) return std::nullopt;
    return objectives(problem_, *result).front();
  }

 private:
  const Repertoire& repertoire_;
  Problem problem_;
  std::shared_ptr<const ground::Ground> ground_;
  std::unique_ptr<Evaluator> evaluator_;
};

/// The elites, each descriptor scaled to 0 … 1 over its range.
std::vector<adaptation::Candidate> candidates_of(const Repertoire& repertoire) {
  const auto& dimensions = repertoire.config.search.map_elites.descriptors;
  std::vector<adaptation::Candidate> candidates(repertoire.elites.size());
  for (std::uint32_t i = 0; i < repertoire.elites.size(); ++i) {
    candidates[i].expected = repertoire.elites[i].objective;
    const auto descriptor = repertoire.elites.descriptor(i);
    for (std::size_t d = 0; d < dimensions.size(); ++d)
      candidates[i].descriptor.push_back(std::clamp(
          (double{descriptor[d]} - dimensions[d].least) / (dimensions[d].most - dimensions[d].least), 0.0,
          1.0));
  }
  return candidates;
}

}  // namespace

Problem damaged_problem(const Repertoire& repertoire, const AdaptSettings& settings) {
  return problem_in(repertoire, settings.engine, settings.damage);
}

std::optional<Adaptation> adapt(const Repertoire& repertoire, const AdaptSettings& settings, int jobs,
                                const std::atomic<bool>& stop) {
  const search::Elites& elites = repertoire.elites;
  if (!(elites.best_objective() > 0.0))
    fail(ExitCode::bad_input, "the map has no elite that gets anywhere: there is nothing to adapt with");
  if (settings.episodes > 1 && !repertoire.problem.trials_vary())
    fail(ExitCode::bad_input, "--episodes {}: the map was made without noise: all attempts are the same",
         settings.episodes);
  Reality intact(repertoire, settings.engine, repertoire.problem.damage, jobs);
  Reality damaged(repertoire, settings.engine, settings.damage, jobs);
  adaptation::TrialAndErrorSettings how = settings.search;
  auto circles = repertoire.config.make_behaviour()->circles();
  circles.resize(repertoire.config.search.map_elites.descriptors.size());
  how.turns = search::turns_of(repertoire.config.search.map_elites, circles);
  adaptation::TrialAndError search(candidates_of(repertoire), how);
  Adaptation adaptation;
  const auto best = static_cast<std::uint32_t>(search.next());
  while (adaptation.steps.size() < static_cast<std::size_t>(settings.most_trials) && !search.done()) {
    const std::size_t candidate = search.next();
    const auto number = static_cast<std::uint32_t>(candidate);
    AdaptStep step{.cell = elites[number].cell,
                   .expected = elites[number].objective,
                   .predicted = search.mean(candidate),
                   .deviation = search.deviation(candidate)};
    // Judging trials come first in the numbering, so that they are unseen by the search.
    const int first = settings.test_trials + static_cast<int>(adaptation.steps.size()) * settings.episodes;
    const auto measured = damaged.trials(number, first, settings.episodes, stop);
    if (!measured) return std::nullopt;
    step.measured = *measured;
    search.tell(candidate, *measured);
    adaptation.steps.push_back(step);
  }
  adaptation.done = search.done();
  const auto found = static_cast<std::uint32_t>(search.best());
  adaptation.cell = elites[found].cell;
  const auto before = intact.trials(best, 0, settings.test_trials, stop);
  if (!before) return std::nullopt;
  const auto after = damaged.trials(best, 0, settings.test_trials, stop);
  if (!after) return std::nullopt;
  const auto adapted = damaged.trials(found, 0, settings.test_trials, stop);
  if (!adapted) return std::nullopt;
  adaptation.intact = *before;
  adaptation.damaged = *after;
  adaptation.adapted = *adapted;
  return adaptation;
}

std::string adaptation_json(const Adaptation& adaptation, const Repertoire& repertoire,
                            const AdaptSettings& settings, const std::string& damage) {
  io::Json steps = io::Json::array();
  for (const auto& step : adaptation.steps)
    steps.push_back({{"cell", step.cell},
                     {"expected", step.expected},
                     {"predicted", step.predicted},
                     {"deviation", step.deviation},
                     {"measured", step.measured}});
  return io::sealed_json("amble-adaptation", adaptation_version,
                         {{"experiment", repertoire.config.name},
                          {"seed", repertoire.config.seed},
                          {"engine", settings.engine},
                          {"damage", damage},
                          {"episodes", settings.episodes},
                          {"intact", adaptation.intact},
                          {"damaged", adaptation.damaged},
                          {"adapted", adaptation.adapted},
                          {"cell", adaptation.cell},
                          {"done", adaptation.done},
                          {"trials", std::move(steps)}});
}

}  // namespace amble::experiment
