#include <fmt/format.h>

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "amble/cli/help.hpp"
#include "amble/cli/live_view.hpp"
#include "amble/cli/options.hpp"
#include "amble/cli/outputs.hpp"
#include "amble/cli/static_view.hpp"
#include "amble/cli/stop_signal.hpp"
#include "amble/experiment/champion.hpp"
#include "amble/io/file.hpp"
#include "amble/io/file_kind.hpp"
#include "amble/presentation/walkers_page.hpp"

namespace amble::cli {
namespace {

namespace fs = std::filesystem;

struct ViewOptions {
  std::vector<fs::path> inputs;
  fs::path out;
  presentation::WalkersPageOptions of_all;
  bool with_figures = false, live = false;
  LiveOptions live_options;
  std::optional<fs::path> figures;
};

void add_recording(presentation::WalkersPage& page, const fs::path& input, const ViewOptions& options) {
  if (const auto key = options.of_all.not_for_recordings(); !key.empty()) {
    const io::InputFile there(input);  // a missing file is the first thing to tell
    fail(ExitCode::bad_input, "--{}: {} has been made already", key, input.string());
  }
  page.add_recording(input);
}

void add_champion(presentation::WalkersPage& page, const fs::path& input,
                  const std::optional<double>& seconds) {
  const fs::path path = experiment::champion_at(input);
  const auto run = fs::is_directory(input) ? std::optional(input) : std::nullopt;
  const auto champion = experiment::load_champion(path);
  check_seconds(seconds, champion.problem.trial);
  const auto* walker = page.add_champion(champion, path, run, processors(), stop_signal());
  if (walker == nullptr) fail(ExitCode::interrupted, "stopped before all champions had walked");
  if (!walker->typical.empty())
    fmt::print("{}: {}; {} is shown\n", input.string(), walker->typical, walker->shown);
}

/// `amble view DIR --static`. What only walkers have is refused.
ExitCode make_static(const ViewOptions& options) {
  const std::pair<const char*, bool> others[] = {{"--history", options.of_all.history},
                                                 {"--seconds", options.of_all.walk.seconds.has_value()},
                                                 {"--title", options.of_all.title.has_value()}};
  for (const auto& [name, given] : others)
    if (given) fail(ExitCode::bad_input, "{}: not with --static, whose page shows one run as it is", name);
  if (options.inputs.size() > 1)
    fail(ExitCode::bad_input, "--static: expected one run folder, not {} inputs", options.inputs.size());
  return make_static_view({.run = options.inputs.front(),
                           .out = options.out,
                           .figures = options.figures,
                           .engine = options.of_all.walk.engine,
                           .disturbance = options.of_all.disturbance});
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
  check_output(options.out, "<!DOCTYPE html>", "a page");
  if (options.of_all.history && options.inputs.size() > 1)
    fail(ExitCode::bad_input, "--history: expected one run folder, not {} inputs", options.inputs.size());
  presentation::WalkersPage page(options.of_all);
  const auto inputs =
      options.of_all.history ? presentation::champions_of_history(options.inputs.front()) : options.inputs;
  for (const fs::path& input : inputs)
    if (io::file_kind(input) == io::FileKind::recording)
      add_recording(page, input, options);
    else
      add_champion(page, input, options.of_all.walk.seconds);
  const std::string html = std::move(page).html();
  io::write_output(options.out, html);
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
      ->add_option("--seconds", options->of_all.walk.seconds,
                   "How long champions walk, s (default: as in their evolution)")
      ->check(seconds_check());
  add_engine(*command, options->of_all.walk.engine,
             "Physics engine in which champions walk (default: as in their evolution)");
  add_disturbance(*command, options->of_all.disturbance);
  command->add_flag("--history", options->of_all.history,
                    "Of one run folder up to eight champions, from the first to the last, side by side");
  command->add_flag(
      "--static", options->with_figures,
      "Of one run folder a page with figures in place of walkers: fitness curve, footfalls, path");
  command->add_option("--figures", options->figures,
                      "With --static: also write each figure as an SVG file into this folder");
  command->add_option("--title", options->of_all.title, "Title of the page")->type_name("WORDS");
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
