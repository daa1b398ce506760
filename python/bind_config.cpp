#include <pybind11/stl.h>

#include "amble/experiment/config.hpp"
#include "python/bind.hpp"

namespace amble::python {
namespace {

/// A Python value as TOML: true, 3, 0.5, "text", [1, 2].
std::string toml_of(const py::handle& value, const std::string& key) {
  if (py::isinstance<py::bool_>(value)) return value.cast<bool>() ? "true" : "false";
  if (py::isinstance<py::int_>(value) || py::isinstance<py::float_>(value)) return py::repr(value);
  if (py::isinstance<py::str>(value))
    return py::module_::import("json")
        .attr("dumps")(value, py::arg("ensure_ascii") = false)
        .cast<std::string>();
  if (py::isinstance<py::list>(value) || py::isinstance<py::tuple>(value)) {
    std::string items;
    for (const auto& item : value) items += (items.empty() ? "" : ", ") + toml_of(item, key);
    return "[" + items + "]";
  }
  if (py::isinstance<py::dict>(value)) {
    std::string items;
    for (const auto& [name, item] : value.cast<py::dict>())
      items += (items.empty() ? "" : ", ") + py::str(name).cast<std::string>() + " = " + toml_of(item, key);
    return "{" + items + "}";
  }
  if (PyObject_HasAttrString(value.ptr(), "item") != 0) return toml_of(value.attr("item")(), key);
  throw py::type_error(fmt::format("overrides: '{}': expected bool, int, float, str, list or dict, found {}",
                                   key, py::str(py::type::of(value).attr("__name__")).cast<std::string>()));
}

/// {"population": {"size": 10}} and {"population.size": 10} both give "population.size=10".
void add_assignments(const py::dict& overrides, const std::string& prefix,
                     std::vector<std::string>& assignments) {
  for (const auto& [name, value] : overrides) {
    if (!py::isinstance<py::str>(name)) throw py::type_error("overrides: expected keys of type str");
    const std::string key = prefix + name.cast<std::string>();
    if (py::isinstance<py::dict>(value))
      add_assignments(value.cast<py::dict>(), key + ".", assignments);
    else
      assignments.push_back(key + "=" + toml_of(value, key));
  }
}

/// The value of "population.size" or of the table "population".
py::object item_of(const LoadedConfig& config, const std::string& key) {
  py::object value = to_python(io::settings_to_json(config.value));
  std::string_view rest = key;
  while (true) {
    const std::size_t dot = rest.find('.');
    const py::str name{std::string(rest.substr(0, dot))};
    if (!py::isinstance<py::dict>(value) || !value.cast<py::dict>().contains(name)) throw py::key_error(key);
    value = value[name];
    if (dot == std::string_view::npos) return value;
    rest.remove_prefix(dot + 1);
  }
}

}  // namespace

LoadedConfig load_config(const std::filesystem::path& path, const py::object& overrides,
                         std::vector<std::string> assignments) {
  if (!overrides.is_none()) {
    if (!py::isinstance<py::dict>(overrides)) throw py::type_error("overrides: expected a dict");
    add_assignments(overrides.cast<py::dict>(), "", assignments);
  }
  auto value = experiment::load_config(path, {.assignments = assignments, .seed = {}, .generations = {}});
  return {path, std::move(assignments), std::move(value)};
}

LoadedConfig config_of(const py::object& config_or_path) {
  if (py::isinstance<LoadedConfig>(config_or_path)) return config_or_path.cast<const LoadedConfig&>();
  return load_config(path_of(config_or_path), py::none());
}

void set_seed(experiment::Config& config, std::optional<std::int64_t> seed) {
  if (!seed) return;
  if (*seed < 0 || *seed > experiment::largest_seed)
    throw py::value_error(
        fmt::format("seed: {}: expected a whole number from 0 to {}", *seed, experiment::largest_seed));
  config.seed = *seed;
}

void bind_config(py::module_& module) {
  py::class_<LoadedConfig>(module, "Config", R"(All settings of a run, read and checked (docs/SETTINGS.md).

Made by load_config(). Reads like a dict: config["population.size"], config["population"]["size"], dict(config).
A change makes another Config: config.replace({"population.size": 50}).)")
      .def(
          "to_dict", [](const LoadedConfig& self) { return to_python(io::settings_to_json(self.value)); },
          "Every setting with its value, tables as dicts. A copy.")
      .def(
          "to_toml", [](const LoadedConfig& self) { return self.value.to_toml(); },
          "The whole config as TOML with comments; reads back to the same values.")
      .def(
          "replace",
          [](const LoadedConfig& self, const py::object& overrides) {
            return load_config(self.path, overrides, self.assignments);
          },
          py::arg("overrides"), "Another Config: the file read again, with more overrides (load_config).")
      .def(
          "keys",
          [](const LoadedConfig& self) { return to_python(io::settings_to_json(self.value)).attr("keys")(); },
          "Names of the top table.")
      .def("__iter__",
           [](const LoadedConfig& self) { return py::iter(to_python(io::settings_to_json(self.value))); })
      .def("__len__",
           [](const LoadedConfig& self) { return py::len(to_python(io::settings_to_json(self.value))); })
      .def("__getitem__", item_of, py::arg("key"))
      .def(
          "__contains__",
          [](const LoadedConfig& self, const std::string& key) {
            try {
              item_of(self, key);
              return true;
            } catch (const py::key_error&) {
              return false;
            }
          },
          py::arg("key"))
      .def("__repr__", [](const LoadedConfig& self) {
        return fmt::format("<amble.Config '{}': {}>", self.value.name, self.path.string());
      });

  module.def(
      "load_config",
      [](const py::object& path, const py::object& overrides) {
        return load_config(path_of(path), overrides);
      },
      py::arg("path"), py::arg("overrides") = py::none(),
      R"(Reads a config file (TOML) and checks it.

overrides: {"population.size": 100} or {"population": {"size": 100}}, laid over the file as by --set.
Raises Error as the command line reports it: file, line, key, value and what was expected.)");
  refuse_unmade<LoadedConfig>();
}

}  // namespace amble::python
