#include "amble/browser/evolution.hpp"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <span>
#include <utility>

#include "amble/browser/session.hpp"
#include "amble/core/check.hpp"
#include "amble/core/index.hpp"
#include "amble/experiment/plan/told_generation.hpp"
#include "amble/io/json_file.hpp"
#include "amble/neat/population.hpp"
#include "amble/score/score.hpp"
#include "amble/search/generational.hpp"

namespace amble::browser {
namespace {

EvolutionSettings settings_from(const std::string& json) {
  const io::Json parsed = io::parse_json(json, "settings");
  return io::settings_from_json<EvolutionSettings>(io::JsonView(parsed, "settings"));
}

/// As in configs/quick.
neat::Settings neat_settings(const EvolutionSettings& settings) {
  neat::Settings neat;
  neat.population.size = settings.population;
  neat.speciation.scale_targets(settings.population);
  neat.speciation.initial_threshold = 10.0;
  neat.mutation.add_node_share = settings.add_node_share;
  neat.mutation.add_link_share = settings.add_link_share;
  neat.mutation.weights.jiggle_limit = 0.3;
  neat.validate();
  return neat;
}

/// Without noise, on one ground for all generations.
experiment::Champion to_evolve(experiment::Champion champion, const EvolutionSettings& settings) {
  experiment::Problem& problem = champion.problem;
  problem.noise = {};
  problem.ground.vary = ground::Vary::never;
  problem.ground.grow_generations = 0;
  problem.trial.duration_s = settings.seconds;
  if (!settings.feels_its_feet) {
    problem.controller.supg.trigger = controllers::Trigger::none;
    problem.controller.supg.idle = controllers::Idle::wrap;
  }
  problem.complete();
  champion.seed = settings.seed;
  champion.experiment = "evolved in a page";
  champion.episodes.clear();
  champion.referees.clear();
  champion.draw = experiment::Draw::once;
  return champion;
}

class Trace : public trial::Observer {
 public:
  void on_step(int, const physics::Engine& physics, const controllers::Batch&, const LaneArray&,
               int lane) override {
    hashes.push_back(static_cast<std::uint32_t>(physics.state_hash(lane)));
  }
  std::vector<std::uint32_t> hashes;
};

}  // namespace

void EvolutionSettings::describe(io::SettingsVisitor& visitor) {
  visitor.integer("seed", seed, {0, 4294967295.0}, {"seed of all randomness"});
  visitor.integer("population", population, {10, 1000}, {"genomes of a generation"});
  visitor.number("seconds", seconds, {1.0, 60.0}, {"length of a trial, s"});
  visitor.number("add_node_share", add_node_share, {0.0, 0.4}, {"share of mutations that add a node"});
  visitor.number("add_link_share", add_link_share, {0.0, 0.4}, {"share of mutations that add a link"});
  visitor.flag("feels_its_feet", feels_its_feet, {"whether feet reset the timers of SUPGs"});
}

/// A generation's trials: one per genome.
class Evolution::Candidates : public trial::TaskQueue {
 public:
  Candidates(std::span<const neat::Genome> genomes, const experiment::Problem& problem)
      : trajectories(genomes.size()), genomes_(genomes), problem_(problem) {}

  std::optional<trial::Task> next() override {
    if (next_ == genomes_.size()) return std::nullopt;
    trial::Task task{.index = next_, .parameters = problem_.decode(genomes_[next_])};
    ++next_;
    return task;
  }
  void done(std::size_t index, record::Trajectory trajectory) override {
    trajectories[index] = std::move(trajectory);
  }

  std::vector<record::Trajectory> trajectories;

