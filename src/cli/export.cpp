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
#include "amble/exporting/c_source.hpp"
#include "amble/exporting/c_text.hpp"
#include "amble/exporting/json_source.hpp"
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
};

/// Ticks of the champion's own trial that become test vectors.
constexpr int test_ticks = 100;

/// When the first step is.
std::string start_sentence(const experiment::Problem& problem) {
  const bool later = problem.trial.first_command == trial::FirstCommand::after_first_step;
  return later
             ? "The robot starts in its start pose; its motors hold the joints where they are for one tick, "
               "then the first step."
             : "The first step is in the robot's start pose.";
}

fs::path header_of(const fs::path& source) {
  return fs::path(source).replace_extension(".h");
}

void check_c_options(const ExportOptions& options) {
  if (!options.out || options.out->extension() != ".c")
    fail(ExitCode::bad_input, "--format c: expected -o FILE.c, beside which FILE.h is written");
  const std::string stem = options.out->stem().string();
  if (exporting::c_identifier(stem) != stem)
    fail(ExitCode::bad_input,
         "--out {}: the file's name is the prefix of all names in it: expected a letter, "
         "then letters, digits and underscores",
         options.out->string());
  for (const fs::path& path : {*options.out, header_of(*options.out)})
    io::refuse_to_replace(path, "/* Controller exported by amble", "an exported controller");
}

void write_c(const experiment::Champion& champion, const ExportOptions& options) {
  check_c_options(options);
  const auto tables = exporting::controller_tables(champion.problem, champion.genome);
  const auto trace = exporting::record_trace(champion.problem, champion.genome, test_ticks, stop_signal());
  const auto c = exporting::c_source(
      tables, champion.problem.robot, exporting::provenance_of(champion), trace,
      {.prefix = options.out->stem().string(),
       .arithmetic = options.fixed ? exporting::Arithmetic::fixed : exporting::Arithmetic::float32,
       .start = start_sentence(champion.problem)});
  io::write_file(header_of(*options.out), c.header);
  io::write_file(*options.out, c.source);
}

std::string json_of(const experiment::Champion& champion) {
  const auto tables = exporting::controller_tables(champion.problem, champion.genome);
  const auto trace = exporting::record_trace(champion.problem, champion.genome, test_ticks, stop_signal());
  return exporting::json_source(champion, tables, exporting::provenance_of(champion), trace);
}

std::string mjcf_of(const experiment::Champion& champion) {
  return morphology::simulation_mjcf(champion.problem.robot, champion.problem.trial.timestep_s);
}

ExitCode run_export(const ExportOptions& options) {
  if (options.fixed && options.format != "c") fail(ExitCode::bad_input, "--fixed: only with --format c");
  const fs::path path = fs::is_directory(options.champion)
                            ? experiment::find_run(options.champion).best_champion()
                            : options.champion;
  const auto champion = experiment::load_champion(path);
  if (options.format == "c") {
    write_c(champion, options);
    return ExitCode::ok;
  }
  const bool json = options.format == "json";
  if (options.out)
    io::refuse_to_replace(*options.out, json ? "{\n  \"format\": \"amble-export\"" : "<mujoco",
                          json ? "a JSON document" : "an MJCF model");
  const std::string text = json ? json_of(champion) : mjcf_of(champion);
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
  add_examples(*command, {{"amble export runs/1 --format c -o walker.c", "for a microcontroller"},
                          {"amble export runs/1 --format mjcf -o robot.xml", ""}});
  command->callback([options, &action] { action = [options] { return run_export(*options); }; });
}

}  // namespace amble::cli
