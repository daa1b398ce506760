#include "amble/cli/outputs.hpp"

#include <map>
#include <string>
#include <system_error>

#include "amble/core/error.hpp"
#include "amble/experiment/run_paths.hpp"
#include "amble/io/file.hpp"
#include "amble/io/text.hpp"

namespace amble::cli {
namespace fs = std::filesystem;

fs::path resolved(const fs::path& path) {
  std::error_code error;
  const fs::path found = fs::weakly_canonical(fs::absolute(path), error);
  return error ? fs::absolute(path).lexically_normal() : found;
}

void prepare_output(const fs::path& path) {
  experiment::refuse_among_champions(path);
  io::keep_stdout_for(path);
}

void check_output(const fs::path& path, std::string_view beginning, std::string_view what) {
  io::check_output(path, beginning, what);
  prepare_output(path);
}

void check_drawing(std::string_view option, const fs::path& path) {
  check_output(path, "<svg", "a drawing");
  if (path.extension() != ".svg")
    fail(ExitCode::bad_input, "{} {}: expected a name that ends in .svg", option,
         io::printable(path.string()));
}

void check_distinct(std::initializer_list<std::pair<std::string_view, fs::path>> options_and_paths) {
  std::map<fs::path, std::string_view> options;
  for (const auto& [option, path] : options_and_paths) {
    if (path.empty()) continue;
    if (const auto [other, is_new] = options.emplace(resolved(path), option); !is_new)
      fail(ExitCode::bad_input, "{} and {} both write {}; expected two files", other->second, option,
           io::printable(path.string()));
  }
}

}  // namespace amble::cli
