#include <pybind11/stl.h>

#include <algorithm>

#include "amble/core/index.hpp"
#include "amble/gait/recorded_gait.hpp"
#include "amble/gait/report_text.hpp"
#include "amble/io/file_kind.hpp"
#include "amble/record/recording.hpp"
#include "python/bind.hpp"
#include "python/readable.hpp"

namespace amble::python {
namespace {

constexpr py::ssize_t number_size = sizeof(float);

/// A view that keeps its owner and cannot be written to.
py::array read_only(py::array view) {
  view.attr("setflags")(py::arg("write") = false);
  return view;
}

py::array column_of(const py::object& self, const std::string& name) {
  const auto& recording = self.cast<const ReadRecording&>();
  const auto& names = recording.header.columns;
  const auto at = std::find(names.begin(), names.end(), name);
  if (at == names.end()) throw py::key_error(name);
  return read_only(py::array_t<float>({recording.count()}, {recording.width() * number_size},
                                      recording.frames.data() + (at - names.begin()), self));
}

/// All columns that begin so, as an array of frames × names.
py::array columns_with(const ReadRecording& recording, const std::string& prefix) {
  std::vector<std::size_t> places;
  for (std::size_t i = 0; i < recording.header.columns.size(); ++i)
    if (recording.header.columns[i].starts_with(prefix)) places.push_back(i);
  py::array_t<float> values({recording.count(), static_cast<py::ssize_t>(places.size())});
  float* to = values.mutable_data();
  for (py::ssize_t f = 0; f < recording.count(); ++f)
    for (const std::size_t place : places) *to++ = recording.frames[to_index(f * recording.width()) + place];
  return values;
}

py::object gait(const py::object& recording, std::optional<double> seconds) {
  // What walks again is a champion's own affair.
  if (py::isinstance<ReadableChampion>(recording)) return recording.attr("gait")(seconds);
  if (py::isinstance<ReadableRun>(recording)) return recording.attr("champion")().attr("gait")(seconds);
  const bool in_memory = py::isinstance<ReadRecording>(recording);
  const auto path = in_memory ? recording.cast<const ReadRecording&>().path : path_of(recording);
  check_seconds(seconds);
  const io::FileKind kind = in_memory ? io::FileKind::recording : io::file_kind(path);
  if (kind == io::FileKind::folder || kind == io::FileKind::champion)
    return py::cast(champion_at(path)).attr("gait")(seconds);
  std::string text;
  {
    const ReadRecording* const held = in_memory ? &recording.cast<const ReadRecording&>() : nullptr;
    const Unlocked unlocked;
    auto reader = held != nullptr ? held->reader() : record::RecordingReader(path);
    text = gait::report_json(gait::recorded_gait(reader, path.string(), {}, seconds));
  }
  return to_python(io::parse_json(text, "gait"));
}

}  // namespace

void bind_recording(py::module_& module) {
  py::class_<ReadRecording>(module, "Recording",
                            R"(A recording: float32 numbers, frame by frame (docs/FORMATS.md).

recording["com.x"] is one column, a view of the frames; "angle.fl_knee", "target.fl_knee", "touch.FL" and so on.
Read once, it needs its file no more. Can be pickled.)")
      .def(py::init([](const py::object& path) {
             const auto file = path_of(path);
             const Unlocked unlocked;
             return ReadRecording(file);
           }),
           py::arg("path"), "Raises Error for a file that is not sound.")
      .def_property_readonly(
          "path", [](const ReadRecording& self) { return path_text(self.path); },
          "The file that it was read from.")
      .def(py::pickle(
          [](const ReadRecording& self) {
            return py::make_tuple(path_text(self.path), py::bytes(self.bytes));
          },
          [](const py::tuple& state) {
            if (state.size() != 2) throw py::value_error("Recording: not its pickled state");
            return std::make_unique<ReadRecording>(state[1].cast<std::string>(), written_path_of(state[0]));
          }))
      .def_property_readonly(
          "columns", [](const ReadRecording& self) { return self.header.columns; }, "Their names.")
      .def_property_readonly(
          "frame_s", [](const ReadRecording& self) { return self.header.frame_s; }, "Time between frames, s.")
      .def_property_readonly(
          "outcome",
          [](const ReadRecording& self) {
            return std::string(record::outcome_names[to_index(self.outcome)]);
          },
          "completed, fell or diverged.")
      .def_property_readonly(
          "origin", [](const ReadRecording& self) { return text_of(self.header.origin); },
          "The champion that it shows.")
      .def_property_readonly(
          "robot",
          [](const ReadRecording& self) {
            return to_python(io::parse_json(self.header.robot_json, self.path.string() + ": robot"));
          },
          "The robot, a dict (docs/FORMATS.md).")
      .def_property_readonly(
          "frames",
          [](const py::object& self) {
            const auto& recording = self.cast<const ReadRecording&>();
            return read_only(
                py::array_t<float>({recording.count(), recording.width()}, recording.frames.data(), self));
          },
          "All numbers: a read-only view, frames × columns, float32.")
      .def(
          "matching", columns_with, py::arg("prefix"),
          R"(The columns whose names begin so, a copy: frames × columns, float32. "angle.": all joint angles, rad.)")
      .def("__getitem__", column_of, py::arg("column"))
      .def(
          "__contains__",
          [](const ReadRecording& self, const std::string& name) {
            return std::find(self.header.columns.begin(), self.header.columns.end(), name) !=
                   self.header.columns.end();
          },
          py::arg("column"))
      .def("__len__", [](const ReadRecording& self) { return self.count(); })
      .def("__repr__", [](const ReadRecording& self) {
        return text_of(fmt::format("<amble.Recording of {} frames, {}: {}>", self.count(),
                                   record::outcome_names[to_index(self.outcome)], self.path.string()));
      });
  module.def("gait", gait, py::arg("recording"), py::arg("seconds") = py::none(),
             R"(Names and measures a gait (docs/GAIT.md): the dict that `amble gait --json` writes.

recording: Recording or its path; or a Champion or Run, which walks for it (Champion.gait). seconds: the part of a recording to
use, from the beginning, at most all of a trial that was completed; of a champion the length of its trial. Raises Error.)");
  refuse_unmade<ReadRecording>();
}

}  // namespace amble::python
