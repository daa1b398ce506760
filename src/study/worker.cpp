#include "amble/study/worker.hpp"

#include <fmt/chrono.h>
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <thread>
#include <utility>

#include "amble/core/clock.hpp"
#include "amble/core/hash.hpp"
#include "amble/core/index.hpp"
#include "amble/experiment/build_info.hpp"
#include "amble/experiment/corrected_map.hpp"
#include "amble/experiment/run.hpp"
#include "amble/experiment/switching_champion.hpp"
#include "amble/io/file.hpp"
#include "amble/io/lock.hpp"
#include "amble/neat/genome_io.hpp"
#include "amble/physics/batch/instruction_set.hpp"
#include "amble/record/generations_csv.hpp"
#include "amble/study/champion_tests.hpp"

namespace amble::study {
namespace {

/// How long, and how often, locked runs are tried again before they are left to other processes: a process
/// that was killed may take a moment to end.
constexpr auto patience = std::chrono::seconds(5);
constexpr auto pause = std::chrono::milliseconds(200);
constexpr auto most_waiting = std::chrono::seconds(60);  ///< for a turn to make a folder
constexpr auto turn_pause = std::chrono::milliseconds(10);
constexpr int most_io_failures = 3;  ///< in a row

class RunProgress : public experiment::RunListener {
 public:
  RunProgress(const PlannedRun& run, Listener& listener) : run_(run), listener_(listener) {}
  void on_generation(const experiment::GenerationRow& row, const experiment::Progress&,
                     const experiment::Config&) override {
    listener_.on_generation(run_, row.generation + 1);
  }

 private:
  const PlannedRun& run_;
  Listener& listener_;
};

std::vector<ledger::CurvePoint> curve_of(const std::filesystem::path& generations_csv) {
  std::vector<ledger::CurvePoint> curve;
  const auto generations = record::read_generations(generations_csv);
  for (std::size_t i = 0; i < generations.count(); ++i)
    if (record::keeps_champion(generations, i)) curve.push_back({static_cast<int>(i), generations.best[i]});
  return curve;
}

/// Record::map_figures; nothing for runs without a map.
std::map<std::string, double> map_figures_of(const std::filesystem::path& generations_csv) {
  const auto rows = record::read_generations(generations_csv);
  if (rows.coverage.empty() || rows.reevaluated.empty()) return {};
  double candidates = 0.0, entering = 0.0;
  for (std::size_t i = 0; i < rows.count(); ++i) {
    candidates += rows.evaluations[i] - rows.reevaluated[i];
    entering += rows.entered[i] + rows.improved[i];
  }
  return {{"coverage", rows.coverage.back()},
          {"qd_score", rows.qd_score.back()},
          {"map_best", rows.map_best.back()},
          {"entering_share", candidates > 0.0 ? entering / candidates : 0.0}};
}

std::string utc_now() {
  const auto now = std::chrono::floor<std::chrono::seconds>(std::chrono::system_clock::now());
  return fmt::format("{:%Y-%m-%dT%H:%M:%SZ}", fmt::gmtime(now));
}

/// One process's work on a study.
class Worker {
 public:
  Worker(const Plan& plan, const WorkOptions& options, Listener& listener, const std::atomic<bool>& stop)
      : plan_(plan), ledger_(plan.paths), options_(options), listener_(listener), stop_(stop) {}

  enum class Step { done, nothing_to_do, interrupted };

  /// Throws UserError; ExitCode::locked if another process holds the run's folder.
  Step take(const PlannedRun& run) {
    auto evolution = take_hold(run);
    if (!evolution) {
      const Step step = complete(run);
      if (step != Step::interrupted) discard(run);
      return step;
    }
    listener_.on_start(run, evolution->generation());
    RunProgress progress(run, listener_);
    if (evolution->execute(progress, stop_) == experiment::RunStatus::interrupted) return Step::interrupted;
    auto record = first_record(run, *evolution);
    if (!correct_map_of(*evolution, record) || !switch_gaits(run, *evolution, record))
      return Step::interrupted;
    const Step step = add_tests(run, std::move(record), true);
    evolution.reset();
    if (step == Step::done) discard(run);
    return step;
  }

