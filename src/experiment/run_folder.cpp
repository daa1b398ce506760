#include "amble/experiment/run_folder.hpp"

#include <fmt/chrono.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <regex>
#include <system_error>

#include "amble/core/error.hpp"
#include "amble/experiment/build_info.hpp"
#include "amble/experiment/plan/manifest.hpp"
#include "amble/io/file.hpp"
#include "amble/io/json_file.hpp"
#include "amble/io/quoting.hpp"
#include "amble/io/toml_settings.hpp"

namespace amble::experiment {
namespace fs = std::filesystem;
namespace {

constexpr std::string_view lock_name = ".lock";

/// Left by a process that was killed while it wrote one of a run's own files.
bool is_temporary(const fs::path& file) {
  const auto written = io::destination_of(file);
  if (!written) return false;
  const RunPaths paths(file.parent_path());
  return written == paths.config || written == paths.robot || written == paths.manifest ||
         written == paths.checkpoint || generation_of(*written);
}

/// Where a search keeps what only grows (search::Strategy::logs).
bool is_log(const fs::path& file) {
  return file.filename().string().starts_with("archive") && file.extension() == ".bin";
}

void remove_temporaries(const fs::path& folder) {
  std::vector<fs::path> left;
  for (const auto& entry : fs::directory_iterator(folder))
    if (is_temporary(entry.path())) left.push_back(entry.path());
  for (const auto& file : left) fs::remove(file);
}

/// Whether a run may begin here: nothing is there, or only what a start leaves that was killed before it
/// wrote its config; the lock comes first and stays.
bool holds_nothing(const fs::path& folder) {
  if (!fs::exists(folder / lock_name)) return fs::is_empty(folder);
  const RunPaths paths(folder);
  const std::array beginnings{folder / lock_name, paths.robot, paths.generations, paths.checkpoint,
                              paths.manifest};
  return std::ranges::all_of(fs::directory_iterator(folder), [&](const auto& entry) {
    const fs::path& path = entry.path();
    if (path == paths.champions) return fs::is_directory(path) && fs::is_empty(path);
    return is_temporary(path) || is_log(path) || std::ranges::find(beginnings, path) != beginnings.end();
  });
}

void make_folder(const fs::path& folder) {
  std::vector<fs::path> missing;
  for (fs::path at = folder; !at.empty() && !fs::exists(at); at = at.parent_path()) missing.push_back(at);
  io::make_folder(folder);
  if (!fs::is_directory(folder)) fail(ExitCode::io, "{} is not a folder", folder.string());
  for (const auto& made : missing) io::sync_entry(made);
}

/// Before anything is made or locked: a folder that is in use stays as it is.
void refuse_used_folder(const fs::path& folder) {
  if (folder.empty()) fail(ExitCode::bad_input, "--out: expected the name of a folder");
  if (!fs::exists(folder)) return;
  if (!fs::is_directory(folder))
    fail(ExitCode::bad_input, "--out {}: a file of that name exists", folder.string());
  if (is_run_folder(folder))
    fail(ExitCode::bad_input,
         "--out {}: holds a run already; continue it with `amble resume {}`, or name another folder",
         folder.string(), io::shell_word(folder.string()));
  if (!holds_nothing(folder))
    fail(ExitCode::bad_input, "--out {}: not empty and not a run; name another folder", folder.string());
}

/// A config's text with another number of generations, and whatever comments somebody wrote into it.
std::string with_generations(const std::string& text, int generations) {
  static const std::regex line(R"((^|\n)(generations[ \t]*=[ \t]*)[0-9_]+)");
  std::smatch found;
  if (!std::regex_search(text, found, line)) return text;
  return fmt::format("{}{}{}{}{}", found.prefix().str(), found[1].str(), found[2].str(), generations,
                     found.suffix().str());
}

io::Json process_json(const ProcessNote& note) {
  return {{"started_utc", note.started_utc},
          {"amble", note.version},
          {"commit", note.commit},
          {"compiler", note.compiler},
          {"flags", note.flags},
          {"cpu", note.cpu},
          {"jobs", note.jobs},
          {"from_generation", note.from_generation}};
}

}  // namespace

RunFolder::RunFolder(const fs::path& folder)
    : paths_(fs::absolute(folder)), lock_(std::make_unique<io::FolderLock>(folder)) {}

RunFolder RunFolder::create(const fs::path& folder, const robot::RobotSpec& robot) {
  refuse_used_folder(folder);
  make_folder(folder);
  RunFolder run(folder);
  refuse_used_folder(folder);  // again, now that it is locked
  remove_temporaries(folder);
  make_folder(run.paths_.champions);
  fs::remove(run.paths_.manifest);
  std::vector<fs::path> logs;
  for (const auto& entry : fs::directory_iterator(folder))
    if (is_log(entry.path())) logs.push_back(entry.path());
  for (const auto& log : logs) fs::remove(log);
  io::write_file(run.paths_.robot, robot_file_text(robot));
  return run;
}

RunFolder RunFolder::open(const fs::path& folder) {
  find_run(folder);
  RunFolder run(folder);
  make_folder(run.paths_.champions);
  return run;
}

void RunFolder::remove_leftovers() const {
  remove_temporaries(paths_.folder);
  remove_temporaries(paths_.champions);
}

Config RunFolder::load_config() const {
  return experiment::load_config(paths_.config, {});
}

void RunFolder::save_config(const Config& config) const {
  Config saved = config;
  saved.robot = paths_.robot.filename().string();
  io::write_file(paths_.config, saved.to_toml());
}

void RunFolder::lengthen(const Config& config) const {
  const std::string text = io::read_file(paths_.config);
  const std::string same_but_longer = with_generations(text, config.generations);
  const auto document = io::TomlDocument::parse(same_but_longer, paths_.config.string());
  const auto read = config_from(document, {});
  if (read.generations != config.generations || read.identity() != config.identity())
    return save_config(config);
  io::write_file(paths_.config, same_but_longer);
}

robot::RobotSpec RunFolder::load_robot() const {
  return load_robot_file(paths_.robot);
}

void RunFolder::save_champion(const Champion& champion) const {
  io::write_file(paths_.champion(champion.generation), champion_text(champion));
}

void RunFolder::note_process(const Config& config, int jobs, int from_generation) const {
  io::Json processes = io::Json::array();
  if (fs::exists(paths_.manifest)) {
    const auto old = io::unseal_json(manifest_format, run_version, io::read_file(paths_.manifest),
                                     paths_.manifest.string());
    processes = old.document.value("processes", io::Json::array());
  }
  const auto build = build_info();
  const auto now = std::chrono::floor<std::chrono::seconds>(std::chrono::system_clock::now());
  processes.push_back(process_json({.started_utc = fmt::format("{:%Y-%m-%dT%H:%M:%SZ}", fmt::gmtime(now)),
                                    .version = build.version,
                                    .commit = build.commit,
                                    .compiler = build.compiler,
                                    .flags = build.flags,
                                    .cpu = cpu_name(),
                                    .jobs = jobs,
                                    .from_generation = from_generation}));
  io::write_file(paths_.manifest, manifest_text(config, processes));
}

}  // namespace amble::experiment
