#include <fmt/format.h>

#include <array>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include "amble/cli/help.hpp"
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

std::string mjcf_of(const experiment::Champion& champion) {
  return morphology::simulation_mjcf(champion.problem.robot, champion.problem.trial.timestep_s);
}

/// As `amble trial --steering`. A walker that was told nothing is told straight on, both turns and a stop in
/// the ticks of the self-test.
void steer_by_hand(experiment::Champion& champion, const std::string& gains) {
  if (champion.problem.command.kind == trial::CommandKind::none)
    champion.problem.set_commands(
        {.kind = trial::CommandKind::fixed, .stretches = {{0.3, 0.0}, {0.3, 0.3}, {0.2, -0.3}, {}}});
  champion.problem.set_differential(experiment::parse_differential(gains, "--steering"));
}

ExitCode run_export(const ExportOptions& options) {
  if (options.fixed && options.format != "c") fail(ExitCode::bad_input, "--fixed: only with --format c");
  const fs::path path = fs::is_directory(options.champion)
                            ? experiment::find_run(options.champion).best_champion()
                            : options.champion;
  auto champion = experiment::load_champion(path);
  if (options.steering) steer_by_hand(champion, *options.steering);
  if (options.format == "c") {
    if (!options.out || options.out->extension() != ".c")
      fail(ExitCode::bad_input, "--format c: expected -o FILE.c, beside which FILE.h is written");
    io::make_folder(options.out->parent_path());
    exporting::write_c(champion, *options.out,
                       options.fixed ? exporting::Arithmetic::fixed : exporting::Arithmetic::float32,
                       stop_signal());
    return ExitCode::ok;
  }
  const bool json = options.format == "json";
  if (options.out)
    io::refuse_to_replace(*options.out, json ? exporting::export_json_start : "<mujoco",
                          json ? "a JSON document" : "an MJCF model");
  if (options.out) io::make_folder(options.out->parent_path());
  const std::string text = json ? exporting::export_json(champion, stop_signal()) : mjcf_of(champion);
  if (options.out)
    io::write_file(*options.out, text);
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
  command->add_option("--steering", options->steering,
                      "GAINS: steered by hand, as by `amble trial --steering`, e.g. \"turn_gain = 4, "
                      "full_speed_m_s = 0.28\"");
  add_examples(*command, {{"amble export runs/1 --format c -o walker.c", "for a microcontroller"},
                          {"amble export runs/1 --format mjcf -o robot.xml", ""}});
  command->callback([options, &action] { action = [options] { return run_export(*options); }; });
}

}  // namespace amble::cli
