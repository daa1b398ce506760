#include <fmt/format.h>

#include <algorithm>
#include <deque>
#include <filesystem>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "amble/cli/help.hpp"
#include "amble/cli/live_view.hpp"
#include "amble/cli/options.hpp"
#include "amble/cli/static_view.hpp"
#include "amble/cli/stop_signal.hpp"
#include "amble/core/index.hpp"
#include "amble/experiment/run_folder.hpp"
#include "amble/io/file.hpp"
#include "amble/page/replay_page.hpp"
#include "amble/presentation/walker.hpp"
#include "amble/record/recording.hpp"
#include "amble/robot/json.hpp"

namespace amble::cli {
namespace {

namespace fs = std::filesystem;

struct ViewOptions {
  std::vector<fs::path> inputs;
  fs::path out;
  presentation::WalkOptions walk;
  std::optional<std::string> title;
  bool history = false, with_figures = false, live = false;
  LiveOptions live_options;
  std::optional<fs::path> figures;
  presentation::TrialChoice disturbance;
};

/// Most champions of a history.
constexpr std::size_t most_ages = 8;

/// Champions of a run from first to last: all if there are few, else evenly among them.
std::vector<fs::path> ages_of(const fs::path& run) {
  auto files = experiment::find_run(run).champion_files();
  if (files.size() <= most_ages) return files;
  std::vector<fs::path> ages;
  for (std::size_t i = 0; i < most_ages; ++i)
    ages.push_back(files[(i * (files.size() - 1) + (most_ages - 1) / 2) / (most_ages - 1)]);
  return ages;
}

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

/// What a walker beside others is called by.
struct Origin {
  std::string robot;
  fs::path run;
  std::string rest;  ///< generation and engine, where the input or the options name them
};

/// Robot, run and what else was asked for; of the runs' paths as many parts as tell them from each other.
std::vector<std::string> names_of(const std::vector<Origin>& origins) {
  constexpr int most_parts = 8;
  std::vector<std::string> names;
  for (int parts = 1; parts <= most_parts; ++parts) {
    names.clear();
    for (const auto& [robot, run, rest] : origins)
      names.push_back(fmt::format("{}, {}{}", robot, last_parts(run, parts), rest));
    if (std::set(names.begin(), names.end()).size() == names.size()) break;
  }
  return names;
}

/// The page as it grows.
struct Walkers {
  std::deque<io::ScratchFile> scratch;
  std::vector<Origin> origins;
  page::ReplayPage page;
};

void add_recording(Walkers& walkers, const fs::path& input, const ViewOptions& options) {
  if (options.walk.engine || options.walk.seconds)
    fail(ExitCode::bad_input, "{}: {} has been made already", options.walk.engine ? "--engine" : "--seconds",
         input.string());
  walkers.page.walkers.push_back(presentation::recorded(input));
  const record::RecordingReader reader(input);
  walkers.origins.push_back({robot::parse_robot(reader.header().robot_json, input.string()).name,
                             fs::path(input).replace_extension(), ""});
}

void add_champion(Walkers& walkers, const fs::path& input, const ViewOptions& options) {
  const fs::path path = experiment::champion_at(input);
  auto champion = experiment::load_champion(path);
  presentation::WalkOptions how = options.walk;
  const auto shown = shown_trial(champion, how.seconds, how.engine, options.disturbance);
  champion.problem.noise = shown.noise;
  how.noise = shown.key;
  if (!shown.typical.empty())
    fmt::print("{}: {}; {} is shown\n", input.string(), shown.typical, shown.which());
  const fs::path& recording = walkers.scratch.emplace_back("walk.rec").path();
  auto walker = presentation::walk(champion, path, how, recording, stop_signal());
  if (!walker) fail(ExitCode::interrupted, "stopped before all champions had walked");
  walker->typical = shown.typical;
  walker->shown = shown.which();
  if (options.history) {
    walker->title = fmt::format("gen {}", champion.generation);
    walkers.page.title = champion.experiment + ": its history";
  }
  walkers.page.walkers.push_back(std::move(*walker));
  const bool is_run = fs::is_directory(input);
  walkers.origins.push_back({champion.problem.robot.name, is_run ? input : run_of(path),
                             (is_run ? "" : fmt::format(", generation {}", champion.generation)) +
                                 presentation::engine_note(champion, how)});
}

void give_titles(Walkers& walkers, const ViewOptions& options) {
  page::ReplayPage& page = walkers.page;
  if (page.walkers.size() > 1 && !options.history) {
    const std::vector<std::string> names = names_of(walkers.origins);
    for (std::size_t i = 0; i < names.size(); ++i) page.walkers[i].title = names[i];
  }
  if (options.title)
    page.title = *options.title;
  else if (!options.history)
    page.title = page.walkers.size() == 1 ? page.walkers.front().title
                                          : fmt::format("{} walkers", page.walkers.size());
}

/// `amble view DIR --static`. What only walkers have is refused.
ExitCode make_static(const ViewOptions& options) {
  const std::pair<const char*, bool> others[] = {{"--history", options.history},
                                                 {"--seconds", options.walk.seconds.has_value()},
                                                 {"--title", options.title.has_value()}};
  for (const auto& [name, given] : others)
    if (given) fail(ExitCode::bad_input, "{}: not with --static, whose page shows one run as it is", name);
  if (options.inputs.size() > 1)
    fail(ExitCode::bad_input, "--static: expected one run folder, not {} inputs", options.inputs.size());
  return make_static_view({.run = options.inputs.front(),
                           .out = options.out,
                           .figures = options.figures,
                           .engine = options.walk.engine,
                           .disturbance = options.disturbance});
}

/// `amble view --live DIR`.
ExitCode make_live(const ViewOptions& options) {
  if (options.inputs.size() > 1)
    fail(ExitCode::bad_input,
         "--live: expected one folder, of a run or of runs such as a study's, not {} inputs",
         options.inputs.size());
  return make_live_view(options.inputs.front(), options.live_options);
}

ExitCode make_view(const ViewOptions& options) {
  if (options.live) return make_live(options);
  if (options.with_figures) return make_static(options);
  if (options.figures) fail(ExitCode::bad_input, "--figures: only with --static");
  stop_signal();  // from here on what is in the folder for temporary files is removed
  io::refuse_to_replace(options.out, "<!DOCTYPE html>", "a page");
  if (options.history && options.inputs.size() > 1)
    fail(ExitCode::bad_input, "--history: expected one run folder, not {} inputs", options.inputs.size());
  Walkers walkers;
  for (const fs::path& input : options.history ? ages_of(options.inputs.front()) : options.inputs)
    if (fs::is_directory(input) || input.extension() == ".json")
      add_champion(walkers, input, options);
    else
      add_recording(walkers, input, options);
  give_titles(walkers, options);
  walkers.page.made_by = presentation::made_by();
  const std::string html = page::make_page(walkers.page);
  if (options.out.has_parent_path()) fs::create_directories(options.out.parent_path());
  io::write_file(options.out, html);
  fmt::print("{}\n", fs::absolute(options.out).lexically_normal().string());
  return ExitCode::ok;
}

}  // namespace

void add_view(CLI::App& app, Action& action) {
  auto* command = app.add_subcommand("view", "Make a page in which champions walk, in 3-D and with diagrams");
  auto options = std::make_shared<ViewOptions>();
  command
      ->add_option(
          "INPUT", options->inputs,
          "Champions (JSON), run folders (their best champions) and recordings; several walk together")
      ->required();
  auto* out =
      command->add_option("-o,--out", options->out, "The page to write (HTML; required without --live)");
  command
      ->add_option("--seconds", options->walk.seconds,
                   "How long champions walk, s (default: as in their evolution)")
      ->check(seconds_check());
  add_engine(*command, options->walk.engine,
             "Physics engine in which champions walk (default: as in their evolution)");
  add_disturbance(*command, options->disturbance);
  command->add_flag("--history", options->history,
                    "Of one run folder up to eight champions, from the first to the last, side by side");
  command->add_flag(
      "--static", options->with_figures,
      "Of one run folder a page with figures in place of walkers: fitness curve, footfalls, path");
  command->add_option("--figures", options->figures,
                      "With --static: also write each figure as an SVG file into this folder");
  command->add_option("--title", options->title, "Title of the page")->type_name("WORDS");
  auto* live =
      command->add_flag("--live", options->live,
                        "Serve a page of a run that goes on, or of all runs in a folder, until Ctrl-C");
  for (auto* other : command->get_options())
    if (!other->get_positional() && other != live && other != command->get_help_ptr()) live->excludes(other);
  add_live(*command, options->live_options, live);
  add_examples(*command,
               {{"amble view runs/1 -o walker.html", ""},
                {"amble view runs/1 --history -o history.html", "from its first champion to its last"},
                {"amble view runs/1 runs/2 -o both.html --seconds 60", "side by side"},
                {"amble view runs/1 --static -o figures.html", "fitness curve and figures"},
                {"amble view results/paper --live", "a page of all runs of a study, while they go on"}});
  command->callback([options, out, &action] {
    if (!options->live && out->empty()) throw CLI::RequiredError(out->get_name());
    action = [options] { return make_view(*options); };
  });
}

}  // namespace amble::cli
