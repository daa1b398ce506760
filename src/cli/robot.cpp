#include <fmt/format.h>

#include <filesystem>
#include <memory>
#include <optional>
#include <system_error>
#include <vector>

#include "amble/cli/data_folder.hpp"
#include "amble/cli/help.hpp"
#include "amble/cli/outputs.hpp"
#include "amble/cli/stop_signal.hpp"
#include "amble/core/error.hpp"
#include "amble/experiment/problem.hpp"
#include "amble/experiment/robot_folder.hpp"
#include "amble/figures/robot_figure.hpp"
#include "amble/figures/style_sheet.hpp"
#include "amble/io/file.hpp"
#include "amble/io/file_kind.hpp"
#include "amble/morphology/mjcf_writer.hpp"
#include "amble/morphology/reading_notes.hpp"
#include "amble/morphology/side_file.hpp"
#include "amble/robot/doubts.hpp"
#include "amble/robot/summary.hpp"

namespace amble::cli {
namespace {

namespace fs = std::filesystem;

/// Before anything is computed: the model of a robot is not written over the one that it is read from.
void check_model_output(const fs::path& robot_file, const fs::path& mjcf) {
  check_output(mjcf, morphology::written_mjcf_start, "an MJCF model");
  if (io::file_kind(robot_file) == io::FileKind::side_file &&
      resolved(mjcf) == resolved(morphology::read_side_file(robot_file).model))
    fail(ExitCode::bad_input, "--mjcf {}: {} is made from it; expected another file", mjcf.string(),
         robot_file.string());
}

ExitCode init_robot(const fs::path& model, const fs::path& folder) {
  const auto written = experiment::write_robot_folder(model, folder, preset_of_robots(), stop_signal());
  if (!written) fail(ExitCode::interrupted, "stopped before all of it was written");
  fmt::print("{}", written->text);
  return written->ready ? ExitCode::ok : ExitCode::bad_input;
}

}  // namespace

void add_robot(CLI::App& app, Action& action) {
  auto* command =
      app.add_subcommand("robot", "Show what was read from a robot file, or make one from a model");
  struct Options {
    fs::path file, mjcf, drawing, model, folder;
  };
  auto options = std::make_shared<Options>();
  auto* file = command->add_option("FILE", options->file,
                                   "Robot file (TOML beside an MJCF model, or a run's robot.json)");
  auto* mjcf = command->add_option("--mjcf", options->mjcf, "Write it as an MJCF model");
  auto* draw =
      command->add_option("--draw", options->drawing, "Draw it in its start pose, from three sides (.svg)");
  auto* init = command->add_option("--init", options->model,
                                   "Guess a robot file and a config from this model, MJCF (.xml) or .urdf");
  command->add_option("-o,--out", options->folder, "Folder for both (default: one of the model's name)")
      ->needs(init);
  init->excludes(file)->excludes(mjcf)->excludes(draw);
  add_examples(*command, {{"amble robot --init my_robot.xml -o my_robot",
                           "then: amble evolve my_robot/evolve.toml --out runs/1"},
                          {"amble robot robots/hexapod/hexapod.toml --draw hexapod.svg", ""}});
  command->callback([options, &action] {
    if (options->file.empty() && options->model.empty()) throw CLI::RequiredError("FILE or --init MODEL");
    action = [options] {
      if (!options->model.empty()) return init_robot(options->model, options->folder);
      if (!options->mjcf.empty()) check_model_output(options->file, options->mjcf);
      if (!options->drawing.empty()) check_drawing("--draw", options->drawing);
      check_distinct({{"--mjcf", options->mjcf}, {"--draw", options->drawing}});
      morphology::ReadingNotes notes;
      const auto robot = experiment::load_robot_file(options->file, &notes);
      if (!options->mjcf.empty())
        io::write_output(options->mjcf, morphology::written_mjcf_start + morphology::write_mjcf(robot).text);
      if (!options->drawing.empty())
        io::write_output(options->drawing, figures::standalone_svg(figures::robot_figure(robot)));
      fmt::print("{}", robot::summary(robot));
      if (const auto line = experiment::solver_line(robot)) fmt::print("{}", *line);
      if (!notes.lines().empty()) fmt::print("\nimport notes:\n{}", notes.text());
      fmt::print("{}", experiment::doubts_text(robot::doubts(robot)));
      if (const std::string text = experiment::start_text(robot); !text.empty()) fmt::print("\n{}", text);
      return ExitCode::ok;
    };
  });
}

}  // namespace amble::cli
