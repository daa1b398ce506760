#include <fmt/format.h>

#include <algorithm>
#include <csignal>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "amble/cli/help.hpp"
#include "amble/cli/live_server.hpp"
#include "amble/cli/messages.hpp"
#include "amble/cli/options.hpp"
#include "amble/cli/outputs.hpp"
#include "amble/cli/stop_signal.hpp"
#include "amble/cli/study_processes.hpp"
#include "amble/cli/study_progress.hpp"
#include "amble/core/index.hpp"
#include "amble/experiment/build_info.hpp"
#include "amble/experiment/config.hpp"
#include "amble/experiment/idle_settings.hpp"
#include "amble/experiment/problem.hpp"
#include "amble/experiment/run_folder.hpp"
#include "amble/io/file.hpp"
#include "amble/io/quoting.hpp"
#include "amble/io/text.hpp"
#include "amble/report/undecidable.hpp"
#include "amble/study/doubts.hpp"
#include "amble/study/plan.hpp"
#include "amble/study/slurm.hpp"
#include "amble/study/worker.hpp"

namespace amble::cli {
namespace {

struct StudyOptions {
  std::filesystem::path file, out;
  std::string shard = "1/1";
  int jobs = 1, per_run = 1;
  std::optional<int> workers;  ///< an old name
  bool discard_runs = false, status = false;
  bool as_child = false;  ///< one of a parent's processes
  std::vector<std::string> retest;
  std::optional<std::filesystem::path> slurm;
  int slurm_tasks = 20, slurm_minutes = 60;
  WatchOptions watch;
};

/// `--workers`, which once were those within each of `--jobs` processes.
void take_old_workers(StudyOptions& options) {
  if (!options.workers) return;
  options.per_run = *options.workers;
  options.jobs *= *options.workers;
  print_message(
      fmt::format("--workers {0}: now written --jobs {1} --per-run {0}\n", *options.workers, options.jobs));
}

/// Before the runs, which would not help.
void warn_of_claims(const study::Plan& plan) {
  for (const std::string& line : report::undecidable_claims(plan.study)) print_message(line + "\n");
  for (const std::string& line : study::doubts_of(plan)) print_message("note: " + line + "\n");
}

/// Settings of a condition's own that it does not use: it is not the ablation that it is meant to be.
void warn_of_idle_settings(const study::Plan& plan) {
  for (const study::PlannedCondition& condition : plan.conditions)
    for (const auto& idle : experiment::idle_assignments(condition.config, condition.spec.settings))
      print_message(fmt::format("note: condition '{}': {}\n", condition.spec.name, idle));
}

/// Commands of a test that no champion of a condition is told, or hears.
void warn_of_idle_commands(const study::Plan& plan) {
  for (const study::PlannedCondition& condition : plan.conditions) {
    const auto home = experiment::Problem::make(condition.config, condition.robot);
    for (const study::PlannedTest& test : condition.tests) {
      if (!test.command) continue;
      const auto problem = test.problem(home);
      const auto note = [&](const std::string& what) {
        print_message(
            fmt::format("note: condition '{}', test '{}': {}\n", condition.spec.name, test.spec.name, what));
      };
      if (const auto untold = experiment::untold_commands(problem)) note(*untold);
      // Champions that switch are told of it by their gaits.
      if (condition.spec.gaits == 0 && !problem.architecture->extra_senses().commands())
        note("its champions sense no commands, and walk as they would without");
    }
  }
}

/// Signals by which a user ends a study.
bool stops(int signal) {
  return signal == SIGTERM || signal == SIGINT || signal == SIGHUP || signal == SIGUSR1;
}

/// How much of a study's part is done, begun and neither.
ExitCode print_status(const study::Plan& plan, const std::vector<study::RunStatus>& states,
                      const study::Shard& shard) {
  const auto part = plan.shard(shard);
  const auto count = [&](study::RunStatus state) {
    return std::ranges::count_if(part, [&](std::size_t run) { return states[run] == state; });
  };
  if (std::error_code none; !std::filesystem::exists(plan.paths.folder, none))
    fmt::print("there is no folder {} yet\n", io::printable(plan.paths.folder.string()));
  fmt::print("{} of {} runs are done, digest {}\n", count(study::RunStatus::done), part.size(),
             ledger::ledger_digest(plan.study, ledger::Ledger(plan.paths).load_all(plan.study)));
  fmt::print("{} lack a test, {} are begun, {} not yet\n", count(study::RunStatus::untested),
             count(study::RunStatus::begun), count(study::RunStatus::missing));
  return ExitCode::ok;
}

/// Prints what was done and how to continue. `failed`: number of runs; `failure`: the exit code of the first,
/// or of a process that ended before its time.
ExitCode conclude(const study::Plan& plan, const StudyOptions& options, std::size_t failed, bool interrupted,
                  ExitCode failure) {
  const auto states = study::survey(plan);
  const auto part = plan.shard(study::Shard::parse(options.shard));
  const auto done =
      std::ranges::count_if(part, [&](std::size_t run) { return states[run] == study::RunStatus::done; });
  const std::string of_shard = options.shard == "1/1" ? "" : fmt::format(" of shard {}", options.shard);
  const std::string folder = options.out.string();
  fmt::print("{} of {} runs{} are done, digest {}\n", done, part.size(), of_shard,
             ledger::ledger_digest(plan.study, ledger::Ledger(plan.paths).load_all(plan.study)));
  // What one process could not do another may have done.
  if (to_index(done) < part.size()) {
    if (interrupted) {
      print_message("stopped; to continue, run the same command\n");
      return ExitCode::interrupted;
    }
    if (failed > 0)
      print_message(failed == 1 ? "1 run failed; the same command tries it again\n"
                                : fmt::format("{} runs failed; the same command tries them again\n", failed));
    else
      print_message("other processes work on the rest, or were killed: the same command continues\n");
    if (failure != ExitCode::ok) return failure;
  }
  fmt::print("for its report, run: amble report {} -o report.html\n", io::shell_word(folder));
  return ExitCode::ok;
}

ExitCode work_here(const study::Plan& plan, const std::vector<study::RunStatus>& states,
                   const StudyOptions& options) {
  const auto shard = study::Shard::parse(options.shard);
  std::optional<StudyProgress> progress;
  if (!options.as_child) progress.emplace(plan, states, shard, 1);
  StudyReporter reporter(plan, progress ? &*progress : nullptr);
  const auto result = study::work(
      plan, states, {.shard = shard, .workers = options.per_run, .discard_runs = options.discard_runs},
      reporter, stop_signal());
  progress.reset();
  if (options.as_child) return result.interrupted ? ExitCode::interrupted : result.first_failure;
  return conclude(plan, options, to_index(result.failed), result.interrupted, result.first_failure);
}

/// The same command for one of several processes.
std::vector<std::string> child_arguments(const StudyOptions& options) {
  std::vector<std::string> arguments{"study",     options.file.string(),
                                     "--out",     options.out.string(),
                                     "--shard",   options.shard,
                                     "--jobs",    std::to_string(options.per_run),
                                     "--per-run", std::to_string(options.per_run),
                                     "--child"};
  if (options.discard_runs) arguments.emplace_back("--discard-runs");
  for (const std::string& test : options.retest) arguments.insert(arguments.end(), {"--retest", test});
  return arguments;
}

ExitCode work_in_processes(const study::Plan& plan, const std::vector<study::RunStatus>& states,
                           const StudyOptions& options, int processes) {
  StudyProgress progress(plan, states, study::Shard::parse(options.shard), processes);
  ChildProcesses children(
      std::vector<std::vector<std::string>>(to_index(processes), child_arguments(options)));
  const auto exits = children.wait(
      [&](const std::string& line) {
        StudyEvent event;
        if (StudyEvent::parse(line, event) && event.run < plan.runs.size()) progress.on(event);
      },
      stop_signal());
  ExitCode failure = ExitCode::ok;
  bool interrupted = stop_signal();
  for (const auto& exit : exits) {
    if (exit.signal != 0 && !(interrupted && stops(exit.signal))) {
      print_message(fmt::format("a process of the study was ended by signal {}\n", exit.signal));
      const bool from_outside = exit.signal == SIGKILL || exit.signal == SIGTERM;
      failure = from_outside ? ExitCode::interrupted : ExitCode::internal;
    } else if (exit.code == static_cast<int>(ExitCode::interrupted)) {
      interrupted = true;
    } else if (exit.signal == 0 && exit.code != 0 && failure == ExitCode::ok) {
      failure = static_cast<ExitCode>(exit.code);
    }
  }
  return conclude(plan, options, progress.failed(), interrupted, failure);
}

ExitCode write_slurm_script(const study::Plan& plan, const StudyOptions& options) {
  namespace fs = std::filesystem;
  check_output(*options.slurm, "#!/bin/bash", "a batch script");
  if (options.shard != "1/1")
    fail(ExitCode::bad_input, "--shard {}: the tasks of --slurm are shards themselves", options.shard);
  const char* const plugins = std::getenv("AMBLE_PLUGINS");
  io::write_output(*options.slurm, study::slurm_script({.name = "amble-" + plan.study.name,
                                                        .program = fs::read_symlink("/proc/self/exe"),
                                                        .file = fs::absolute(options.file),
                                                        .out = fs::absolute(options.out),
                                                        .tasks = options.slurm_tasks,
                                                        .jobs = options.jobs,
                                                        .per_run = options.per_run,
                                                        .discard_runs = options.discard_runs,
                                                        .plugins = plugins == nullptr ? "" : plugins,
                                                        .minutes = options.slurm_minutes}));
  fmt::print("{} runs in {} tasks; to submit them, run: sbatch {}\n", plan.runs.size(), options.slurm_tasks,
             io::shell_word(options.slurm->string()));
  return ExitCode::ok;
}

/// Works on the study's part, in as many processes as there are runs for.
ExitCode work(const study::Plan& plan, const std::vector<study::RunStatus>& states,
              const StudyOptions& options) {
  const auto part = plan.shard(study::Shard::parse(options.shard));
  const auto open =
      std::ranges::count_if(part, [&](std::size_t run) { return states[run] != study::RunStatus::done; });
  const int processes =
      std::min(std::max(1, options.jobs / options.per_run), std::max(1, static_cast<int>(open)));
  if (processes == 1 || options.as_child) return work_here(plan, states, options);
  return work_in_processes(plan, states, options, processes);
}

/// What pages are told at the end.
std::string farewell(const StudyOptions& options, ExitCode code) {
  if (code == ExitCode::interrupted) return "The study was stopped; to continue, run the same command.";
  if (code != ExitCode::ok) return "The study has ended, not all of its runs: the same command tries again.";
  return fmt::format("The study has ended; for its report, run: amble report {} -o report.html",
                     io::shell_word(options.out.string()));
}

/// Where all tests that are to be made again are this build's already.
void note_retest(const StudyOptions& options, const std::vector<study::RunStatus>& states) {
  if (options.retest.empty() || options.as_child ||
      std::ranges::find(states, study::RunStatus::untested) != states.end())
    return;
  const auto commit = experiment::build_info().commit;
  print_message(fmt::format("--retest: no finished run has these tests by another commit than {}{}\n", commit,
                            commit.ends_with('+')
                                ? ", which has changes that are not committed: builds of it are "
                                  "not told apart"
                                : ""));
}

ExitCode run_study(const StudyOptions& options) {
  if (options.per_run > options.jobs)
    fail(ExitCode::bad_input, "--per-run {}: more than --jobs {}, which all runs share", options.per_run,
         options.jobs);
  if (experiment::is_run_folder(options.out))
    fail(ExitCode::bad_input, "--out {}: is the folder of a run; name another one for the study",
         io::printable(options.out.string()));
  std::signal(SIGPIPE, SIG_IGN);
  auto server = server_for(options.watch);
  const auto shard = study::Shard::parse(options.shard);
  auto plan = study::make_plan(ledger::load_study(options.file), options.out);
  ledger::check_folder(plan.paths, plan.study, options.file);
  plan.retest(options.retest);
  const auto states = study::survey(plan);
  note_retest(options, states);
  stop_signal();  // Until here nothing is lost where a signal ends the program at once.
  if (options.slurm) return write_slurm_script(plan, options);
  if (!options.as_child) {
    warn_of_claims(plan);
    warn_of_idle_settings(plan);
    warn_of_idle_commands(plan);
  }
  if (options.status) return print_status(plan, states, shard);
  ledger::keep_study(plan.paths, plan.study, options.file);
  for (const auto& unknown : ledger::Ledger(plan.paths).unknown_files(plan.study))
    if (!options.as_child)
      print_message(fmt::format("{}: no run of this study; passed over\n", unknown.string()));
  if (server) server->begin(options.out);
  const ExitCode code = work(plan, states, options);
  if (server) server->end(farewell(options, code));
  return code;
}

}  // namespace

void add_study(CLI::App& app, Action& action) {
  auto* command = app.add_subcommand(
      "study", "Compare conditions over many seeds: evolve, test champions, keep a record of each run");
  auto options = std::make_shared<StudyOptions>();
  command->add_option("FILE", options->file, "Study file (TOML)")->required();
  command->add_option("-o,--out", options->out, "Folder of the study; goes on with what is there")
      ->required();
  add_jobs(*command, options->jobs, "Processors to use; as many runs go on side by side");
  command->add_option("--per-run", options->per_run, "How many of them each run takes")
      ->capture_default_str()
      ->check(between(1, 1024));
  command->add_option("--workers", options->workers)->group("")->check(between(1, 1024));
  command->add_option("--shard", options->shard, "The I-th of N parts of the study, e.g. 2/8")
      ->type_name("I/N")
      ->capture_default_str();
  command->add_flag("--discard-runs", options->discard_runs,
                    "Remove a run's folder once its record is in the ledger");
  auto* status = command->add_flag("--status", options->status, "Only say what is done");
  status->excludes("--discard-runs");
  add_watch(*command, options->watch, "study");
  auto* retest =
      command
          ->add_option("--retest", options->retest,
                       "Make these tests of the study, by name, again where another build made them")
          ->type_name("NAME,NAME")
          ->delimiter(',');
  auto* slurm = command
                    ->add_option("--slurm", options->slurm,
                                 "Only write a Slurm batch script, whose tasks are shards, to this file")
                    ->excludes(retest)
                    ->excludes(status);
  command
      ->add_option("--tasks", options->slurm_tasks, "Tasks of the Slurm array; each takes --jobs processors")
      ->capture_default_str()
      ->needs(slurm)
      ->check(between(1, 100000));
  command->add_option("--minutes", options->slurm_minutes, "Time limit of a task; longer ones are requeued")
      ->capture_default_str()
      ->needs(slurm)
      ->check(between(3, 100000));
  options->watch.flag->excludes(status)->excludes(slurm);
  command->add_flag("--child", options->as_child)->group("");
  add_examples(*command,
               {{"amble study studies/smoke.toml --out results/smoke", ""},
                {"amble study studies/smoke.toml --out results/smoke --status", ""},
                {"amble study studies/smoke.toml --out results/smoke --watch", "and a page of its runs"},
                {"amble study studies/paper.toml --out results/paper --slurm job.sh --tasks 20", ""}});
  command->callback([options, &action] {
    action = [options] {
      take_old_workers(*options);
      return run_study(*options);
    };
  });
}

}  // namespace amble::cli