  /// Removes the folder of a finished run, if folders are to be removed and nobody works in it.
  void discard(const PlannedRun& run) const {
    const auto folder = plan_.folder(run);
    if (!options_.discard_runs || !experiment::is_run_folder(folder)) return;
    const auto turn = wait_for_turn();
    if (!experiment::is_run_folder(folder)) return;
    try {
      const io::FolderLock lock(folder);
      std::error_code error;
      std::filesystem::remove_all(folder, error);
      if (error) fail(ExitCode::io, "cannot remove {}: {}", folder.string(), error.message());
    } catch (const UserError& error) {
      if (error.code() != ExitCode::locked) throw;
    }
  }

 private:
  /// Nothing if the run has a record.
  std::optional<experiment::Run> take_hold(const PlannedRun& run) const {
    const auto finished = [&] { return ledger_.has(plan_.condition(run).spec.name, run.seed); };
    if (finished()) return std::nullopt;
    const auto folder = plan_.folder(run);
    const auto turn = wait_for_turn();
    // Another process may have finished the run meanwhile, and may have removed its folder.
    if (finished()) return std::nullopt;
    return experiment::is_run_folder(folder)
               ? experiment::Run::resume(folder, std::nullopt, options_.workers)
               : experiment::Run::start(folder, plan_.config(run), options_.workers);
  }

  /// Run folders are made and removed by one process at a time: another one would find half a folder.
  std::unique_ptr<io::FolderLock> wait_for_turn() const {
    io::make_folder(plan_.paths.runs);
    const auto start = std::chrono::steady_clock::now();
    while (true) {
      try {
        return std::make_unique<io::FolderLock>(plan_.paths.runs);
      } catch (const UserError& failure) {
        const bool tired = std::chrono::steady_clock::now() - start > most_waiting;
        if (failure.code() != ExitCode::locked || tired) throw;
      }
      std::this_thread::sleep_for(turn_pause);
    }
  }

  ledger::Record first_record(const PlannedRun& run, const experiment::Run& evolution) const {
    const PlannedCondition& condition = plan_.condition(run);
    const auto file = evolution.paths().best_champion();
    const std::string text = io::read_file(file);
    const auto champion = experiment::parse_champion(text, file.string()).champion;
    ledger::Provenance provenance;
    provenance.evolution_s = evolution.progress().wall_s;
    provenance.workers = options_.workers;
    return {.study = plan_.study.name,
            .condition = condition.spec.name,
            .seed = run.seed,
            .config = condition.recorded_hash(),
            .generations = evolution.config().generations,
            .engine = evolution.config().engine,
            .evaluations = evolution.progress().evaluations,
            .steps = evolution.progress().steps,
            .best_objective = evolution.progress().best,
            .best_generation = evolution.progress().best_generation,
            .hidden = champion.genome.count(neat::NodeKind::hidden),
            .links = champion.genome.enabled_links(),
            .map_figures = map_figures_of(evolution.paths().generations),
            .curve = curve_of(evolution.paths().generations),
            .champion = champion_to_json(champion),
            .champion_file = hex(hash_text(text)),
            .tests = {},
            .provenance = std::move(provenance)};
  }

  /// Adds what the run's map keeps in new trials, if the study asks for it and there is a map. False:
  /// interrupted.
  bool correct_map_of(const experiment::Run& evolution, ledger::Record& record) const {
    if (plan_.study.map_trials == 0 || !experiment::fills_map(evolution.config())) return true;
    const auto corrected = experiment::correct_map(experiment::load_repertoire(evolution.paths()),
                                                   plan_.study.map_trials, options_.workers, stop_);
    if (!corrected) return false;
    record.map_figures["corrected_coverage"] = corrected->coverage();
    record.map_figures["corrected_qd_score"] = corrected->qd_score();
    record.map_figures["staying_share"] = corrected->staying_share();
    record.map_trials = plan_.study.map_trials;
    return true;
  }

