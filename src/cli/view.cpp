#include <fmt/format.h>

#include <deque>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "amble/cli/commands.hpp"
#include "amble/cli/cppn_graph.hpp"
#include "amble/cli/option_checks.hpp"
#include "amble/cli/scratch_file.hpp"
#include "amble/cli/stop_signal.hpp"
#include "amble/experiment/build_info.hpp"
#include "amble/experiment/replay.hpp"
#include "amble/experiment/run_folder.hpp"
#include "amble/figures/cppn_figure.hpp"
#include "amble/gait/recorded_gait.hpp"
#include "amble/gait/report_text.hpp"
#include "amble/io/file.hpp"
#include "amble/study/gait_observer.hpp"
#include "amble/view/page.hpp"

namespace amble::cli {
namespace {

namespace fs = std::filesystem;

struct ViewOptions {
  std::vector<fs::path> inputs;
  fs::path out;
  std::optional<double> seconds;
  std::optional<std::string> engine;
  std::optional<std::string> title;
};

io::Json gait_of(const gait::Report& report) {
  return io::parse_json(gait::report_json(report), "gait");
}

/// Runs a champion again. None if interrupted.
std::optional<view::Walker> walk(const fs::path& path, const ViewOptions& options,
                                 const ScratchFile& recording) {
  const auto champion = experiment::load_champion(path);
  study::GaitObserver gait(champion.problem.robot, champion.problem.trial.timestep_s, {});
  const auto replay = experiment::replay(champion.problem, champion.genome,
                                         {.seconds = options.seconds,
                                          .engine = options.engine,
                                          .record = recording.path(),
                                          .origin = path.string(),
                                          .observer = &gait,
                                          .trace = false},
                                         stop_signal());
  if (!replay) return std::nullopt;
  const auto& home = champion.problem.engine;
  const auto& judge = options.engine.value_or(home);
  return view::Walker{.title = fmt::format("{}, generation {}", champion.experiment, champion.generation) +
                               (judge == home ? "" : fmt::format(", in the engine {}", judge)),
                      .recording = recording.path(),
                      .cppn_svg = figures::cppn_figure(cppn_graph(champion)),
                      .gait = gait_of(gait.finish(replay->result.outcome))};
}

view::Walker recorded(const fs::path& path) {
  return {.title = path.stem().string(),
          .recording = path,
          .cppn_svg = {},
          .gait = gait_of(gait::recorded_gait(path, {}))};
}

ExitCode make_view(const ViewOptions& options) {
  io::refuse_to_replace(options.out, "<!DOCTYPE html>", "a page");
  std::deque<ScratchFile> scratch;
  view::ReplayPage page;
  for (const fs::path& input : options.inputs) {
    const bool is_run = fs::is_directory(input);
    if (!is_run && input.extension() != ".json") {
      if (options.engine || options.seconds)
        fail(ExitCode::bad_input, "{}: {} has been made already", options.engine ? "--engine" : "--seconds",
             input.string());
      page.walkers.push_back(recorded(input));
      continue;
    }
    const fs::path champion = is_run ? experiment::find_run(input).best_champion() : input;
    auto walker = walk(champion, options, scratch.emplace_back("walk.rec"));
    if (!walker) fail(ExitCode::interrupted, "stopped before all champions had walked");
    page.walkers.push_back(std::move(*walker));
  }
  page.title = options.title.value_or(
      page.walkers.size() == 1 ? page.walkers.front().title : fmt::format("{} walkers", page.walkers.size()));
  const auto build = experiment::build_info();
  page.made_by = fmt::format("amble {} ({})", build.version, experiment::short_commit(build));
  const std::string html = view::make_page(page);
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
  command->add_option("-o,--out", options->out, "The page to write (HTML)")->required();
  command
      ->add_option("--seconds", options->seconds,
                   "How long champions walk, s (default: as in their evolution)")
      ->check(seconds_check());
  command->add_option("--engine", options->engine,
                      "Physics engine in which champions walk (default: as in their evolution)");
  command->add_option("--title", options->title, "Title of the page");
  command->callback([options, &action] { action = [options] { return make_view(*options); }; });
}

}  // namespace amble::cli