 private:
  std::span<const neat::Genome> genomes_;
  const experiment::Problem& problem_;
  std::size_t next_ = 0;
};

Evolution::Evolution(const std::string& champion, const std::string& settings)
    : settings_(settings_from(settings)),
      of_(to_evolve(experiment::parse_champion_for(engine, champion, "champion"), settings_)),
      neat_(neat_settings(settings_)),
      ground_(of_.problem.make_ground(of_.problem.ground_key)),
      engine_(of_.problem.make_engine()),
      controllers_(of_.problem.architecture->make_batch(engine_->lanes())) {
  const experiment::Problem& problem = of_.problem;
  if (ground_) engine_->set_ground(ground_);
  runner_ = std::make_unique<trial::Runner>(*engine_, *controllers_, problem.protocol({}));
  search_ = std::make_unique<search::GenerationalSearch>(
      neat::Population(neat_, problem.cppn_inputs(), problem.cppn_outputs(), problem.cppn.recurrent,
                       static_cast<std::uint64_t>(settings_.seed)),
      std::make_unique<search::ObjectiveSearch>());
  begin_generation();
}

Evolution::~Evolution() = default;

void Evolution::begin_generation() {
  candidates_ = std::make_unique<Candidates>(search_->ask(), of_.problem);
  runner_->begin(*candidates_);
}

bool Evolution::advance(int steps) {
  for (int i = 0; i < steps; ++i)
    if (!runner_->tick(*candidates_)) {
      end_generation();
      begin_generation();
      return true;
    }
  return false;
}

void Evolution::end_generation() {
  const auto& trials = candidates_->trajectories;
  std::vector<double> objectives = experiment::objectives(of_.problem, trials, 1);
  std::vector<search::Evaluation> evaluations;
  progress_.fell = 0;
  for (std::size_t i = 0; i < trials.size(); ++i) {
    evaluations.push_back({.objective = objectives[i],
                           .behaviour = {},
                           .viable = trials[i].outcome != record::Outcome::diverged});
    progress_.fell += trials[i].outcome == record::Outcome::fell;
  }
  const auto best = std::ranges::max_element(objectives);
  progress_.generation = search_->round();
  progress_.best = *best;
  progress_.steps = runner_->steps_simulated();
  if (!best_ || *best > progress_.best_so_far) {
    best_index_ = static_cast<int>(best - objectives.begin());
    best_ = search_->ask()[to_index(best_index_)];
    progress_.best_so_far = *best;
    progress_.best_generation = progress_.generation;
  }
  std::ranges::sort(objectives);
  progress_.median = objectives[objectives.size() / 2];
  species_.clear();
  for (const neat::SpeciesStatistics& species : search_->population().species())
    species_.push_back({species.id, species.size});
  search_->tell(evaluations);
}

std::string Evolution::progress_json() const {
  io::Json species = io::Json::array();
  for (const auto& [id, size] : species_) species.push_back({id, size});
  return io::Json{{"generation", progress_.generation},
                  {"best", progress_.best},
                  {"median", progress_.median},
                  {"best_so_far", progress_.best_so_far},
                  {"unit", score::objective_of(of_.problem.score).unit},
                  {"best_generation", progress_.best_generation},
                  {"fell", progress_.fell},
                  {"steps", progress_.steps},
                  {"species", std::move(species)}}
      .dump();
}

std::string Evolution::champion() const {
  AMBLE_CHECK(best_.has_value(), "a generation is over");
  experiment::Champion champion = of_;
  champion.genome = *best_;
  champion.generation = progress_.best_generation;
  champion.index = best_index_;
  champion.problem.ground_key = champion.ground_key();

  const auto physics = champion.problem.make_engine();
  const auto ground = champion.problem.make_ground(champion.problem.ground_key);
  if (ground) physics->set_ground(ground);
  const auto batch = champion.problem.architecture->make_batch(physics->lanes());
  trial::Runner runner(*physics, *batch, champion.problem.protocol({}));
  Trace trace;
  trial::OneTask task(champion.problem.decode(champion.genome), &trace);
  runner.begin(task);
  while (runner.tick(task)) {
  }
  champion.result = experiment::summarise(champion.problem, *task.result());
  champion.trace = trace.hashes;
  return experiment::champion_text(champion);
}

}  // namespace amble::browser
