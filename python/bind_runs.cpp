#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include "amble/core/index.hpp"
#include "amble/experiment/idle_settings.hpp"
#include "amble/experiment/replay.hpp"
#include "amble/experiment/run.hpp"
#include "amble/experiment/start_look.hpp"
#include "amble/experiment/steering.hpp"
#include "amble/exporting/export_file.hpp"
#include "amble/gait/report_text.hpp"
#include "amble/io/file.hpp"
#include "amble/morphology/mjcf_writer.hpp"
#include "amble/presentation/champion_gait.hpp"
#include "amble/presentation/shown_trial.hpp"
#include "amble/record/frame_codec.hpp"
#include "amble/record/generations_csv.hpp"
#include "amble/record/recording.hpp"
#include "python/bind.hpp"
#include "python/readable.hpp"
#include "python/trial_choice.hpp"

namespace amble::python {
namespace {

/// Gives each generation to a Python function as a dict: the line of generations.csv.
class CallbackListener : public experiment::RunListener {
 public:
  CallbackListener(py::function* callback, Interruptible& caller) : callback_(callback), caller_(caller) {}
  void on_generation(const experiment::GenerationRow& row, const experiment::Progress&,
                     const experiment::Config&) override {
    if (callback_ == nullptr) return;
    caller_.call([&] {
      py::dict line;
      const std::string header = experiment::csv_header(row.search);
      for (const auto& [name, values] : parse_columns(header + experiment::csv_line(row, header)))
        line[py::str(name)] = values.front();
      const auto returned = py::reinterpret_steal<py::object>(
          unless_it_ends([&] { return PyObject_CallOneArg(callback_->ptr(), line.ptr()); }));
      if (!returned) throw py::error_already_set();
    });
  }

