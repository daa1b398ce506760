#include "amble/exporting/export_file.hpp"

#include <string>
#include <string_view>

#include "amble/core/error.hpp"
#include "amble/experiment/steering.hpp"
#include "amble/exporting/c_text.hpp"
#include "amble/exporting/json_source.hpp"
#include "amble/io/file.hpp"

namespace amble::exporting {
namespace {

namespace fs = std::filesystem;

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

/// Refuses a prefix with which a helper of the source has the name of something in the header.
void check_helper_names(const std::string& prefix, const CSource& c, const fs::path& out) {
  constexpr std::string_view begins = "\nstatic ";
  for (auto at = c.source.find(begins); at != std::string::npos; at = c.source.find(begins, at + 1)) {
    const std::string line = c.source.substr(at + 1, c.source.find('\n', at + 1) - at - 1);
    const std::string head = line.substr(0, line.find_first_of("(["));
    const std::string name = head.substr(head.find_last_of(" *") + 1);
    if (name.starts_with(prefix + "_") && c.header.find(name) != std::string::npos)
      fail(ExitCode::bad_input,
           "{}: the file's name is the prefix of all names in it, and {} is that of a helper; expected "
           "another name",
           out.string(), name);
  }
}

void check_c_name(const fs::path& out) {
  const std::string stem = out.stem().string();
  if (c_identifier(stem) != stem)
    fail(ExitCode::bad_input,
         "{}: the file's name is the prefix of all names in it: expected a letter, then letters, digits and "
         "underscores",
         out.string());
  for (const fs::path& path : {out, header_of(out)})
    io::check_output(path, "/* Controller exported by amble", "an exported controller");
}

}  // namespace

void steer_by_hand(experiment::Champion& champion, const std::string& gains, const std::string& what) {
  if (champion.problem.command.kind == trial::CommandKind::none)
    champion.problem.set_commands(
        {.kind = trial::CommandKind::fixed, .stretches = {{0.3, 0.0}, {0.3, 0.3}, {0.2, -0.3}, {}}});
  experiment::steer_by_hand(champion.problem, gains, what);
}

void write_c(const experiment::Champion& champion, const fs::path& out, Arithmetic arithmetic,
             const std::atomic<bool>& stop) {
  check_c_name(out);
  const auto tables = controller_tables(champion.problem, champion.genome);
  const auto trace = record_trace(champion.problem, champion.genome, test_ticks, stop);
  if (stop) return;
  const auto c = c_source(
      tables, champion.problem.robot, provenance_of(champion), trace,
      {.prefix = out.stem().string(), .arithmetic = arithmetic, .start = start_sentence(champion.problem)});
  check_helper_names(out.stem().string(), c, out);
  io::write_output(header_of(out), c.header);
  io::write_output(out, c.source);
}

std::string export_json(const experiment::Champion& champion, const std::atomic<bool>& stop) {
  const auto tables = controller_tables(champion.problem, champion.genome);
  const auto trace = record_trace(champion.problem, champion.genome, test_ticks, stop);
  return stop ? std::string() : json_source(champion, tables, provenance_of(champion), trace);
}

}  // namespace amble::exporting
