#include <pybind11/stl.h>

#include "amble/experiment/champion.hpp"
#include "amble/experiment/run_folder.hpp"
#include "amble/io/file.hpp"
#include "amble/presentation/walkers_page.hpp"
#include "python/bind.hpp"
#include "python/readable.hpp"
#include "python/trial_choice.hpp"

namespace amble::python {
namespace {

/// The folder of a run that was given as such; nothing if it is something else.
std::optional<std::filesystem::path> run_folder_of(const py::object& object) {
  if (py::isinstance<ReadableRun>(object)) return object.cast<const ReadableRun&>().paths().folder;
  if (py::isinstance<ReadableChampion>(object) || py::isinstance<ReadRecording>(object)) return std::nullopt;
  const auto path = path_of(object);
  return std::filesystem::is_directory(path) ? std::optional(path) : std::nullopt;
}

/// As `amble view` takes its inputs.
bool is_recording(const py::object& object) {
  if (py::isinstance<ReadRecording>(object)) return true;
  if (py::isinstance<ReadableChampion>(object) || run_folder_of(object)) return false;
  return path_of(object).extension() != ".json";
}

void add_recording(presentation::WalkersPage& page, const py::object& object) {
  if (!py::isinstance<ReadRecording>(object)) {
    const auto path = path_of(object);
    const Unlocked unlocked;
    return page.add_recording(path);
  }
  // What was read, which its file may not have any more.
  const auto& recording = object.cast<const ReadRecording&>();
  const Unlocked unlocked;
  page.add_recording(recording.bytes, recording.path);
}

void add_champion(presentation::WalkersPage& page, const py::object& object) {
  const auto run = run_folder_of(object);
  const auto champion = py::isinstance<ReadableChampion>(object)
                            ? object.cast<const ReadableChampion&>()
                            : champion_at(run ? experiment::find_run(*run).best_champion() : path_of(object));
  Interruptible interruptible;
  interruptible.run(
      [&] { page.add_champion(champion.value, champion.origin(), run, jobs_of({}), interruptible.stop()); });
}

/// The champions of a run from first to last, for the page.
py::list history_of(const py::list& all) {
  const auto run = all.size() == 1 ? run_folder_of(all[0]) : std::nullopt;
  if (!run) throw py::value_error("history: expected one Run, or the path of its folder");
  py::list ages;
  for (const auto& file : presentation::champions_of_history(*run)) ages.append(path_text(file));
  return ages;
}

struct ViewArguments {
  std::optional<double> seconds;
  std::optional<std::string> engine;
  std::string level;
  py::object noise;
  int trials = 0;
  bool undisturbed = false, history = false;
  std::optional<std::string> title;
};

std::string html_of(const py::list& given, const ViewArguments& arguments) {
  check_seconds(arguments.seconds);
  if (given.empty()) throw py::value_error("expected at least one champion, run or recording");
  const auto choice = trial_choice(arguments.level, arguments.noise, arguments.trials, arguments.undisturbed);
  const presentation::WalkersPageOptions options{
      .walk = {.seconds = arguments.seconds, .engine = arguments.engine},
      .disturbance = choice,
      .title = arguments.title,
      .history = arguments.history};
  presentation::WalkersPage page(options);
  const py::list shown = arguments.history ? history_of(given) : given;
  for (const auto& item : shown) {
    const auto object = py::reinterpret_borrow<py::object>(item);
    if (!is_recording(object)) {
      add_champion(page, object);
      continue;
    }
    if (const auto key = options.not_for_recordings(); !key.empty())
      throw py::value_error(fmt::format("{}: a recording has been made already", key));
    add_recording(page, object);
  }
  const Unlocked unlocked;
  return std::move(page).html();
}

py::str save_page(const py::object& path, const py::str& html) {
  const auto file = path_of(path);
  check_page(file);
  const auto bytes =
      py::reinterpret_steal<py::bytes>(PyUnicode_AsEncodedString(html.ptr(), "utf-8", "surrogateescape"));
  if (!bytes) throw py::error_already_set();
  const auto text = static_cast<std::string>(bytes);
  {
    const Unlocked unlocked;
    io::write_output(file, text);
  }
  return path_text(file);
}

}  // namespace

void bind_view(py::module_& module) {
  module.def(
      "_page",
      [](const py::list& shown, std::optional<double> seconds, std::optional<std::string> engine,
         std::string level, py::object noise, int trials, bool undisturbed, bool history,
         std::optional<std::string> title) {
        return text_of(html_of(shown, {seconds, std::move(engine), std::move(level), std::move(noise), trials,
                                       undisturbed, history, std::move(title)}));
      },
      py::arg("shown"), py::arg("seconds"), py::arg("engine"), py::arg("level"), py::arg("noise"),
      py::arg("trials"), py::arg("undisturbed"), py::arg("history"), py::arg("title"),
      "The page of amble.view(), as text.");
  module.def("_save_page", save_page, py::arg("path"), py::arg("html"),
             "Page.save(): writes the text of a page; returns the absolute path, a str.");
}

}  // namespace amble::python
