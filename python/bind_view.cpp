#include <pybind11/stl.h>

#include "amble/experiment/champion.hpp"
#include "amble/io/file.hpp"
#include "amble/presentation/shown_trial.hpp"
#include "amble/presentation/walker.hpp"
#include "python/bind.hpp"
#include "python/readable.hpp"

namespace amble::python {
namespace {

/// As `amble view` takes its inputs.
bool is_recording_file(const std::filesystem::path& path) {
  return !std::filesystem::is_directory(path) && path.extension() != ".json";
}

page::Walker walker_of(const py::object& object, const presentation::WalkOptions& options,
                       const presentation::TrialChoice& choice, const io::ScratchFile& scratch) {
  const bool is_recording = py::isinstance<ReadRecording>(object);
  if (is_recording || (!py::isinstance<ReadableChampion>(object) && !py::isinstance<ReadableRun>(object) &&
                       is_recording_file(path_of(object)))) {
    if (options.seconds || options.engine || choice.undisturbed)
      throw py::value_error("a recording has been made already: no seconds, no engine, not undisturbed");
    if (!is_recording) {
      const auto path = path_of(object);
      const py::gil_scoped_release release;
      return presentation::recorded(path);
    }
    // What was read, which its file may not have any more.
    const auto& recording = object.cast<const ReadRecording&>();
    const py::gil_scoped_release release;
    io::write_file(scratch.path(), recording.bytes);
    auto walker = presentation::recorded(scratch.path());
    walker.title = recording.path.stem().string();
    return walker;
  }
  const auto champion = py::isinstance<ReadableChampion>(object)
                            ? object.cast<const ReadableChampion&>()
                            : champion_at(py::isinstance<ReadableRun>(object)
                                              ? object.cast<const ReadableRun&>().paths().best_champion()
                                              : path_of(object));
  std::optional<page::Walker> walker;
  Interruptible interruptible;
  interruptible.run([&] {
    experiment::Champion shown_of = champion.value;
    presentation::WalkOptions how = options;
    const auto shown = presentation::shown_trial(shown_of, how.seconds, how.engine, choice, jobs_of({}),
                                                 interruptible.stop());
    if (!shown) return;
    shown_of.problem.noise = shown->noise;
    how.noise = shown->key;
    walker = presentation::walk(shown_of, champion.origin(), how, scratch.path(), interruptible.stop());
    if (!walker) return;
    walker->typical = shown->typical;
    walker->shown = shown->which();
  });
  return std::move(*walker);
}

std::string page_of(const py::object& champion, std::optional<double> seconds,
                    std::optional<std::string> engine, bool undisturbed) {
  check_seconds(seconds);
  const io::ScratchFile scratch("walk.rec");
  page::ReplayPage page{.title = {}, .walkers = {}, .made_by = presentation::made_by()};
  page.walkers.push_back(walker_of(champion, {.seconds = seconds, .engine = std::move(engine)},
                                   {.level = {}, .undisturbed = undisturbed}, scratch));
  page.title = page.walkers.front().title;
  const py::gil_scoped_release release;
  return page::make_page(page);
}

}  // namespace

void bind_view(py::module_& module) {
  module.def("_page", page_of, py::arg("champion"), py::arg("seconds"), py::arg("engine"),
             py::arg("undisturbed"), "The page of amble.view(), as text.");
}

}  // namespace amble::python
