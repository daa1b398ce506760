#pragma once

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>

#include <atomic>
#include <condition_variable>
#include <exception>
#include <filesystem>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "amble/experiment/config.hpp"
#include "amble/experiment/problem.hpp"
#include "amble/io/json_file.hpp"
#include "amble/io/toml_settings.hpp"
#include "amble/neat/genome.hpp"
#include "amble/robot/spec.hpp"
#include "python/call_lock.hpp"
#include "python/interpreter_lock.hpp"

namespace amble::python {

namespace py = pybind11;

// The parts of the module, in the order in which they must be added.
void bind_config(py::module_& module);
void bind_recording(py::module_& module);
void bind_runs(py::module_& module);
void bind_maps(py::module_& module);
void bind_search(py::module_& module);
void bind_controllers(py::module_& module);
void bind_robots(py::module_& module);
void bind_view(py::module_& module);

/// A config with all that it was read from: what happens to its files later, and in which folder the process
/// is then, does not matter.
struct LoadedConfig {
  std::filesystem::path path;  ///< for messages
  io::TomlDocument document;   ///< without the assignments
  std::vector<std::string> assignments;
  experiment::Config value;
  std::shared_ptr<const robot::RobotSpec> robot;
};
LoadedConfig load_config(const std::filesystem::path& path, const py::object& overrides);
/// A Config as it is, a path as load_config() reads it. TypeError for anything else.
LoadedConfig config_of(const py::object& config_or_path);
/// Sets the seed, if there is one, as --seed does. ValueError out of range.
void set_seed(experiment::Config& config, std::optional<std::int64_t> seed);

py::object to_python(const io::Json& json);
/// By way of Python's own json module. TypeError or ValueError for what it cannot write, UserError for
/// numbers that are not finite.
io::Json to_json(const py::object& object, const std::string& what);
/// Bytes as a str, those that are not UTF-8 as os.fsdecode() has them: messages name paths.
py::str text_of(std::string_view bytes);
/// os.fsdecode(), as path_of() encodes.
py::str path_text(const std::filesystem::path& path);
/// A UserWarning at the line that called the module. Throws where warnings are errors.
void warn(std::string_view text);
/// Warnings of overrides and other parts that have no effect.
void warn_of_idle(const experiment::Config& config, const experiment::Problem& problem,
                  const std::vector<std::string>& assignments);
/// A str or os.PathLike, made absolute, as the process may go to another folder. TypeError for anything else,
/// ValueError for nothing.
std::filesystem::path path_of(const py::object& path);
/// The same as it was written.
std::filesystem::path written_path_of(const py::object& path);
/// Before a page is made: ValueError unless its name ends in .html; UserError where it cannot be written.
void check_page(const std::filesystem::path& path);
/// ValueError unless a whole number is in this range: "NAME: …".
void check_whole(const char* name, int value, int least, int most);
/// Workers: all processors if there is no number. ValueError unless it is from 1 to 1024.
int jobs_of(std::optional<int> jobs);
/// ValueError unless the length of a trial, if there is one, is from 1e-5 to 1e6 s.
void check_seconds(std::optional<double> seconds);

/// The rows of a table of comma-separated numbers, column by column; empty cells are NaN.
using Columns = std::vector<std::pair<std::string, std::vector<double>>>;
Columns parse_columns(std::string_view text);
py::dict to_dict(const Columns& columns);

/// `object` as an array of `Number`, C-contiguous, of the given shape (−1: any length), in memory of its own
/// or the caller's. TypeError for anything but real numbers; ValueError for another shape or NaN: "WHAT: …".
template <typename Number>
py::array_t<Number, py::array::c_style> numbers_of(const py::object& object, const std::string& what,
                                                   const std::vector<py::ssize_t>& shape);
/// numpy.asarray(object), its shape and that it has real numbers checked as above.
py::array checked_array(const py::object& object, const std::string& what,
                        const std::vector<py::ssize_t>& shape, std::string_view kinds = "fiu");

template <typename Number>
py::array_t<Number, py::array::c_style> numbers_of(const py::object& object, const std::string& what,
                                                   const std::vector<py::ssize_t>& shape) {
  using Array = py::array_t<Number, py::array::c_style>;
  if (Array::check_(object)) {  // the common case, without calls of Python
    auto array = py::reinterpret_borrow<Array>(object);
    bool fits = array.ndim() == static_cast<py::ssize_t>(shape.size());
    for (std::size_t i = 0; fits && i < shape.size(); ++i)
      fits = shape[i] < 0 || array.shape(static_cast<py::ssize_t>(i)) == shape[i];
    if (fits) return array;
  }
  const py::array array = checked_array(object, what, shape);
  auto numbers = py::array_t<Number, py::array::c_style | py::array::forcecast>::ensure(array);
  if (!numbers) throw py::error_already_set();
  return numbers;
}

/// An array of bool of the given length; empty for None. TypeError, ValueError.
std::vector<std::uint8_t> mask_of(const py::object& mask, py::ssize_t length,
                                  const std::string& what = "mask");

/// A read-only view of what `owner` owns, which it keeps alive. Strides in bytes.
template <typename Owner, typename Number>
py::array live_view(const std::shared_ptr<Owner>& owner, const Number* first, std::vector<py::ssize_t> shape,
                    std::vector<py::ssize_t> strides, const char* dtype) {
  const py::capsule base(new std::shared_ptr<Owner>(owner),
                         [](void* pointer) { delete static_cast<std::shared_ptr<Owner>*>(pointer); });
  py::array array(py::dtype(dtype), std::move(shape), std::move(strides), first, base);
  array.attr("setflags")(py::arg("write") = false);
  return array;
}

/// pybind11 would give memory without an object to methods of an instance that __new__ made without __init__;
/// this makes them raise TypeError. To be called once for each class of the module.
template <typename Type>
void refuse_unmade() {
  py::detail::get_type_info(typeid(Type), true)->operator_new = [](std::size_t) -> void* {
    throw py::type_error("__init__() was not called");
  };
}

/// Work that a thread of its own does while the calling thread, without the interpreter's lock, listens for
/// Ctrl-C.
class Interruptible {
 public:
  /// Set after Ctrl-C, an exception of call() or where the interpreter ends: the work is to end soon.
  const std::atomic<bool>& stop() const { return stop_; }
  /// For the work: runs a function in the thread that called run(), which has the interpreter's lock, and
  /// waits. An exception of it stops the work and leaves run() in the end.
  void call(std::function<void()> function);
  /// Returns when the work has ended. Throws what it threw, or KeyboardInterrupt. To be called with the
  /// interpreter's lock.
  void run(const std::function<void()>& work);

 private:
  void listen(std::unique_lock<std::mutex>& lock, Unlocked& unlocked);
  void guarded(const std::function<void()>& function, Unlocked& unlocked);

  std::atomic<bool> stop_{false};
  std::mutex mutex_;
  std::condition_variable changed_;
  std::function<void()> request_;
  bool done_ = false;
  std::exception_ptr failure_, python_failure_;
};

}  // namespace amble::python