  /// Puts a champion that switches between elites in the place of the best one, if the condition asks for it.
  /// False: interrupted.
  bool switch_gaits(const PlannedRun& run, const experiment::Run& evolution, ledger::Record& record) const {
    const int gaits = plan_.condition(run).spec.gaits;
    if (gaits == 0) return true;
    const auto repertoire = experiment::load_repertoire(evolution.paths());
    const auto corrected =
        experiment::correct_map(repertoire, experiment::usual_gait_trials, options_.workers, stop_);
    if (!corrected) return false;
    const auto picked = experiment::pick_gaits(repertoire, *corrected, gaits);
    const auto champion = experiment::switching_champion(repertoire, picked, experiment::usual_heading_gain,
                                                         options_.workers, stop_);
    if (!champion) return false;
    record.champion = champion_to_json(*champion);
    record.champion_file = hex(hash_text(experiment::champion_text(*champion)));
    // What the walker carries is the size of all its gaits' CPPNs.
    record.hidden = record.links = 0;
    for (const experiment::PickedGait& gait : picked) {
      const auto genome = neat::expand(repertoire.elites[gait.number].genome, "archive.bin");
      record.hidden += genome.count(neat::NodeKind::hidden);
      record.links += genome.enabled_links();
    }
    return true;
  }

  /// Adds the tests that a finished run lacks, one process at a time. The record itself is locked: the run's
  /// folder may be gone.
  Step complete(const PlannedRun& run) {
    const PlannedCondition& condition = plan_.condition(run);
    const auto& name = condition.spec.name;
    if (condition.has_all_tests(ledger_.load(name, run.seed))) return Step::nothing_to_do;
    const io::FileLock lock(plan_.paths.record(name, run.seed));
    auto record = ledger_.load(name, run.seed);
    return condition.has_all_tests(record) ? Step::nothing_to_do : add_tests(run, std::move(record), false);
  }

  /// Runs the tests that are due, in the study's order, and writes the record. Throws UserError if one of
  /// them cannot be run, after the others.
  Step add_tests(const PlannedRun& run, ledger::Record record, bool is_new) {
    const PlannedCondition& condition = plan_.condition(run);
    const auto champion =
        champion_from_json(record.champion, plan_.paths.record(record.condition, run.seed).string());
    const double start_s = now_s();
    std::vector<ledger::TestResult> results;
    std::string obstacle;
    bool added = is_new;
    for (const PlannedTest& test : condition.tests) {
      if (!test.is_due(record)) {
        results.push_back(*record.find_test(test.spec.name));
        continue;
      }
      if (const auto reason = obstacle_to(test, run, record); !reason.empty()) {
        obstacle = reason;
        continue;
      }
      auto result = result_of(test, condition, champion, run, record);
      if (!result) return Step::interrupted;
      if (!is_new) record.provenance.added_by[test.spec.name] = experiment::build_info().commit;
      results.push_back(std::move(*result));
      added = true;
    }
    // What was measured for a test that the study has no longer, or that cannot be run again, is kept.
    for (ledger::TestResult& old : record.tests)
      if (std::ranges::find(results, old.name, &ledger::TestResult::name) == results.end())
        results.push_back(std::move(old));
    record.tests = std::move(results);
    if (is_new) note_provenance(record);
    record.provenance.tests_s += now_s() - start_s;
    if (added) ledger_.save(record);
    if (!obstacle.empty()) fail(ExitCode::bad_input, "{}", obstacle);
    listener_.on_finish(run, record);
    return Step::done;
  }