 private:
  py::function* callback_;
  Interruptible& caller_;
};

/// Warnings of what is odd about the robot, and of what has no effect.
void warn_of_start(const experiment::Run& run, const std::vector<std::string>& assignments,
                   Interruptible& caller) {
  const auto odd = experiment::odd_for_run(run.robot(), run.config());
  caller.call([&] {
    for (const std::string& line : odd) warn(line);
    warn_of_idle(run.config(), run.problem(), assignments);
  });
}

/// Runs until all generations are done; Ctrl-C or an exception of the callback leaves the last checkpoint.
/// `assignments`: of a new run, which may have no effect.
ReadableRun execute(const std::function<experiment::Run()>& make, const py::object& on_generation,
                    const std::optional<std::vector<std::string>>& assignments = {}) {
  if (!on_generation.is_none() && PyCallable_Check(on_generation.ptr()) == 0)
    throw py::type_error("on_generation: expected a function of a dict, or None");
  py::function callback;
  if (!on_generation.is_none()) callback = py::reinterpret_borrow<py::function>(on_generation);
  Interruptible interruptible;
  CallbackListener listener(callback ? &callback : nullptr, interruptible);
  std::filesystem::path folder;
  std::string verdict;
  interruptible.run([&] {
    auto run = make();
    folder = run.paths().folder;
    if (assignments) warn_of_start(run, *assignments, interruptible);
    run.execute(listener, interruptible.stop());
    verdict = run.tally().verdict();
  });
  if (!verdict.empty()) fail(ExitCode::bad_input, "{}: {}", folder.string(), verdict);
  return ReadableRun(folder);
}

ReadableRun evolve(const py::object& config, std::optional<std::int64_t> seed, const py::object& out,
                   const py::object& on_generation, std::optional<int> jobs) {
  auto loaded = config_of(config);
  set_seed(loaded.value, seed);
  const auto folder = path_of(out);
  const int workers = jobs_of(jobs);
  return execute([&] { return experiment::Run::start(folder, loaded.value, *loaded.robot, workers); },
                 on_generation, loaded.assignments);
}

ReadableRun resume(const py::object& run, std::optional<int> generations, const py::object& on_generation,
                   std::optional<int> jobs) {
  const auto folder =
      py::isinstance<ReadableRun>(run) ? run.cast<const ReadableRun&>().paths().folder : path_of(run);
  if (generations && (*generations < 1 || *generations > experiment::most_generations))
    throw py::value_error(fmt::format("generations: {}: expected a whole number from 1 to {}", *generations,
                                      experiment::most_generations));
  const int workers = jobs_of(jobs);
  return execute([&] { return experiment::Run::resume(folder, generations, workers); }, on_generation);
}

py::dict generations_of(const ReadableRun& run) {
  const auto& file = run.paths().generations;
  const auto text = io::read_file(file);
  record::parse_generations(text, file.string());  // its checks
  // Without a row that was being written as its machine stopped.
  return to_dict(parse_columns(std::string_view(text).substr(0, text.rfind('\n') + 1)));
}

py::dict result_dict(const experiment::TrialResult& result) {
  py::dict dict;
  dict["outcome"] = py::str(std::string(record::outcome_names[to_index(result.outcome)]));
  dict["distance_m"] = result.distance_m;
  dict["score"] = result.value();
  dict["seconds"] = result.seconds;
  dict["steps"] = result.steps;
  if (result.tracking) dict["tracking"] = result.tracking->tracking;
  return dict;
}

py::dict facts_of(const ReadableChampion& self) {
  const auto& champion = self.value;
  py::dict facts;
  facts["experiment"] = champion.experiment;
  facts["seed"] = champion.seed;
  facts["generation"] = champion.generation;
  facts["index"] = champion.index;
  facts["engine"] = champion.problem.engine;
  facts["controller"] = champion.problem.controller.kind;
  facts["robot"] = champion.problem.robot.name;
  facts["objective"] = champion.objective();
  facts["result"] = result_dict(champion.result);
  py::dict referees;
  for (const auto& [engine, result] : champion.referees) referees[py::str(engine)] = result_dict(result);
  facts["referees"] = referees;
  return facts;
}

/// What it is told and how it is steered by hand, if these are given; as `amble trial` (docs/STEERING.md).
experiment::Problem told_problem(const ReadableChampion& self, std::optional<double> seconds,
                                 const std::optional<std::string>& command,
                                 const std::optional<std::string>& steering) {
  experiment::Problem problem = self.value.problem;
  if (seconds) problem.trial.duration_s = *seconds;
  problem.trial.validate();
  if (command) experiment::tell(problem, *command, "command");
  if (steering && problem.command.kind == trial::CommandKind::none)
    throw py::value_error(
        "steering: the champion was told nothing in its evolution; expected command as well");
  if (steering) experiment::steer_by_hand(problem, *steering, "steering");
  if (!command) return problem;
  if (const auto untold = experiment::untold_commands(problem))
    warn(fmt::format("command: {}; for more: seconds", *untold));
  if (const auto unheard = experiment::unheard_commands(problem)) warn("command: " + *unheard);
  return problem;
}

py::dict run_trial(const ReadableChampion& self, std::optional<double> seconds,
                   std::optional<std::string> engine, const py::object& record,
                   const std::optional<std::string>& command, const std::optional<std::string>& steering) {
  check_seconds(seconds);
  const auto problem = told_problem(self, seconds, command, steering);
  experiment::ReplayOptions how{
      .seconds = seconds, .engine = engine, .origin = self.origin(), .trace = false};
  if (!record.is_none()) {
    how.record = path_of(record);
    io::check_output(*how.record, record::recording_magic, "a recording");
    io::make_folder(how.record->parent_path());
  }
  std::optional<experiment::Replay> replay;
  Interruptible interruptible;
  interruptible.run(
      [&] { replay = experiment::replay(problem, self.value.genome, how, interruptible.stop()); });
  py::dict result = result_dict(replay->result);
  py::dict events;
  for (const auto& [name, count] : replay->events) events[py::str(std::string(name))] = count;
  result["events"] = events;
  return result;
}

py::str save_champion(ReadableChampion& self, const py::object& path) {
  const auto file = path_of(path);
  if (file.extension() != ".json")
    throw py::value_error(fmt::format("path: {}: expected a name that ends in .json", file.string()));
  experiment::refuse_among_champions(file);
  io::check_output(file, "{\n  \"format\": \"amble-champion\"", "a champion");
  io::write_output(file, experiment::champion_text(self.value));
  self.path = file;
  return path_text(file);
}

py::object gait_of(const ReadableChampion& self, std::optional<double> seconds,
                   std::optional<std::string> engine, std::string level, int trials, bool undisturbed,
                   std::optional<int> jobs, const py::object& noise) {
  check_seconds(seconds);
  const int workers = jobs_of(jobs);
  const auto choice = trial_choice(std::move(level), noise, trials, undisturbed);
  std::string text;
  Interruptible interruptible;
  interruptible.run([&] {
    const auto walked = presentation::champion_gait(self.value, self.origin(), seconds, engine, {}, choice,
                                                    workers, interruptible.stop());
    if (walked) text = gait::report_json(walked->report);
  });
  return to_python(io::parse_json(text, "gait"));
}

/// By its ending, as `amble export` writes it.
py::str export_champion(const ReadableChampion& self, const py::object& path, bool fixed,
                        const std::optional<std::string>& steering) {
  const auto file = path_of(path);
  const std::string ending = file.extension().string();
  if (ending != ".c" && ending != ".json" && ending != ".xml")
    throw py::value_error(fmt::format(
        "path: {}: expected a name that ends in .c, .json or .xml (the robot, for MuJoCo)", file.string()));
  if (fixed && ending != ".c") throw py::value_error("fixed: only with a path that ends in .c");
  if (steering && ending == ".xml")
    throw py::value_error("steering: only with a path that ends in .c or .json");
  experiment::refuse_among_champions(file);
  experiment::Champion champion = self.value;
  if (steering) exporting::steer_by_hand(champion, *steering, "steering");
  Interruptible interruptible;
  interruptible.run([&] {
    if (ending == ".c") {
      exporting::write_c(champion, file,
                         fixed ? exporting::Arithmetic::fixed : exporting::Arithmetic::float32,
                         interruptible.stop());
      return;
    }
    const bool json = ending == ".json";
    io::check_output(file, json ? exporting::export_json_start : morphology::written_mjcf_start,
                     json ? "a JSON document" : "an MJCF model");
    const std::string text =
        json ? exporting::export_json(champion, interruptible.stop())
             : morphology::written_mjcf_start +
                   morphology::simulation_mjcf(champion.problem.robot, champion.problem.trial.timestep_s);
    if (!text.empty()) io::write_output(file, text);
  });
  return path_text(file);
}

py::dict typical(const ReadableChampion& self, std::optional<double> seconds,
                 std::optional<std::string> engine, std::string level, int trials, std::optional<int> jobs,
                 const py::object& noise, const std::optional<std::string>& command,
                 const std::optional<std::string>& steering) {
  check_seconds(seconds);
  const auto choice = trial_choice(std::move(level), noise, trials);
  const int workers = jobs_of(jobs);
  experiment::Problem problem = told_problem(self, seconds, command, steering);
  if (engine) problem.engine = *engine;
  std::optional<std::vector<experiment::TrialResult>> results;
  std::string used;
  Interruptible interruptible;
  interruptible.run([&] {
    auto runner = presentation::typical_trials(problem, self.value.seed, choice, workers);
    used = runner.level().name;
    results = runner.run(self.value.genome, interruptible.stop());
  });
  const auto distance = experiment::typical_distance(*results);
  py::list all;
  for (const auto& result : *results) all.append(result_dict(result));
  py::dict dict;
  dict["level"] = text_of(used);
  dict["distance_m"] = distance.median;
  dict["lower_quartile_m"] = distance.lower_quartile;
  dict["upper_quartile_m"] = distance.upper_quartile;
  dict["best_m"] = distance.best;
  dict["fell_share"] = distance.fell_share;
  dict["trials"] = all;
  return dict;
}

/// What is measured of a champion, and written of it for others.
void bind_outputs(py::class_<ReadableChampion>& champion) {
  champion
      .def(
          "gait", gait_of, py::arg("seconds") = py::none(), py::arg("engine") = py::none(),
          py::arg("level") = "", py::arg("trials") = 0, py::arg("undisturbed") = false, py::kw_only(),
          py::arg("jobs") = py::none(), py::arg("noise") = py::none(),
          R"(Its gait, in the median of the trials of typical() where it was evolved under noise, else in its trial
without noise (docs/GAIT.md): the dict that `amble gait --json` writes.

undisturbed: the trial without noise instead. The rest as typical(). Raises Error.)")
      .def("export", export_champion, py::arg("path"), py::kw_only(), py::arg("fixed") = false,
           py::arg("steering") = py::none(),
           R"(Writes it for use without amble (docs/EXPORT.md); returns the path, a str.

path: FILE.c (beside it FILE.h; its name is the prefix of all names), FILE.json, or FILE.xml (the robot, for MuJoCo).
fixed: SUPGs in C without floating point. steering: gains, as in trial(); not for the robot. Raises Error, ValueError for another ending.)");
}

void bind_champion(py::module_& module) {
  py::class_<ReadableChampion> champion(
      module, "Champion",
      R"(A genome with all that it takes to let it walk again: the best of a run, or one of Search.champion().

Read once, it needs its file no more. Can be pickled.)");
  bind_outputs(champion);
  champion
      .def(py::init([](const py::object& path) { return champion_at(path_of(path)); }), py::arg("path"),
           "path: champion file, or run folder (its best). Raises Error for a file that is not sound.")
      .def_property_readonly(
          "path", [](const ReadableChampion& self) { return path_text(self.path); },
          "The file that it was read from or saved to; empty for one that has not been saved.")
      .def(
          "save", save_champion, py::arg("path"),
          R"(Writes it as a champion file (.json) for amble's command line; returns its path, a str. Raises Error, also among the
champions of a run folder.)")
      .def(py::pickle(
          [](const ReadableChampion& self) {
            return py::make_tuple(path_text(self.path), experiment::champion_text(self.value));
          },
          [](const py::tuple& state) {
            if (state.size() != 2) throw py::value_error("Champion: not its pickled state");
            return ReadableChampion{
                written_path_of(state[0]),
                experiment::parse_champion(state[1].cast<std::string>(), "Champion").champion};
          }))
      .def_property_readonly("facts", facts_of,
                             R"(A dict: experiment, seed, generation, index, engine, controller, robot,
objective (what made it the champion), result (of its trial without noise: outcome, distance_m, score, seconds,
steps), referees (the same by engine).)")
      .def_property_readonly(
          "genome", [](const ReadableChampion& self) { return self.value.genome; }, "Its CPPN, a Genome.")
      .def("trial", run_trial, py::arg("seconds") = py::none(), py::arg("engine") = py::none(),
           py::arg("record") = py::none(), py::kw_only(), py::arg("command") = py::none(),
           py::arg("steering") = py::none(),
           R"(Walks again, without noise; as in its evolution unless an argument says otherwise.

seconds: length, s. engine: "ode", "ode-variant", "batch", "mujoco" or "mujoco-model". record: path of a recording to write.
command: what it is told, "SPEED,TURN[,SECONDS]; ..." in m/s, rad/s to the left and s. steering: gains by which it is
steered by hand, "turn_gain = 1.5, full_speed_m_s = 0.4" (docs/STEERING.md).
Returns a dict: outcome, distance_m, score, seconds, steps, events (of the controller, by name), and of one that is told
something tracking, 0 to 1 (docs/SCORES.md).)")
      .def("typical", typical, py::arg("seconds") = py::none(), py::arg("engine") = py::none(),
           py::arg("level") = "", py::arg("trials") = 0, py::kw_only(), py::arg("jobs") = py::none(),
           py::arg("noise") = py::none(), py::arg("command") = py::none(), py::arg("steering") = py::none(),
           R"(What it typically does: many trials that evolution has not met, each disturbed otherwise.

seconds, engine, command, steering: as in trial(). level: "own" (the noise of its evolution), "control", "micro", "100-micro"
or "milli" (starts that differ by so many radians); default: its own noise, or "milli" without any.
noise: path of a config file whose [noise] disturbs instead. trials: their number, at most 100,000 (default: 64, or 16 in
engines that run one at a time). jobs: workers.
Returns a dict: level ("" with noise), distance_m (the median), lower_quartile_m, upper_quartile_m, best_m (the luckiest),
fell_share, trials (a list of dicts as trial() returns them, without events).)")
      .def("__repr__", [](const ReadableChampion& self) {
        return text_of(fmt::format("<amble.Champion of generation {}, {:.3f}: {}>", self.value.generation,
                                   self.value.objective(),
                                   self.path.empty() ? "not saved" : self.path.string()));
      });
}

void bind_run(py::module_& module) {
  py::class_<ReadableRun>(module, "Run", R"(A run folder, finished or not.

It goes on meaning this run: the folder's absolute path is kept, and another run that took its place is an Error. Can be
pickled, with the path.)")
      .def(py::init([](const py::object& folder) { return ReadableRun(path_of(folder)); }), py::arg("folder"),
           "Raises Error if there is no run.")
      .def_property_readonly("folder", [](const ReadableRun& self) { return path_text(self.folder()); })
      .def_property_readonly(
          "config", [](const ReadableRun& self) { return load_config(self.paths().config, py::none()); },
          "Its Config.")
      .def(py::pickle([](const ReadableRun& self) { return py::make_tuple(path_text(self.paths().folder)); },
                      [](const py::tuple& state) {
                        if (state.size() != 1) throw py::value_error("Run: not its pickled state");
                        return ReadableRun(written_path_of(state[0]));
                      }))
      .def("generations", generations_of,
           R"(generations.csv (docs/FORMATS.md) as a dict: column → float64 array,
one number per generation; NaN for empty cells.)")
      .def(
          "champion", [](const ReadableRun& self) { return champion_at(self.paths().best_champion()); },
          "The best Champion so far. Raises Error if there is none.")
      .def(
          "champions",
          [](const ReadableRun& self) {
            std::vector<ReadableChampion> champions;
            for (const auto& file : self.paths().champion_files()) champions.push_back(champion_at(file));
            return champions;
          },
          "All champions, in the order of their generations; the last is the best.")
      .def("__repr__", [](const ReadableRun& self) {
        return text_of(fmt::format("<amble.Run: {}>", self.folder().string()));
      });
  module.def("evolve", evolve, py::arg("config"), py::arg("seed") = py::none(), py::kw_only(), py::arg("out"),
             py::arg("on_generation") = py::none(), py::arg("jobs") = py::none(),
             R"(Evolves as `amble evolve` does, to the bit, and returns the Run.

config: Config or path. seed: of all randomness (default: the config's). out: the run folder to make; it must be new
or empty. on_generation: called after each generation with a dict, its line of generations.csv; an exception stops
the run. jobs: workers (default: processors); results do not depend on it.
Ctrl-C raises KeyboardInterrupt at once; resume(out) goes on from the last generation. Raises Error.)");
  module.def(
      "resume", resume, py::arg("run"), py::arg("generations") = py::none(), py::kw_only(),
      py::arg("on_generation") = py::none(), py::arg("jobs") = py::none(),
      R"(Goes on with a run that was stopped, or makes it longer, as `amble resume` does, and returns it.

run: Run or folder. generations: to evaluate in all (default: the run's). The rest as evolve(). Raises Error.)");
}

}  // namespace

void bind_runs(py::module_& module) {
  bind_champion(module);
  bind_run(module);
  refuse_unmade<ReadableChampion>();
  refuse_unmade<ReadableRun>();
}

}  // namespace amble::python
