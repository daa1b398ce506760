#include "amble/io/file_kind.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <string>

#include "amble/core/error.hpp"
#include "amble/io/file.hpp"
#include "amble/io/quoting.hpp"
#include "amble/io/toml_settings.hpp"

namespace amble::io {
namespace fs = std::filesystem;
namespace {

// A licence may stand before the model.
constexpr std::size_t beginning_bytes = 65536;
constexpr std::string_view recording_start = "AMBLEREC";

/// What a kind is called, and the command for such a file.
struct Told {
  FileKind kind;
  std::string_view name, command, more;
};
constexpr std::array<Told, 7> told{{
    {FileKind::champion, "a champion", "to look at the walker, run: amble view", " -o walker.html"},
    {FileKind::recording, "a recording", "to look at it, run: amble view", " -o walker.html"},
    {FileKind::robot, "the robot of a run", "to look at it, run: amble robot", " --draw ROBOT.svg"},
    {FileKind::side_file, "a robot file", "to look at the robot, run: amble robot", " --draw ROBOT.svg"},
    {FileKind::config, "the config of a run", "to evolve walkers by it, run: amble evolve", " --out FOLDER"},
    {FileKind::study, "a study", "to run it, run: amble study", " --out FOLDER"},
    {FileKind::model, "the model of a robot", "to make a robot of it, run: amble robot --init", ""},
}};

/// The value of "format", with which all JSON documents of amble begin.
std::string_view format_of(std::string_view json) {
  constexpr std::string_view key = "\"format\"";
  const std::size_t found = json.find(key);
  if (found == std::string_view::npos) return {};
  const std::size_t quote = json.find('"', found + key.size());
  if (quote == std::string_view::npos) return {};
  return json.substr(quote + 1, json.find('"', quote + 1) - quote - 1);
}

FileKind kind_of_toml(const fs::path& path) {
  const TomlDocument document = TomlDocument::read(path);
  const auto has_any = [&document](std::initializer_list<std::string_view> keys) {
    return std::ranges::any_of(keys, [&document](std::string_view key) { return document.has(key); });
  };
  if (has_any({"conditions", "tests", "claims"})) return FileKind::study;
  if (has_any({"model", "legs", "joint_types"})) return FileKind::side_file;
  if (has_any({"robot", "seed", "generations", "controller", "neat", "search", "trial", "score", "engine"}))
    return FileKind::config;
  return FileKind::other;
}

FileKind kind_of_contents(const fs::path& path, const std::string& beginning) {
  if (beginning.starts_with(recording_start)) return FileKind::recording;
  const std::size_t first = beginning.find_first_not_of(" \t\r\n\xEF\xBB\xBF");
  if (first == std::string::npos) return FileKind::other;
  if (beginning[first] == '{') {
    const std::string_view format = format_of(beginning);
    if (format == "amble-champion") return FileKind::champion;
    return format == "amble-robot" ? FileKind::robot : FileKind::other;
  }
  if (beginning[first] != '<') return kind_of_toml(path);
  const bool is_model =
      beginning.find("<mujoco") != std::string::npos || beginning.find("<robot") != std::string::npos;
  return is_model ? FileKind::model : FileKind::other;
}

}  // namespace

FileKind file_kind(const fs::path& path) {
  std::error_code error;
  const fs::file_status status = fs::status(path, error);
  if (fs::is_directory(status)) return FileKind::folder;
  if (!fs::exists(status)) return FileKind::none;
  // A pipe could be read only once.
  if (!fs::is_regular_file(status)) return FileKind::other;
  FileKind kind = FileKind::none;
  try {
    const std::string beginning = InputFile(path).read(beginning_bytes);
    kind = FileKind::other;
    kind = kind_of_contents(path, beginning);
  } catch (const UserError&) {  // what it says is said again by whoever reads the file
  }
  return kind;
}

void refuse_other_kinds(const fs::path& path, FileKind wanted, std::string_view instead) {
  const FileKind kind = file_kind(path);
  const auto* const found = std::ranges::find(told, kind, &Told::kind);
  if (kind != wanted && found != told.end())
    fail(ExitCode::bad_input, "{}: {}, {}; {} {}{}", path.string(), found->name, instead, found->command,
         shell_word(path.string()), found->more);
}

}  // namespace amble::io
