#include "amble/experiment/run_paths.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <sstream>
#include <string>
#include <string_view>
#include <system_error>

#include "amble/core/error.hpp"
#include "amble/core/hash.hpp"
#include "amble/core/index.hpp"
#include "amble/experiment/config.hpp"
#include "amble/experiment/plan/manifest.hpp"
#include "amble/io/file.hpp"
#include "amble/io/json_file.hpp"
#include "amble/io/quoting.hpp"
#include "amble/io/text.hpp"
#include "amble/record/generations_csv.hpp"

namespace amble::experiment {
namespace fs = std::filesystem;
namespace {

std::string champion_name(int generation) {
  return fmt::format("{:05}.json", generation);
}

/// Rows of the table of a run; 0 without one.
std::ptrdiff_t generations_done(const fs::path& table) {
  std::error_code none;
  if (!fs::is_regular_file(table, none)) return 0;
  const std::string text = io::read_file(table);
  return std::max<std::ptrdiff_t>(0, std::ranges::count(text, '\n') - 1);
}

/// The generation of the last champion that the table of a run tells of; -1: of none, or it is no such table,
/// such as one that was sorted.
int last_champion(const fs::path& table) {
  try {
    const auto rows = record::read_generations(table);
    for (std::size_t i = 0; i < rows.count(); ++i)
      if (rows.generation[i] != static_cast<double>(i)) return -1;
    for (std::size_t i = rows.count(); i-- > 0;)
      if (record::keeps_champion(rows, i)) return static_cast<int>(i);
  } catch (const UserError&) {
    // Who reads the table says what is wrong with it.
  }
  return -1;
}

/// Of a folder that is no run's.
[[noreturn]] void refuse_folder(const fs::path& folder) {
  if (!fs::is_regular_file(folder / "study.toml"))
    fail(ExitCode::bad_input, "{}: not a run folder (config.toml or robot.json is missing)", folder.string());
  const fs::path runs = folder / "runs";
  fail(ExitCode::bad_input,
       "{}: not a run folder but a study's{}; for its page, run: amble report {} -o report.html",
       folder.string(), fs::is_directory(runs) ? fmt::format(", whose runs are in {}", runs.string()) : "",
       io::shell_word(folder.string()));
}

}  // namespace

std::optional<int> generation_of(const fs::path& file) {
  const std::string stem = file.stem().string();
  int generation = -1;
  std::from_chars(stem.data(), stem.data() + stem.size(), generation);
  if (generation < 0 || file.filename() != champion_name(generation)) return std::nullopt;
  return generation;
}

RunPaths::RunPaths(const fs::path& folder_in)
    : folder(folder_in),
      config(folder / "config.toml"),
      robot(folder / "robot.json"),
      manifest(folder / "manifest.json"),
      generations(folder / "generations.csv"),
      checkpoint(folder / "checkpoint.bin"),
      champions(folder / "champions") {}

fs::path RunPaths::champion(int generation) const {
  return champions / champion_name(generation);
}

std::vector<fs::path> RunPaths::champion_files() const {
  std::vector<fs::path> files;
  std::error_code none;
  for (const auto& entry : fs::directory_iterator(champions, none))
    if (generation_of(entry.path())) files.push_back(entry.path());
  // As numbers: the names have five digits or more.
  std::ranges::sort(files, {}, [](const fs::path& file) { return *generation_of(file); });
  return files;
}

fs::path RunPaths::best_champion() const {
  // In this order: a run that goes on writes champions before the rows that tell of them.
  const int best = last_champion(generations);
  const auto files = champion_files();
  std::error_code none;
  if (files.empty() && (best >= 0 || (fs::exists(checkpoint, none) && generations_done(generations) > 0)))
    fail(ExitCode::bad_input, "{}: generations are done, and {} has no champion: was it emptied?",
         folder.string(), champions.string());
  if (files.empty())
    fail(ExitCode::bad_input, "{}: no champion yet: its first generation is not done", folder.string());
  if (*generation_of(files.back()) < best)
    fail(ExitCode::bad_file,
         "{}: missing, and it is the best of the run so far; put back a copy, or name the file of an earlier "
         "champion, such as {}",
         champion(best).string(), files.back().string());
  return files.back();
}

std::filesystem::path champion_at(const std::filesystem::path& champion_or_run) {
  std::error_code none;  // who reads the path says what is wrong with it
  if (!fs::is_directory(champion_or_run, none)) return champion_or_run;
  return find_run(champion_or_run).best_champion();
}

std::uint64_t run_identity(const RunPaths& paths) {
  const auto manifest =
      io::unseal_json(manifest_format, run_version, io::read_file(paths.manifest), paths.manifest.string());
  const auto processes = manifest.document.value("processes", io::Json::array());
  const auto config = experiment::load_config(paths.config, {});
  return hash_text(fmt::format("{} {} {} {} {}", config.seed, config.name, config.identity(),
                               hash_text(io::read_file(paths.robot)),
                               processes.empty() ? "" : processes.front().dump()));
}

std::uint64_t run_digest(const RunPaths& paths) {
  std::istringstream table(io::read_file(paths.generations));
  std::string line, found;
  std::size_t columns = 0;  // before the times
  while (std::getline(table, line)) {
    std::vector<std::string_view> cells = io::split(line, ',');
    if (columns == 0) columns = to_index(std::ranges::find(cells, record::column::wall_s) - cells.begin());
    cells.resize(std::min(cells.size(), columns));
    found += fmt::format("{}\n", fmt::join(cells, ","));
  }
  for (const fs::path& champion : paths.champion_files()) found += io::read_file(champion);
  return hash_text(found);
}

bool is_run_folder(const fs::path& folder) {
  const RunPaths paths(folder);
  std::error_code none;
  return fs::is_regular_file(paths.config, none) && fs::is_regular_file(paths.robot, none);
}

void refuse_among_champions(const fs::path& file) {
  std::error_code error;
  const fs::path folder = fs::weakly_canonical(fs::absolute(file), error).parent_path();
  if (error) return;  // a pipe, as of /dev/stdout
  if (is_run_folder(folder.parent_path()) && RunPaths(folder.parent_path()).champions == folder)
    fail(ExitCode::bad_input, "{}: a run keeps its own champions there: name another folder", file.string());
}

RunPaths find_run(const fs::path& folder) {
  if (const std::string why = io::why_no_folder(folder); !why.empty())
    fail(ExitCode::io, "{}: {}", folder.string(), why);
  if (!is_run_folder(folder)) refuse_folder(folder);
  RunPaths paths(folder);
  io::unseal_json(manifest_format, run_version, io::read_file(paths.manifest), paths.manifest.string());
  return paths;
}

}  // namespace amble::experiment
