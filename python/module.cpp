#include <pybind11/pybind11.h>

#include <filesystem>
#include <system_error>

#include "amble/core/error.hpp"
#include "amble/experiment/build_info.hpp"
#include "python/bind.hpp"

namespace amble::python {
namespace {

/// amble.Error; it lives as long as the process.
PyObject* error_type = nullptr;

void raise(const char* what, ExitCode code) {
  py::object value = py::reinterpret_borrow<py::object>(error_type)(text_of(what));
  value.attr("exit_code") = static_cast<int>(code);
  PyErr_SetObject(error_type, value.ptr());
}

newfunc make_instance = nullptr;

/// Pickles of the protocols 0 and 1 make an instance of pybind11's base of all classes, which throws through
/// C.
PyObject* refuse_base(PyTypeObject* type, PyObject* arguments, PyObject* keywords) {
  if (reinterpret_cast<PyObject*>(type) != py::detail::get_internals().instance_base)
    return make_instance(type, arguments, keywords);
  PyErr_SetString(PyExc_TypeError, "objects of amble need a pickle protocol of 2 or more");
  return nullptr;
}

void guard_base() {
  auto* const base = reinterpret_cast<PyTypeObject*>(py::detail::get_internals().instance_base);
  make_instance = base->tp_new;
  base->tp_new = refuse_base;
  PyType_Modified(base);
}

/// What ends the program with a line becomes amble.Error with the same words. pybind11 would decode those of
/// ValueErrors strictly, and they name paths.
void translate(std::exception_ptr exception) {
  try {
    if (exception) std::rethrow_exception(exception);
  } catch (const UserError& error) {
    raise(error.what(), error.code());
  } catch (const std::filesystem::filesystem_error& error) {
    raise((error.path1().string() + ": " + error.code().message()).c_str(), ExitCode::io);
  } catch (const std::system_error& error) {  // of files: permissions, a full device
    raise(error.what(), ExitCode::io);
  } catch (const py::value_error& error) {
    PyErr_SetObject(PyExc_ValueError, text_of(error.what()).ptr());
  }
}

}  // namespace

PYBIND11_MODULE(_amble, module) {
  error_type = PyErr_NewExceptionWithDoc("amble.Error",
                                         "What the command line reports in one line. exit_code: what the "
                                         "program would return (docs/FORMATS.md).",
                                         nullptr, nullptr);
  if (error_type == nullptr) throw py::error_already_set();
  module.attr("Error") = py::reinterpret_borrow<py::object>(error_type);
  py::register_local_exception_translator(translate);

  py::module_::import("atexit").attr("register")(py::cpp_function(end_calls));

  guard_base();
  const auto build = experiment::build_info();
  module.attr("__version__") = build.version;
  module.attr("__commit__") = build.commit;
  bind_config(module);
  bind_recording(module);
  bind_runs(module);
  bind_maps(module);
  bind_search(module);
  bind_controllers(module);
  bind_robots(module);
  bind_view(module);
}

}  // namespace amble::python
