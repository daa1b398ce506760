#include <fmt/format.h>

#include <array>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include "amble/cli/help.hpp"
#include "amble/cli/messages.hpp"
#include "amble/cli/outputs.hpp"
#include "amble/cli/stop_signal.hpp"
#include "amble/experiment/run_folder.hpp"
#include "amble/exporting/export_file.hpp"
#include "amble/io/file.hpp"
#include "amble/morphology/mjcf_writer.hpp"

namespace amble::cli {
namespace {

namespace fs = std::filesystem;

struct ExportOptions {
  fs::path champion;
  std::string format;
  std::optional<fs::path> out;
  bool fixed = false;
  std::optional<std::string> steering;
};

/// Throws UserError: an option that the format knows nothing of.
void check_options(const ExportOptions& options) {
  if (options.fixed && options.format != "c") fail(ExitCode::bad_input, "--fixed: only with --format c");
  if (options.steering && options.format == "mjcf")
    fail(ExitCode::bad_input, "--steering: only with --format c or json; mjcf is the robot alone");
}

std::string mjcf_of(const experiment::Champion& champion) {
  if (champion.problem.ground.has_field())
    print_message("amble: the model's ground is a plane: ground.kind = \"" + champion.problem.ground.kind +
                  "\" is left out\n");
  return morphology::written_mjcf_start +
         morphology::simulation_mjcf(champion.problem.robot, champion.problem.trial.timestep_s);
}

ExitCode run_export(const ExportOptions& options) {
  check_options(options);
  const fs::path path = experiment::champion_at(options.champion);
  auto champion = experiment::load_champion(path);
  if (options.out) prepare_output(*options.out);
  if (options.steering) exporting::steer_by_hand(champion, *options.steering, "--steering");
  if (options.format == "c") {
    if (!options.out || options.out->extension() != ".c")
      fail(ExitCode::bad_input, "--format c: expected -o FILE.c, beside which FILE.h is written");
    exporting::write_c(champion, *options.out,
                       options.fixed ? exporting::Arithmetic::fixed : exporting::Arithmetic::float32,
                       stop_signal());
    return ExitCode::ok;
  }
  const bool json = options.format == "json";
  if (options.out)
    io::check_output(*options.out, json ? exporting::export_json_start : morphology::written_mjcf_start,
                     json ? "a JSON document" : "an MJCF model");
  const std::string text = json ? exporting::export_json(champion, stop_signal()) : mjcf_of(champion);
  if (stop_signal()) return ExitCode::interrupted;
  if (options.out)
    io::write_output(*options.out, text);
  else
    fmt::print("{}", text);
  return ExitCode::ok;
}

}  // namespace

void add_export(CLI::App& app, Action& action) {
  auto* command = app.add_subcommand(
      "export", "Write a champion's controller as C source or JSON, or its robot as an MJCF model");
  auto options = std::make_shared<ExportOptions>();
  command->add_option("CHAMPION", options->champion, "Champion file, or run folder (its best champion)")
      ->required();
  command
      ->add_option(
          "--format", options->format,
          "c: a header and a source for a microcontroller; json: everything; mjcf: the robot as it is "
          "simulated, for MuJoCo")
      ->required()
      ->check(CLI::IsMember({"c", "json", "mjcf"}));
  command->add_option(
      "-o,--out", options->out,
      "This file (c: FILE.c, beside it FILE.h; its name is the prefix of all names). Without: "
      "json and mjcf to the standard output");
  command->add_flag("--fixed", options->fixed, "c: SUPGs in fixed point, without any floating point");
  command
      ->add_option("--steering", options->steering,
                   "c and json: steered by hand, as by `amble trial --steering`, e.g. \"turn_gain = 4, "
                   "full_speed_m_s = 0.28\" (docs/STEERING.md)")
      ->type_name("GAINS");
  add_examples(*command, {{"amble export runs/1 --format c -o walker.c", "for a microcontroller"},
                          {"amble export runs/1 --format mjcf -o simulated.xml", ""}});
  command->callback([options, &action] { action = [options] { return run_export(*options); }; });
}

}  // namespace amble::cli
