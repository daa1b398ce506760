#include <pybind11/stl.h>

#include <algorithm>

#include "amble/experiment/config.hpp"
#include "amble/experiment/idle_settings.hpp"
#include "amble/experiment/problem.hpp"
#include "python/bind.hpp"

namespace amble::python {
namespace {

/// As int and float write themselves: an IntEnum or numpy's float64 has a repr() of its own.
std::string number_text(const py::handle& number) {
  const PyTypeObject& type = PyLong_Check(number.ptr()) ? PyLong_Type : PyFloat_Type;
  const auto text = py::reinterpret_steal<py::object>(type.tp_repr(number.ptr()));
  if (!text) throw py::error_already_set();
  return text.cast<std::string>();
}

/// ValueError for a text that TOML cannot hold.
std::string utf8_of(const py::handle& text) {
  const auto bytes =
      py::reinterpret_steal<py::object>(PyUnicode_AsEncodedString(text.ptr(), "utf-8", "strict"));
  if (!bytes) {
    PyErr_Clear();
    throw py::value_error("overrides: " + py::repr(text).cast<std::string>() +
                          ": expected text that is UTF-8");
  }
  return bytes.cast<std::string>();
}

/// A key or a path of keys; what is TOML beside them would be read as such.
std::string key_of(const py::handle& name) {
  if (!py::isinstance<py::str>(name)) throw py::type_error("overrides: expected keys of type str");
  std::string key = utf8_of(name);
  bool quoted = false;
  for (const char letter : key) {
    quoted ^= letter == '"';
    if (!quoted && std::string_view("=#{}, \t\r\n").find(letter) != std::string_view::npos)
      throw py::value_error(fmt::format("overrides: '{}': expected the name of a setting", key));
  }
  return key;
}

/// Mappings of other kinds, as ChainMap, as dicts.
bool is_mapping(const py::handle& value) {
  return py::isinstance(value, py::module_::import("collections.abc").attr("Mapping"));
}

constexpr int deepest_nesting = 100;  // of what holds itself

/// A Python value as TOML: true, 3, 0.5, "text", [1, 2].
std::string toml_of(const py::handle& value, const std::string& key, int depth = 0) {
  if (depth > deepest_nesting)
    throw py::value_error(
        fmt::format("overrides: '{}': expected a value nested at most {} deep", key, deepest_nesting));
  if (py::isinstance<py::bool_>(value)) return value.cast<bool>() ? "true" : "false";
  if (py::isinstance<py::int_>(value) || py::isinstance<py::float_>(value)) return number_text(value);
  if (py::isinstance<py::str>(value))
    return utf8_of(py::module_::import("json").attr("dumps")(value, py::arg("ensure_ascii") = false));
  if (PyObject_HasAttrString(value.ptr(), "__fspath__") != 0)
    return toml_of(py::module_::import("os").attr("fsdecode")(value), key, depth);
  if (py::isinstance<py::list>(value) || py::isinstance<py::tuple>(value)) {
    std::string items;
    for (const auto& item : value) items += (items.empty() ? "" : ", ") + toml_of(item, key, depth + 1);
    return "[" + items + "]";
  }
  if (is_mapping(value)) {
    std::string items;
    for (const auto& [name, item] : py::dict(py::reinterpret_borrow<py::object>(value)))
      items += (items.empty() ? "" : ", ") + key_of(name) + " = " + toml_of(item, key, depth + 1);
    return "{" + items + "}";
  }
  if (PyObject_HasAttrString(value.ptr(), "item") != 0) {
    const py::object item = value.attr("item")();  // of numpy's long double it is one again
    if (!py::type::of(item).is(py::type::of(value))) return toml_of(item, key, depth + 1);
  }
  throw py::type_error(fmt::format("overrides: '{}': expected bool, int, float, str, list or dict, found {}",
                                   key, py::str(py::type::of(value).attr("__name__")).cast<std::string>()));
}

/// {"population": {"size": 10}} and {"population.size": 10} both give "population.size=10".
void add_assignments(const py::dict& overrides, const std::string& prefix,
                     std::vector<std::string>& assignments, int depth = 0) {
  if (depth > deepest_nesting)
    throw py::value_error(fmt::format("overrides: expected tables nested at most {} deep", deepest_nesting));
  for (const auto& [name, value] : overrides) {
    const std::string key = prefix + key_of(name);
    if (is_mapping(value))
      add_assignments(py::dict(py::reinterpret_borrow<py::object>(value)), key + ".", assignments, depth + 1);
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

std::vector<std::string> assignments_of(const py::object& overrides) {
  std::vector<std::string> assignments;
  if (overrides.is_none()) return assignments;
  if (!is_mapping(overrides)) throw py::type_error("overrides: expected a dict");
  add_assignments(py::dict(overrides), "", assignments);
  return assignments;
}

/// The document with the assignments laid over it. `known`: the robot, if they have been read already, with
/// its path.
LoadedConfig configured(const std::filesystem::path& path, const io::TomlDocument& document,
                        std::vector<std::string> assignments, const LoadedConfig* known = nullptr) {
  auto value = experiment::config_from(document, {.assignments = assignments, .seed = {}, .generations = {}});
  std::shared_ptr<const robot::RobotSpec> robot;
  if (known != nullptr) {
    value.robot = known->value.robot;
    robot = known->robot;
  } else {
    const Unlocked unlocked;
    robot = std::make_shared<const robot::RobotSpec>(experiment::load_robot(value));
  }
  return {path, document, std::move(assignments), std::move(value), std::move(robot)};
}

LoadedConfig replaced(const LoadedConfig& config, const py::object& overrides) {
  const auto more = assignments_of(overrides);
  const auto sets = [&more](std::string_view key) {
    return std::ranges::any_of(more, [key](const std::string& assignment) {
      return std::string_view(assignment).substr(0, assignment.find('=')) == key;
    });
  };
  auto assignments = config.assignments;
  assignments.insert(assignments.end(), more.begin(), more.end());
  auto other =
      configured(config.path, config.document, std::move(assignments), sets("robot") ? nullptr : &config);
  if (!sets("seed")) other.value.seed = config.value.seed;  // which may have been an argument
  return other;
}

/// Path, document, assignments, the robot's path and the robot: needs no other file.
py::tuple pickled(const LoadedConfig& config) {
  return py::make_tuple(path_text(config.path), config.document.text(), config.assignments,
                        path_text(config.value.robot), experiment::robot_file_text(*config.robot),
                        config.value.seed);
}

LoadedConfig unpickled(const py::tuple& state) {
  if (state.size() != 6) throw py::value_error("Config: not its pickled state");
  const auto name = written_path_of(state[0]).string();
  LoadedConfig known{name, io::TomlDocument::parse(state[1].cast<std::string>(), name), {}, {}, nullptr};
  known.value.robot = written_path_of(state[3]).string();
  known.robot = std::make_shared<const robot::RobotSpec>(
      experiment::robot_from_text(state[4].cast<std::string>(), name + ": its robot"));
  auto config = configured(name, known.document, state[2].cast<std::vector<std::string>>(), &known);
  set_seed(config.value, state[5].cast<std::int64_t>());
  return config;
}

}  // namespace

LoadedConfig load_config(const std::filesystem::path& path, const py::object& overrides) {
  return configured(path, io::TomlDocument::read(path), assignments_of(overrides));
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

void warn_of_idle(const experiment::Config& config, const experiment::Problem& problem,
                  const std::vector<std::string>& assignments) {
  for (const auto& idle : experiment::idle_assignments(config, assignments)) warn("overrides: " + idle);
  for (const auto& idle : experiment::idle_parts(problem)) warn(idle);
}

void bind_config(py::module_& module) {
  py::class_<LoadedConfig>(module, "Config", R"(All settings of a run, read and checked (docs/SETTINGS.md).

Made by load_config(), which reads the robot as well: what happens to the files later changes nothing. Can be pickled.
Reads like a dict: config["population.size"], config["population"]["size"], dict(config).
A change makes another Config: config.replace({"population.size": 50}).)")
      .def(
          "to_dict", [](const LoadedConfig& self) { return to_python(io::settings_to_json(self.value)); },
          "Every setting with its value, tables as dicts. A copy.")
      .def(
          "to_toml", [](const LoadedConfig& self) { return text_of(self.value.to_toml()); },
          "The whole config as TOML with comments; reads back to the same values.")
      .def("replace", replaced, py::arg("overrides"),
           "Another Config: what the file said when it was read, with more overrides (load_config), and the "
           "same seed unless they set it.")
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
      .def(py::pickle(&pickled, &unpickled))
      .def("__repr__", [](const LoadedConfig& self) {
        return text_of(fmt::format("<amble.Config '{}': {}>", self.value.name, self.path.string()));
      });

  module.def(
      "load_config",
      [](const py::object& path, const py::object& overrides) {
        return load_config(path_of(path), overrides);
      },
      py::arg("path"), py::arg("overrides") = py::none(),
      R"(Reads a config file (TOML) and the robot that it names, and checks them.

overrides: {"population.size": 100} or {"population": {"size": 100}}, laid over the file as by --set.
Raises Error as the command line reports it: file, line, key, value and what was expected.)");
  refuse_unmade<LoadedConfig>();
}

}  // namespace amble::python
