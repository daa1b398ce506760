#include <algorithm>
#include <charconv>
#include <chrono>
#include <cmath>
#include <limits>
#include <thread>

#include "amble/core/error.hpp"
#include "amble/io/file.hpp"
#include "python/bind.hpp"

namespace amble::python {

py::object to_python(const io::Json& json) {
  switch (json.type()) {
    case io::Json::value_t::object: {
      py::dict dict;
      for (const auto& [key, value] : json.items()) dict[text_of(key)] = to_python(value);
      return dict;
    }
    case io::Json::value_t::array: {
      py::list list;
      for (const auto& value : json) list.append(to_python(value));
      return list;
    }
    case io::Json::value_t::string:
      return text_of(json.get_ref<const std::string&>());
    case io::Json::value_t::boolean:
      return py::bool_(json.get<bool>());
    case io::Json::value_t::number_integer:
      return py::int_(json.get<std::int64_t>());
    case io::Json::value_t::number_unsigned:
      return py::int_(json.get<std::uint64_t>());
    case io::Json::value_t::number_float:
      return py::float_(json.get<double>());
    default:
      return py::none();
  }
}

namespace {

/// Where in dicts and lists the first number is that is not finite, as "links[2].weight"; empty: nowhere.
std::string not_finite_in(const py::handle& value, const std::string& place) {
  std::string found;
  if (py::isinstance<py::float_>(value)) return std::isfinite(value.cast<double>()) ? "" : place;
  if (py::isinstance<py::dict>(value)) {
    for (const auto& [key, member] : value.cast<py::dict>()) {
      // Half a surrogate pair in a key has no UTF-8.
      const py::bytes utf8 = py::str(key).attr("encode")("utf-8", "backslashreplace");
      const std::string name = utf8;
      found = not_finite_in(member, place.empty() ? name : fmt::format("{}.{}", place, name));
      if (!found.empty()) return found;
    }
  } else if (py::isinstance<py::list>(value)) {
    const auto list = value.cast<py::list>();
    for (std::size_t i = 0; i < list.size() && found.empty(); ++i)
      found = not_finite_in(list[i], fmt::format("{}[{}]", place, i));
  }
  return found;
}

}  // namespace

io::Json to_json(const py::object& object, const std::string& what) {
  // Numbers of numpy are written as Python's.
  const py::cpp_function plain([&what](const py::object& value) -> py::object {
    if (PyObject_HasAttrString(value.ptr(), "item") != 0) return value.attr("item")();
    throw py::type_error(fmt::format("{}: expected numbers, texts, lists and dicts, found {}", what,
                                     py::str(py::type::of(value).attr("__name__")).cast<std::string>()));
  });
  const py::module_ json = py::module_::import("json");
  const auto written = [&](bool allow_nan) {
    return json.attr("dumps")(object, py::arg("default") = plain, py::arg("allow_nan") = allow_nan);
  };
  try {
    return io::parse_json(written(false).cast<std::string>(), what);
  } catch (const py::error_already_set& error) {
    if (!error.matches(PyExc_ValueError)) throw;
  }
  // Also thrown, and again here, for what contains itself.
  const std::string place = not_finite_in(json.attr("loads")(written(true)), "");
  fail(ExitCode::bad_input, "{}: key '{}' must be a finite number", what, place);
}

py::str text_of(std::string_view bytes) {
  PyObject* const text =
      PyUnicode_DecodeUTF8(bytes.data(), static_cast<py::ssize_t>(bytes.size()), "surrogateescape");
  if (text == nullptr) throw py::error_already_set();
  return py::reinterpret_steal<py::str>(text);
}

py::str path_text(const std::filesystem::path& path) {
  const std::string& bytes = path.native();
  PyObject* const text =
      PyUnicode_DecodeFSDefaultAndSize(bytes.data(), static_cast<py::ssize_t>(bytes.size()));
  if (text == nullptr) throw py::error_already_set();
  return py::reinterpret_steal<py::str>(text);
}

void warn(std::string_view text) {
  const py::str message = text_of(text);
  if (unless_it_ends([&] { return PyErr_WarnFormat(PyExc_UserWarning, 1, "%U", message.ptr()); }) != 0)
    throw py::error_already_set();
}

std::filesystem::path path_of(const py::object& path) {
  const auto written = written_path_of(path);
  if (written.empty()) throw py::value_error("a path must not be empty: expected a file or folder");
  return std::filesystem::absolute(written);
}

std::filesystem::path written_path_of(const py::object& path) {
  py::object text = py::reinterpret_steal<py::object>(PyOS_FSPath(path.ptr()));
  if (!text) throw py::error_already_set();
  if (!py::isinstance<py::str>(text)) throw py::type_error("a path must be str or os.PathLike, not bytes");
  const auto bytes = py::reinterpret_steal<py::bytes>(PyUnicode_EncodeFSDefault(text.ptr()));
  if (!bytes) throw py::error_already_set();
  const auto encoded = static_cast<std::string>(bytes);
  if (encoded.find('\0') != std::string::npos) throw py::value_error("a path must not have null characters");
  return encoded;
}

void check_page(const std::filesystem::path& path) {
  if (path.extension() != ".html")
    throw py::value_error(fmt::format("page: {}: expected a name that ends in .html", path.string()));
  io::check_output(path, "<!DOCTYPE html>", "a page");
}

void check_whole(const char* name, int value, int least, int most) {
  if (value < least || value > most)
    throw py::value_error(
        fmt::format("{}: {}: expected a whole number from {} to {}", name, value, least, most));
}

int jobs_of(std::optional<int> jobs) {
  constexpr int most = 1024;
  if (!jobs) return std::clamp(static_cast<int>(std::thread::hardware_concurrency()), 1, most);
  check_whole("jobs", *jobs, 1, most);
  return *jobs;
}

void check_seconds(std::optional<double> seconds) {
  if (seconds && !(*seconds >= 1e-5 && *seconds <= 1e6))
    throw py::value_error(fmt::format("seconds: {}: expected a number from 1e-05 to 1000000", *seconds));
}

std::vector<std::uint8_t> mask_of(const py::object& mask, py::ssize_t length, const std::string& what) {
  if (mask.is_none()) return {};
  const auto values = py::array_t<bool, py::array::c_style | py::array::forcecast>::ensure(
      checked_array(mask, what, {length}, "b"));
  if (!values) throw py::error_already_set();
  return {values.data(), values.data() + values.size()};
}

Columns parse_columns(std::string_view text) {
  Columns columns;
  const auto take = [](std::string_view& rest, char end) {
    const std::size_t at = rest.find(end);
    const std::string_view part = rest.substr(0, at);
    rest.remove_prefix(at == std::string_view::npos ? rest.size() : at + 1);
    return part;
  };
  std::string_view header = take(text, '\n');
  while (!header.empty()) columns.emplace_back(take(header, ','), std::vector<double>());
  while (!text.empty()) {
    std::string_view line = take(text, '\n');
    for (auto& [name, values] : columns) {
      const std::string_view cell = take(line, ',');
      double value = std::numeric_limits<double>::quiet_NaN();
      std::from_chars(cell.data(), cell.data() + cell.size(), value);
      values.push_back(value);
    }
  }
  return columns;
}

py::dict to_dict(const Columns& columns) {
  py::dict dict;
  for (const auto& [name, values] : columns)
    dict[py::str(name)] = py::array_t<double>(static_cast<py::ssize_t>(values.size()), values.data());
  return dict;
}

py::array checked_array(const py::object& object, const std::string& what,
                        const std::vector<py::ssize_t>& shape, std::string_view kinds) {
  const py::object converted = py::module_::import("numpy").attr("asarray")(object);
  auto array = converted.cast<py::array>();
  if (kinds.find(array.dtype().kind()) == std::string_view::npos)
    throw py::type_error(fmt::format("{}: expected {}, found an array of {}", what,
                                     kinds == "b" ? "an array of bool" : "real numbers",
                                     py::str(array.dtype()).cast<std::string>()));
  bool fits = array.ndim() == static_cast<py::ssize_t>(shape.size());
  for (std::size_t i = 0; fits && i < shape.size(); ++i)
    fits = shape[i] < 0 || array.shape(static_cast<py::ssize_t>(i)) == shape[i];
  if (!fits) {
    std::string expected;
    for (const auto length : shape)
      expected += (expected.empty() ? "" : ", ") + (length < 0 ? "any" : std::to_string(length));
    throw py::value_error(fmt::format("{}: expected the shape ({}), found {}", what, expected,
                                      py::str(array.attr("shape")).cast<std::string>()));
  }
  return array;
}

void Interruptible::call(std::function<void()> function) {
  std::unique_lock lock(mutex_);
  request_ = std::move(function);
  changed_.notify_all();
  changed_.wait(lock, [this] { return request_ == nullptr; });
}

void Interruptible::run(const std::function<void()>& work) {
  {
    Unlocked unlocked;
    const std::jthread worker([&] {
      try {
        work();
      } catch (...) {
        failure_ = std::current_exception();
      }
      const std::lock_guard lock(mutex_);
      done_ = true;
      changed_.notify_all();
    });
    std::unique_lock lock(mutex_);
    while (!done_) listen(lock, unlocked);
  }
  if (python_failure_) std::rethrow_exception(python_failure_);
  if (failure_) std::rethrow_exception(failure_);
}

void Interruptible::listen(std::unique_lock<std::mutex>& lock, Unlocked& unlocked) {
  constexpr std::chrono::milliseconds patience{50};
  changed_.wait_for(lock, patience, [this] { return done_ || request_ != nullptr; });
  if (done_) return;
  if (ends_elsewhere()) stop_ = true;
  const auto request = request_;
  lock.unlock();
  const auto heed_signals = [] {
    if (PyErr_CheckSignals() != 0) throw py::error_already_set();
  };
  guarded(request ? request : heed_signals, unlocked);
  lock.lock();
  if (request) request_ = nullptr;
  changed_.notify_all();
}

/// Once something was thrown, later calls are left out: the work is to end.
void Interruptible::guarded(const std::function<void()>& function, Unlocked& unlocked) {
  if (python_failure_) return;
  unlocked.with_lock([&] {
    try {
      function();
    } catch (...) {
      python_failure_ = std::current_exception();
      stop_ = true;
    }
  });
}

}  // namespace amble::python
