#include <pybind11/stl.h>

#include <algorithm>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "amble/experiment/adapt.hpp"
#include "amble/experiment/corrected_map.hpp"
#include "amble/experiment/given_damage.hpp"
#include "amble/experiment/repertoire.hpp"
#include "amble/io/file.hpp"
#include "amble/presentation/adaptation_page.hpp"
#include "amble/presentation/comparison.hpp"
#include "amble/presentation/map_page.hpp"
#include "python/bind.hpp"
#include "python/readable.hpp"
#include "python/trial_choice.hpp"

namespace amble::python {
namespace {

/// A map of gaits, read once.
struct ReadableMap {
  std::filesystem::path run;
  experiment::Repertoire value;

  const search::Elites& elites() const { return value.elites; }
  /// Numbers of the elites, in the order of their cells.
  std::vector<std::uint32_t> by_cell() const {
    std::vector<std::uint32_t> numbers;
    for (std::uint32_t cell = 0; cell < elites().cells(); ++cell)
      if (const auto number = elites().in(cell); number != search::Elites::none) numbers.push_back(number);
    return numbers;
  }
};

ReadableMap map_of(const py::object& run) {
  const auto paths = py::isinstance<ReadableRun>(run) ? run.cast<const ReadableRun&>().paths()
                                                      : experiment::find_run(path_of(run));
  const Unlocked unlocked;
  return {paths.folder, experiment::load_repertoire(paths)};
}

template <typename Number>
py::array array_of(const std::vector<Number>& numbers) {
  return py::array_t<Number>(static_cast<py::ssize_t>(numbers.size()), numbers.data());
}

py::list dimensions_of(const ReadableMap& self) {
  py::list all;
  for (const auto& descriptor : self.value.config.search.map_elites.descriptors) {
    py::dict dimension;
    dimension["name"] = descriptor.label();
    dimension["least"] = descriptor.least;
    dimension["most"] = descriptor.most;
    dimension["bins"] = descriptor.bins;
    all.append(dimension);
  }
  return all;
}

py::dict elites_of(const ReadableMap& self) {
  std::vector<std::uint32_t> cells, evaluations;
  std::vector<double> objectives;
  std::vector<float> descriptors;
  for (const auto number : self.by_cell()) {
    const search::Elite& elite = self.elites()[number];
    cells.push_back(elite.cell);
    evaluations.push_back(elite.evaluations);
    objectives.push_back(elite.objective);
    const auto descriptor = self.elites().descriptor(number);
    descriptors.insert(descriptors.end(), descriptor.begin(), descriptor.end());
  }
  py::dict dict;
  dict["cell"] = array_of(cells);
  dict["objective"] = array_of(objectives);
  dict["evaluations"] = array_of(evaluations);
  dict["descriptor"] = py::array_t<float>(
      {static_cast<py::ssize_t>(cells.size()), static_cast<py::ssize_t>(self.elites().dimensions())},
      descriptors.data());
  return dict;
}

ReadableChampion elite_of(const ReadableMap& self, std::optional<std::uint32_t> cell,
                          std::optional<int> jobs) {
  const auto numbers = self.by_cell();
  if (!cell) {
    if (numbers.empty()) fail(ExitCode::bad_input, "{}: the map has no elite yet", self.run.string());
    cell = self.elites()[*std::ranges::max_element(
                             numbers, {}, [&](auto number) { return self.elites()[number].objective; })]
               .cell;
  }
  const int workers = jobs_of(jobs);
  std::optional<experiment::Champion> champion;
  Interruptible interruptible;
  interruptible.run(
      [&] { champion = experiment::elite_champion(self.value, *cell, workers, interruptible.stop()); });
  return {{}, std::move(*champion)};
}

/// As the command line notes it.
void warn_of_equal_trials(const ReadableMap& self, int trials) {
  if (trials > 1 && !self.value.problem.trials_vary())
    warn("trials: the search was without noise, and so are these trials: one of each elite is all");
}

py::dict retest(const ReadableMap& self, int trials, std::optional<int> jobs) {
  check_whole("trials", trials, 1, 1000);
  warn_of_equal_trials(self, trials);
  const int workers = jobs_of(jobs);
  std::optional<experiment::CorrectedMap> corrected;
  Interruptible interruptible;
  interruptible.run(
      [&] { corrected = experiment::correct_map(self.value, trials, workers, interruptible.stop()); });
  std::vector<std::uint32_t> cells;
  std::vector<double> objectives;
  py::list stays;
  for (const auto number : self.by_cell()) {
    const auto& elite = corrected->elites[number];
    cells.push_back(elite.cell);
    objectives.push_back(elite.objective);
    stays.append(elite.stays());
  }
  py::dict dict;
  dict["trials"] = corrected->trials;
  dict["filled"] = corrected->filled();
  dict["qd_score"] = corrected->qd_score();
  dict["promised_qd_score"] = corrected->promised();
  dict["staying_share"] = corrected->staying_share();
  dict["cell"] = array_of(cells);
  dict["objective"] = array_of(objectives);
  dict["stays"] = py::module_::import("numpy").attr("array")(stays, "bool");
  return dict;
}

py::str save_map(const ReadableMap& self, const py::object& path, std::optional<int> trials,
                 std::optional<int> walkers, std::optional<int> jobs) {
  if (trials) check_whole("trials", *trials, 0, 1000);
  if (walkers) check_whole("walkers", *walkers, 1, 10000);
  const auto file = path_of(path);
  if (trials.value_or(0) > 0 && file.extension() == ".json")
    throw py::value_error("trials: a .json file holds what the map says; expected FILE.html, .svg or .csv");
  if (walkers && file.extension() != ".html") throw py::value_error("walkers: only for a page, FILE.html");
  warn_of_equal_trials(self, trials.value_or(0));
  presentation::MapFileOptions how{.trials = trials, .jobs = jobs_of(jobs)};
  if (walkers) how.walkers = static_cast<std::size_t>(*walkers);
  Interruptible interruptible;
  interruptible.run(
      [&] { presentation::write_map_file(self.value, self.run, file, how, interruptible.stop()); });
  return path_text(file);
}

py::object adapt(const ReadableMap& self, const py::object& damage_or_path, const std::string& engine,
                 int trials, int episodes, int test_trials, const py::object& page, std::optional<int> jobs) {
  check_whole("trials", trials, 1, 1000);
  check_whole("episodes", episodes, 1, 100);
  check_whole("test_trials", test_trials, 1, 100000);
  const std::string damage = written_path_of(damage_or_path).string();
  experiment::AdaptSettings settings{.engine = engine,
                                     .damage = experiment::damage_of(damage),
                                     .most_trials = trials,
                                     .episodes = episodes,
                                     .test_trials = test_trials};
  std::optional<std::filesystem::path> file;
  if (!page.is_none()) {
    file = path_of(page);
    check_page(*file);
  }
  const int workers = jobs_of(jobs);
  std::string text;
  Interruptible interruptible;
  interruptible.run([&] {
    const auto found = experiment::adapt(self.value, settings, workers, interruptible.stop());
    if (!found) return;
    text = experiment::adaptation_json(*found, self.value, settings, damage);
    if (!file) return;
    const auto html =
        presentation::adaptation_page(*found, self.value, settings, damage, self.run, interruptible.stop());
    if (html) io::write_output(*file, *html);
  });
  py::dict dict = to_python(io::parse_json(text, "adaptation"));
  for (const char* key : {"format", "version", "checksum"}) dict.attr("pop")(key, py::none());
  return dict;
}

py::object compare(const py::object& champions, const std::vector<double>& seconds,
                   const std::vector<std::string>& engines, std::string level, int trials,
                   const py::object& noise, bool undisturbed) {
  if (!py::isinstance<py::sequence>(champions) || py::isinstance<py::str>(champions) ||
      py::isinstance<py::bytes>(champions))
    throw py::type_error(fmt::format("champions: expected a list of them, found {}",
                                     py::str(py::type::of(champions).attr("__name__")).cast<std::string>()));
  std::vector<presentation::NamedChampion> named;
  for (const py::handle& each : champions) {
    const auto object = py::reinterpret_borrow<py::object>(each);
    const auto champion = py::isinstance<ReadableChampion>(object) ? object.cast<const ReadableChampion&>()
                          : py::isinstance<ReadableRun>(object)
                              ? champion_at(object.cast<const ReadableRun&>().paths().best_champion())
                              : champion_at(path_of(object));
    named.push_back({champion.origin(), champion.value});
  }
  for (const double length_s : seconds) check_seconds(length_s);
  const presentation::CompareOptions how{
      .seconds = seconds,
      .engines = engines,
      .disturbance = trial_choice(std::move(level), noise, trials, undisturbed)};
  std::optional<std::vector<presentation::ComparedChampion>> rows;
  Interruptible interruptible;
  interruptible.run([&] { rows = presentation::compare(named, how, interruptible.stop()); });
  return to_python(presentation::comparison_json(*rows));
}

}  // namespace

void bind_maps(py::module_& module) {
  py::class_<ReadableMap>(module, "Map", R"(The map of gaits of a run under MAP-Elites (docs/REPERTOIRES.md).

Read once: what happens to the run later changes nothing.)")
      .def(py::init(&map_of), py::arg("run"), "run: Run or folder. Raises Error for a run of another search.")
      .def_property_readonly(
          "run", [](const ReadableMap& self) { return path_text(self.run); }, "Folder of the run, a str.")
      .def_property_readonly(
          "cells", [](const ReadableMap& self) { return self.elites().cells(); },
          "Cells of the map, filled or not; len() counts those that have an elite.")
      .def_property_readonly(
          "qd_score", [](const ReadableMap& self) { return self.elites().objective_sum(); },
          "Sum of the elites' objectives, as the map says; retest() says what they keep.")
      .def_property_readonly(
          "dimensions", dimensions_of,
          "What the cells tell apart, in the order of descriptors: a list of dicts, name, least, most, bins.")
      .def(
          "__len__", [](const ReadableMap& self) { return self.elites().size(); },
          "Cells that have an elite.")
      .def(
          "elites", elites_of,
          R"(A dict of arrays, an entry per elite in the order of cells: cell, objective, evaluations (of which
objective and descriptor are the means), descriptor (elites × dimensions, float32).)")
      .def("champion", elite_of, py::arg("cell") = py::none(), py::kw_only(), py::arg("jobs") = py::none(),
           "The elite of a cell, of the largest objective without a cell, as a Champion. Raises Error.")
      .def(
          "retest", retest, py::arg("trials") = 20, py::kw_only(), py::arg("jobs") = py::none(),
          R"(Tries each elite in so many trials that the search has not met. Returns a dict: trials, filled and qd_score
(of the map that the new trials fill), promised_qd_score (as the map says), staying_share (elites that stay in their
cell); and arrays in the order of elites(): cell, objective, stays.)")
      .def(
          "save", save_map, py::arg("path"), py::arg("trials") = py::none(), py::arg("walkers") = py::none(),
          py::kw_only(), py::arg("jobs") = py::none(),
          R"(Writes the map; returns the path, a str. By its ending: .html (a page in which elites walk), .svg, .csv, .json.

trials: new trials of each elite, which the file tells (default: 20 of a map made under noise, else 0). walkers: cells at
most that can be chosen in the page (default: 200). Raises Error.)")
      .def(
          "adapt", adapt, py::arg("damage"), py::arg("engine") = "ode", py::arg("trials") = 20, py::kw_only(),
          py::arg("episodes") = 1, py::arg("test_trials") = 20, py::arg("page") = py::none(),
          py::arg("jobs") = py::none(),
          R"(Lets a damaged robot find a gait in the map, by intelligent trial and error, as `amble adapt` does.

damage: such as "missing:FL,weak:FR_knee=0.3", or the path of a config with [damage]. engine: stands for reality.
trials: at most. episodes: attempts under different noise whose mean is a trial's result. test_trials: trials
that tell how far it gets before and after. page: path of a page to write, FILE.html. Returns a dict as the command's JSON: intact, damaged, adapted (means),
cell, done, trials. Raises Error.)")
      .def("__repr__", [](const ReadableMap& self) {
        return text_of(fmt::format("<amble.Map of {} cells, {} filled: {}>", self.elites().cells(),
                                   self.elites().size(), self.run.string()));
      });
  refuse_unmade<ReadableMap>();
  module.def("compare", compare, py::arg("champions"), py::arg("seconds") = std::vector<double>{},
             py::arg("engines") = std::vector<std::string>{}, py::kw_only(), py::arg("level") = "",
             py::arg("trials") = 0, py::arg("noise") = py::none(), py::arg("undisturbed") = false,
             R"(Lets champions walk in several engines, in the same trials, as `amble compare` does.

champions: a sequence of Champion, Run or paths. seconds: lengths of trials (default: as in evolution). engines: besides
the champions' own (default: all). level, trials: as Champion.typical() has them, but 16 trials. noise: path of a config whose
[noise] disturbs in place of a level. undisturbed: one trial without noise.
Returns a list of dicts, one per champion and length: champion, evolved_in, trial_s, under, results (a list of dicts:
engine, distance_m (the median), kept (share of that in its own engine), trials). Raises Error.)");
}

}  // namespace amble::python
