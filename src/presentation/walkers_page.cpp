#include "amble/presentation/walkers_page.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "amble/core/index.hpp"
#include "amble/experiment/run_folder.hpp"
#include "amble/record/recording.hpp"
#include "amble/robot/json.hpp"

namespace amble::presentation {
namespace {

namespace fs = std::filesystem;

/// Most champions of a history.
constexpr std::size_t most_ages = 8;

/// The run that a champion file is of: the folder that has the champions' folder; else the file itself.
fs::path run_of(const fs::path& champion) {
  const fs::path folder = champion.parent_path();
  return folder.filename() == "champions" ? folder.parent_path() : champion;
}

/// The end of a path: so many of its parts. A folder's path may end in a slash.
std::string last_parts(const fs::path& path, int count) {
  const std::vector<std::string> parts = [&path] {
    std::vector<std::string> all;
    for (const fs::path& part : fs::absolute(path).lexically_normal())
      if (!part.empty()) all.push_back(part.string());
    return all;
  }();
  fs::path end;
  for (std::size_t i = parts.size() - std::min(parts.size(), to_index(count)); i < parts.size(); ++i)
    end /= parts[i];
  return end.string();
}

}  // namespace

std::string_view WalkersPageOptions::not_for_recordings() const {
  if (walk.engine) return "engine";
  if (walk.seconds) return "seconds";
  if (!disturbance.level.empty()) return "level";
  if (disturbance.noise) return "noise";
  if (disturbance.trials > 0) return "trials";
  return disturbance.undisturbed ? "undisturbed" : "";
}

const page::Walker* WalkersPage::add_champion(const experiment::Champion& champion, const fs::path& origin,
                                              const std::optional<fs::path>& run, int jobs,
                                              const std::atomic<bool>& stop) {
  experiment::Champion shown_of = champion;
  WalkOptions how = options_.walk;
  const auto shown = shown_trial(champion, how.seconds, how.engine, options_.disturbance, jobs, stop);
  if (!shown) return nullptr;
  shown_of.problem.noise = shown->noise;
  how.noise = shown->key;
  auto walker = walk(shown_of, origin, how, scratch_.emplace_back("walk.rec").path(), stop);
  if (!walker) return nullptr;
  walker->typical = shown->typical;
  walker->shown = shown->which();
  walker->as_evolved = options_.not_for_recordings().empty();
  if (options_.history) {
    walker->title = fmt::format("gen {}", champion.generation);
    page_.title = champion.experiment + ": its history";
  }
  origins_.push_back(
      {champion.problem.robot.name, run.value_or(run_of(origin)),
       (run ? "" : fmt::format(", generation {}", champion.generation)) + engine_note(shown_of, how)});
  return &page_.walkers.emplace_back(std::move(*walker));
}

void WalkersPage::add_recording(const fs::path& file) {
  add_recording(io::read_file(file), file);
}

void WalkersPage::add_recording(std::string_view bytes, const fs::path& file) {
  record::RecordingReader reader(std::string(bytes), file);
  // All of it, under its own name: the copy's would say little where it is damaged.
  for (std::vector<float> frame; reader.next(frame);) {
  }
  const fs::path& kept = scratch_.emplace_back("walk.rec").path();
  io::write_file(kept, bytes);
  page_.walkers.push_back(recorded(kept));
  page_.walkers.back().title = file.stem().string();
  origins_.push_back({robot::parse_robot(reader.header().robot_json, file.string()).name,
                      fs::path(file).replace_extension(), ""});
}

/// Robot, run and what else was asked for; of the runs' paths as many parts as tell them from each other.
std::vector<std::string> WalkersPage::names() const {
  constexpr int most_parts = 8;
  std::vector<std::string> names;
  for (int parts = 1; parts <= most_parts; ++parts) {
    names.clear();
    for (const auto& [robot, run, rest] : origins_)
      names.push_back(fmt::format("{}, {}{}", robot, last_parts(run, parts), rest));
    if (std::set(names.begin(), names.end()).size() == names.size()) break;
  }
  return names;
}

void WalkersPage::give_titles() {
  if (page_.walkers.size() > 1 && !options_.history) {
    const std::vector<std::string> all = names();
    for (std::size_t i = 0; i < all.size(); ++i) page_.walkers[i].title = all[i];
  }
  if (options_.title)
    page_.title = *options_.title;
  else if (!options_.history)
    page_.title = page_.walkers.size() == 1 ? page_.walkers.front().title
                                            : fmt::format("{} walkers", page_.walkers.size());
}

std::string WalkersPage::html() && {
  give_titles();
  page_.made_by = made_by();
  return page::make_page(page_);
}

std::vector<fs::path> champions_of_history(const fs::path& run) {
  const auto paths = experiment::find_run(run);
  if (!paths.champion_files().empty()) paths.best_champion();  // that it is there
  auto files = paths.champion_files();
  if (files.size() <= most_ages) return files;
  std::vector<fs::path> ages;
  for (std::size_t i = 0; i < most_ages; ++i)
    ages.push_back(files[(i * (files.size() - 1) + (most_ages - 1) / 2) / (most_ages - 1)]);
  return ages;
}

}  // namespace amble::presentation
