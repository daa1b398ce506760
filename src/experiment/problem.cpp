#include "amble/experiment/problem.hpp"

#include <filesystem>
#include <system_error>
#include <utility>

#include "amble/core/error.hpp"
#include "amble/io/file.hpp"
#include "amble/io/file_kind.hpp"
#include "amble/io/text.hpp"
#include "amble/morphology/robot_file.hpp"

namespace amble::experiment {
namespace {

/// Relative to the current folder if the file is in it: shorter in messages.
std::filesystem::path as_seen_from_here(const std::filesystem::path& file) {
  std::error_code error;
  const auto relative = file.lexically_relative(std::filesystem::current_path(error));
  return error || relative.empty() || *relative.begin() == ".." ? file : relative;
}

}  // namespace

robot::RobotSpec load_robot_file(const std::filesystem::path& path, morphology::ReadingNotes* notes) {
  const io::FileKind kind = io::file_kind(path);
  const bool is_json =
      kind == io::FileKind::robot || (kind == io::FileKind::other && path.extension() == ".json");
  if (!is_json) return morphology::load_robot(path, notes);
  return robot_from_text(io::read_file(path), path.string());
}

robot::RobotSpec load_robot(const Config& config) {
  std::error_code error;
  const auto file = as_seen_from_here(config.robot);
  if (!std::filesystem::exists(file, error) && config.locate_setting)
    fail(ExitCode::io, "{}: 'robot': {}: {}", config.locate_setting({"robot"}), io::printable(file.string()),
         error ? error.message() : "No such file or directory");
  return load_robot_file(file);
}

}  // namespace amble::experiment
