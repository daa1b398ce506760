#include <fmt/format.h>
#include <fmt/ranges.h>

#include <CLI/CLI.hpp>
#include <cstdio>
#include <string>
#include <system_error>

#include "amble/cli/commands.hpp"
#include "amble/cli/messages.hpp"
#include "amble/experiment/build_info.hpp"
#include "amble/physics/engine.hpp"
#include "amble/physics/instruction_set.hpp"

namespace {

using amble::ExitCode;

ExitCode report(ExitCode code, std::string text) {
  // One line, whatever a library may have put into its message.
  for (char& c : text)
    if (c == '\n') c = ' ';
  while (text.ends_with(' ')) text.pop_back();
  amble::cli::print_message(fmt::format("amble: {}\n", text));
  return code;
}

/// Of each line the first word is its name.
std::string version_text() {
  const auto build = amble::experiment::build_info();
  return fmt::format(
      "amble {}\ncommit        {}\nbuild         {}, {}\nengines       {} ({})\ninstructions  {}, of {}",
      build.version, build.commit, build.compiler, build.flags,
      fmt::join(amble::physics::engine_names(), ", "), build.libraries, amble::physics::instruction_set(),
      amble::experiment::cpu_name());
}

ExitCode run(int argc, char** argv) {
  CLI::App app("Evolves walking controllers for legged robots.", "amble");
  app.set_version_flag("--version", version_text());
  app.require_subcommand(1);
  app.footer("Each command explains itself: amble COMMAND --help");
  amble::cli::Action action;
  amble::cli::add_evolve(app, action);
  amble::cli::add_resume(app, action);
  amble::cli::add_trial(app, action);
  amble::cli::add_compare(app, action);
  amble::cli::add_gait(app, action);
  amble::cli::add_info(app, action);
  amble::cli::add_robot(app, action);
  amble::cli::add_study(app, action);
  amble::cli::add_report(app, action);
  amble::cli::add_verify(app, action);
  amble::cli::add_page(app, action);
  amble::cli::add_view(app, action);
  amble::cli::add_draw(app, action);
  amble::cli::add_export(app, action);
  amble::cli::add_repertoire(app, action);
  amble::cli::add_adapt(app, action);
  amble::cli::add_settings(app, action);
  amble::cli::add_substrate(app, action);
  amble::cli::add_completion(app, action);
  if (argc == 1) {
    fmt::print("{}", app.help());
    return ExitCode::ok;
  }
  try {
    app.parse(argc, argv);
  } catch (const CLI::Success& request) {  // --help, --version
    app.exit(request);
    return ExitCode::ok;
  } catch (const CLI::ParseError& error) {
    if (argc > 1 && argv[1][0] != '-' && app.get_subcommands().empty())
      return report(ExitCode::bad_input, fmt::format("unknown command '{}' (amble --help)", argv[1]));
    return report(ExitCode::bad_input, std::string(error.what()) + " (amble --help)");
  }
  return action();
}

}  // namespace

int main(int argc, char** argv) {
  amble::cli::reserve_standard_streams();
  ExitCode code = ExitCode::internal;
  try {
    code = run(argc, argv);
    if (std::fflush(stdout) != 0) code = report(ExitCode::io, "cannot write to the standard output");
  } catch (const amble::UserError& error) {
    code = report(error.code(), error.what());
  } catch (const std::system_error& error) {  // of files: permissions, a full device
    code = report(ExitCode::io, error.what());
  } catch (const std::exception& error) {
    code = report(ExitCode::internal, fmt::format("defect: {}", error.what()));
  }
  return static_cast<int>(code);
}
