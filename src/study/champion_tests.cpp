#include "amble/study/champion_tests.hpp"

#include <algorithm>
#include <cmath>

#include "amble/core/index.hpp"
#include "amble/experiment/gait_observer.hpp"
#include "amble/experiment/mutants.hpp"
#include "amble/experiment/replay_together.hpp"
#include "amble/io/file.hpp"
#include "amble/record/generations_csv.hpp"
#include "amble/score/walking.hpp"
#include "amble/statistics/descriptive.hpp"
#include "amble/trial/observers.hpp"

namespace amble::study {
namespace {

constexpr double most_path_samples = 300.0;

/// Rounded as in records.
double thousandths(double value) {
  return std::round(value * 1000.0) / 1000.0;
}

/// Steps from one sample of a path to the next.
int stride_of(double interval_s, double timestep_s) {
  return std::max(1, static_cast<int>(std::lround(interval_s / timestep_s)));
}

/// About `interval_s`, and a whole number of steps.
double sampled_interval_s(double interval_s, double timestep_s) {
  const double whole_s = stride_of(interval_s, timestep_s) * timestep_s;
  return std::abs(whole_s - interval_s) < 1e-9 ? interval_s : whole_s;
}

/// Measures how long a robot walks, and samples its path.
class WalkObserver : public trial::Observer {
 public:
  WalkObserver(double timestep_s, double interval_s)
      : timestep_s_(timestep_s), stride_(stride_of(interval_s, timestep_s)) {}

  void on_step(int step, const physics::Engine& engine, const controllers::Batch&, const LaneArray&,
               int lane) override {
    const Vec3 com_m = engine.com_m(lane);
    if (!meter_) {
      start_m_ = com_m;
      meter_.emplace(com_m, timestep_s_);
    }
    meter_->add(com_m);
    if (step % stride_ != 0) return;
    path_m_.push_back(thousandths(com_m.x - start_m_.x));
    path_m_.push_back(thousandths(com_m.y - start_m_.y));
  }

  double walking_s() const { return meter_ ? meter_->walking_s() : 0.0; }
  std::vector<double> path_m() const { return path_m_; }