  /// All of a test for one champion. Nothing: interrupted.
  std::optional<ledger::TestResult> result_of(const PlannedTest& test, const PlannedCondition& condition,
                                              const experiment::Champion& champion, const PlannedRun& run,
                                              ledger::Record& record) const {
    auto result = run_test(test, champion, stop_);
    if (!result) return std::nullopt;
    if (test.spec.reach_m > 0.0) {
      const auto first = first_to_reach(test, experiment::RunPaths(plan_.folder(run)), stop_);
      if (!first) return std::nullopt;
      result->reached = first->reached;
      if (first->reached) record.provenance.reached_s[test.spec.name] = first->wall_s;
    }
    if (test.spec.mutants > 0 && !add_mutants(test, champion, condition.config.neat, *result, stop_))
      return std::nullopt;
    return result;
  }

  /// Why a test cannot be run; empty if it can. One with `reach_m` needs the run that the record is of,
  /// finished.
  std::string obstacle_to(const PlannedTest& test, const PlannedRun& run,
                          const ledger::Record& record) const {
    if (test.spec.reach_m <= 0.0) return {};
    const experiment::RunPaths paths(plan_.folder(run));
    const auto champions = paths.champion_files();
    if (experiment::is_run_folder(paths.folder) && !champions.empty() &&
        hex(hash_text(io::read_file(champions.back()))) == record.champion_file &&
        record::read_generations(paths.generations).count() == to_index(record.generations))
      return {};
    return fmt::format(
        "test '{}' has 'reach_m' and looks through all champions of the run, but {} is gone or is not that "
        "run; "
        "move {} away to run it again",
        test.spec.name, paths.folder.string(), plan_.paths.record(record.condition, record.seed).string());
  }

  void note_provenance(ledger::Record& record) const {
    const auto build = experiment::build_info();
    auto& provenance = record.provenance;
    provenance.version = build.version;
    provenance.commit = build.commit;
    provenance.compiler = build.compiler;
    provenance.flags = build.flags;
    provenance.cpu = fmt::format("{}, {}", experiment::cpu_name(), physics::instruction_set());
    provenance.finished_utc = utc_now();
    provenance.claims = plan_.study.claims_hash();
  }

  const Plan& plan_;
  ledger::Ledger ledger_;
  WorkOptions options_;
  Listener& listener_;
  const std::atomic<bool>& stop_;
};

}  // namespace

WorkResult work(const Plan& plan, const std::vector<RunStatus>& states, const WorkOptions& options,
                Listener& listener, const std::atomic<bool>& stop) {
  Worker worker(plan, options, listener, stop);
  std::vector<PlannedRun> open;
  for (const std::size_t i : plan.shard(options.shard))
    if (states[i] == RunStatus::done)
      worker.discard(plan.runs[i]);
    else
      open.push_back(plan.runs[i]);

  WorkResult result;
  int io_failures = 0;
  auto last_progress = std::chrono::steady_clock::now();
  while (!open.empty()) {
    std::vector<PlannedRun> locked;
    for (const PlannedRun& run : open) {
      try {
        const auto step = stop ? Worker::Step::interrupted : worker.take(run);
        if (step == Worker::Step::interrupted) {
          result.interrupted = true;
          return result;
        }
        result.finished += step == Worker::Step::done;
        io_failures = 0;
        last_progress = std::chrono::steady_clock::now();
      } catch (const UserError& error) {
        if (error.code() == ExitCode::locked) {
          locked.push_back(run);
          continue;
        }
        listener.on_failure(run, error.what());
        if (result.failed++ == 0) result.first_failure = error.code();
        // A full disk is full for every run.
        io_failures = error.code() == ExitCode::io ? io_failures + 1 : 0;
        if (io_failures == most_io_failures) return result;
      }
    }
    open = std::move(locked);
    if (open.empty() || std::chrono::steady_clock::now() - last_progress > patience) break;
    std::this_thread::sleep_for(pause);
  }
  result.elsewhere = static_cast<int>(open.size());
  return result;
}

}  // namespace amble::study