 private:
  double timestep_s_;
  int stride_;
  Vec3 start_m_;
  std::optional<score::WalkingMeter> meter_;
  std::vector<double> path_m_;
};

/// Rounded as in records.
std::optional<ledger::Obeyed> obeyed(const experiment::TrialResult& trial) {
  if (!trial.tracking) return std::nullopt;
  ledger::Obeyed obeyed{.tracking = thousandths(trial.tracking->tracking)};
  if (const auto& error = trial.tracking->speed_error_m_s) obeyed.speed_error_m_s = thousandths(*error);
  if (const auto& error = trial.tracking->turn_error_rad_s) obeyed.turn_error_rad_s = thousandths(*error);
  if (const auto& wait_s = trial.tracking->switch_s) obeyed.switch_s = thousandths(*wait_s);
  return obeyed;
}

/// Rounded as in records.
std::optional<double> scored(const PlannedTest& test, const experiment::Problem& problem,
                             const experiment::TrialResult& trial) {
  if (!test.spec.score) return std::nullopt;
  return thousandths(problem.credited(trial.value(), trial.outcome));
}

/// Rounded as in records.
std::optional<ledger::Spent> spent(const PlannedTest& test, const experiment::Problem& problem,
                                   const experiment::TrialResult& trial) {
  if (!test.spec.energy) return std::nullopt;
  return ledger::Spent{.energy_j = thousandths(trial.energy_j),
                       .way_m = thousandths(trial.way_m),
                       .weight_n = thousandths(problem.weight_n())};
}

/// Rounded as in records. Nothing of a controller without timers.
std::optional<ledger::Seam> seam(const PlannedTest& test, const gait::Report& report) {
  if (!test.spec.seam || !report.seam) return std::nullopt;
  return ledger::Seam{.jumps = report.seam->jumps,
                      .mean_rad = thousandths(report.seam->mean_rad),
                      .largest_rad = thousandths(report.seam->largest_rad),
                      .power_w = thousandths(report.seam->power_after_w.value_or(0.0))};
}

std::string gait_name(const gait::Report& report) {
  if (!report.classification) return {};
  return std::string(gait::gait_names[to_index(report.classification->gait)]);
}

/// Noise and ground of an episode; nothing in a test without them.
std::optional<trial::ScenarioKey> scenario(const PlannedTest& test, const experiment::Problem& problem,
                                           const experiment::Champion& champion, int episode) {
  if (!test.ground && !test.noise.any() && problem.ground.start_place_m <= 0.0) return std::nullopt;
  return champion.unseen_scenario_key(to_index(episode));
}

/// The trials of a test, without observers.
std::vector<experiment::TogetherTrial> trials_of(const PlannedTest& test, const experiment::Problem& problem,
                                                 const experiment::Champion& champion) {
  std::vector<experiment::TogetherTrial> trials;
  trials.reserve(to_index(test.spec.episodes));
  for (int episode = 0; episode < test.spec.episodes; ++episode)
    trials.push_back({.noise = scenario(test, problem, champion, episode)});
  return trials;
}

/// Median distance of a champion in a test, m. Nothing if `stop` was set.
std::optional<double> median_distance_m(const PlannedTest& test, const experiment::Champion& champion,
                                        const std::atomic<bool>& stop) {
  const experiment::Problem problem = test.problem(champion.problem);
  const auto trials = trials_of(test, problem, champion);
  const auto replayed =
      experiment::replay_together(problem, champion.genome, test.spec.seconds, trials, stop);
  if (!replayed) return std::nullopt;
  std::vector<double> distances_m;
  for (const experiment::TrialResult& trial : *replayed) distances_m.push_back(trial.distance_m);
  return statistics::median(distances_m);
}

/// Evaluations, steps and wall time of a run up to and with a generation.
FirstReach spent_until(const record::Generations& generations, int generation) {
  FirstReach found{.reached = ledger::Reached{.generation = generation}};
  for (std::size_t i = 0; i <= to_index(generation) && i < generations.count(); ++i) {
    found.reached->evaluations += static_cast<std::uint64_t>(generations.evaluations[i]);
    found.reached->steps += static_cast<std::uint64_t>(generations.steps[i]);
    found.wall_s += generations.wall_s[i];
  }
  return found;
}

}  // namespace

std::optional<FirstReach> first_to_reach(const PlannedTest& test, const experiment::RunPaths& run,
                                         const std::atomic<bool>& stop) {
  for (const auto& file : run.champion_files()) {
    const auto champion = experiment::parse_champion(io::read_file(file), file.string()).champion;
    const auto distance_m = median_distance_m(test, champion, stop);
    if (!distance_m) return std::nullopt;
    if (*distance_m >= test.spec.reach_m)
      return spent_until(record::read_generations(run.generations), champion.generation);
  }
  return FirstReach{};
}

std::optional<ledger::TestResult> run_test(const PlannedTest& test, const experiment::Champion& champion,
                                           const std::atomic<bool>& stop) {
  const experiment::Problem problem = test.problem(champion.problem);
  const double interval_s = sampled_interval_s(
      std::max(1.0, std::ceil(test.spec.seconds / most_path_samples)), problem.trial.timestep_s);
  ledger::TestResult result{.name = test.spec.name,
                            .settings = test.settings_hash(champion.problem.engine),
                            .engine = problem.engine,
                            .trial_s = test.spec.seconds,
                            .episodes = {},
                            .gait = {},
                            .path_interval_s = interval_s,
                            .path_m = {},
                            .seam = {},
                            .reach_m = test.spec.reach_m,
                            .reached = {},
                            .champion_score = 0.0,
                            .mutants = {}};
  experiment::GaitObserver gait(problem, {});
  std::vector<WalkObserver> walks(to_index(test.spec.episodes),
                                  WalkObserver(problem.trial.timestep_s, interval_s));
  trial::ObserverList first;
  first.add(walks.front());
  first.add(gait);
  auto trials = trials_of(test, problem, champion);
  for (std::size_t i = 0; i < trials.size(); ++i)
    trials[i].observer = i == 0 ? static_cast<trial::Observer*>(&first) : &walks[i];
  const record::Measures measures{.energy = test.spec.energy, .seconds = test.spec.energy};
  const auto replayed =
      experiment::replay_together(problem, champion.genome, test.spec.seconds, trials, stop, measures);
  if (!replayed) return std::nullopt;
  for (std::size_t i = 0; i < trials.size(); ++i) {
    const experiment::TrialResult& trial = (*replayed)[i];
    result.episodes.push_back({.distance_m = trial.distance_m,
                               .seconds = trial.seconds,
                               .walking_s = std::min(walks[i].walking_s(), trial.seconds),
                               .outcome = trial.outcome,
                               .obeyed = obeyed(trial),
                               .spent = spent(test, problem, trial),
                               .score = scored(test, problem, trial)});
  }
  const gait::Report report = gait.finish(replayed->front().outcome);
  result.gait = gait_name(report);
  result.seam = seam(test, report);
  result.path_m = walks.front().path_m();
  return result;
}

bool add_mutants(const PlannedTest& test, const experiment::Champion& champion, const neat::Settings& neat,
                 ledger::TestResult& result, const std::atomic<bool>& stop) {
  const experiment::Problem problem = test.problem(champion.problem);
  std::vector<trial::ScenarioKey> trials;
  for (int episode = 0; episode < test.spec.episodes; ++episode)
    if (const auto key = scenario(test, problem, champion, episode)) trials.push_back(*key);
  constexpr int one_worker = 1;
  const auto outcome = experiment::try_mutants(problem, neat, champion.genome, test.spec.mutants,
                                               champion.seed, trials, one_worker, stop);
  if (!outcome) return false;
  result.champion_score = outcome->score;
  // Rounded down, so that none becomes viable.
  for (const record::Mutant& mutant : outcome->mutants)
    result.mutants.push_back(
        {.kept = std::floor(mutant.kept * 1000.0) / 1000.0, .change = thousandths(mutant.change)});
  return true;
}

io::Json champion_to_json(experiment::Champion champion) {
  champion.trace.clear();
  for (auto& episode : champion.episodes) episode.trace.clear();
  return io::parse_json(experiment::champion_text(champion), "champion");
}

experiment::Champion champion_from_json(const io::Json& json, const std::string& what) {
  return experiment::parse_champion(io::json_text(json), what + ": champion").champion;
}

}  // namespace amble::study
