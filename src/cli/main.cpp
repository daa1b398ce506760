#include <fmt/format.h>
#include <fmt/ranges.h>

#include <CLI/CLI.hpp>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <new>
#include <string>
#include <string_view>
#include <system_error>
#include <vector>

#include "amble/cli/data_folder.hpp"
#include "amble/cli/help.hpp"
#include "amble/cli/messages.hpp"
#include "amble/experiment/build_info.hpp"
#include "amble/io/file.hpp"
#include "amble/io/plugin_file.hpp"
#include "amble/io/quoting.hpp"
#include "amble/io/text.hpp"
#include "amble/physics/batch/instruction_set.hpp"
#include "amble/physics/engine.hpp"

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

/// The command that was given, as it could be given again.
std::string command_line(int argc, char** argv) {
  std::string line = "amble";
  for (int i = 1; i < argc; ++i) {
    const std::string word = argv[i];
    const std::size_t equals = word.starts_with('-') ? word.find('=') : 0;
    if (!word.starts_with('-'))
      line += " " + amble::io::shell_word(word);
    else if (equals == std::string::npos || word.substr(equals + 1).starts_with('-'))
      line += " " + word;
    else
      line += " " + word.substr(0, equals + 1) + amble::io::shell_word(word.substr(equals + 1));
  }
  return line;
}

/// Lines whose first word is their name.
std::string version_text() {
  const auto build = amble::experiment::build_info();
  return fmt::format(
      "amble {}\ncommit        {}\nbuild         {}, {}\nengines       {} ({})\ninstructions  {}, of {}",
      build.version, build.commit, build.compiler, build.flags,
      fmt::join(amble::physics::engine_names(), ", "), build.libraries, amble::physics::instruction_set(),
      amble::experiment::cpu_name());
}

/// Under what heading help lists a command.
struct Group {
  const char* name;
  std::vector<void (*)(CLI::App&, amble::cli::Action&)> commands;
};

void add_commands(CLI::App& app, amble::cli::Action& action) {
  using namespace amble::cli;
  const std::vector<Group> groups{
      {"Evolve", {add_evolve, add_resume, add_study}},
      {"See", {add_view, add_lab, add_page, add_repertoire, add_draw}},
      {"Measure", {add_trial, add_compare, add_gait, add_report, add_info, add_verify}},
      {"Take away, and adapt", {add_export, add_adapt}},
      {"Robots and settings", {add_robot, add_settings, add_substrate}},
      {"The command line", {add_completion, add_help}}};
  for (const Group& group : groups)
    for (const auto add : group.commands) {
      const std::size_t before = app.get_subcommands({}).size();
      add(app, action);
      app.get_subcommands({}).at(before)->group(group.name);
    }
}

/// Loads the plugins of `--plugin FILE`, which stands before or behind the command, and of AMBLE_PLUGINS
/// (names with a colon between two), and takes them out of the arguments: what configs can choose must be
/// known before they are read. The programs that this one starts find them in AMBLE_PLUGINS.
std::vector<char*> load_plugins(int argc, char** argv) {
  std::vector<std::string> files;
  if (const char* before = std::getenv("AMBLE_PLUGINS"))
    for (const auto& file : amble::io::split(before, ':'))
      if (!file.empty()) files.emplace_back(file);
  std::vector<char*> rest;
  for (int i = 0; i < argc; ++i) {
    const std::string_view word = argv[i];
    if (word != "--plugin" && !word.starts_with("--plugin=")) {
      rest.push_back(argv[i]);
      continue;
    }
    const std::string_view file = word == "--plugin" ? (i + 1 < argc ? argv[++i] : "") : word.substr(9);
    if (file.empty())
      amble::fail(ExitCode::bad_input, "--plugin: expected a shared library, such as libmine.so");
    files.push_back(std::filesystem::absolute(file).string());
  }
  for (const std::string& file : files) amble::io::load_plugin(file);
  if (!files.empty()) ::setenv("AMBLE_PLUGINS", fmt::format("{}", fmt::join(files, ":")).c_str(), 1);
  return rest;
}

/// What an exception of a library does not say.
std::string after_reading() {
  const std::string file = amble::io::last_read_file();
  return file.empty() ? "" : fmt::format("; the last file read: {}", file);
}

std::string circumstances(int argc, char** argv) {
  return fmt::format("{}, in: {}", after_reading(), command_line(argc, argv));
}

ExitCode run(int all, char** words) {
  const std::vector<char*> given = load_plugins(all, words);
  std::vector<std::string> texts = amble::cli::with_own_files({given.begin(), given.end()});
  std::vector<char*> arguments;
  arguments.reserve(texts.size());
  for (std::string& text : texts) arguments.push_back(text.data());
  const int argc = static_cast<int>(arguments.size());
  char** const argv = arguments.data();
  CLI::App app("Evolves walking controllers for legged robots.", "amble");
  app.set_version_flag("--version", version_text());
  app.require_subcommand(1);
  app.formatter(amble::cli::help_formatter());
  app.footer(
      "amble help COMMAND explains a command, with examples. amble --plugin FILE.so COMMAND … adds "
      "controllers,\n"
      "searches and engines of your own (docs/LIBRARY.md).");
  amble::cli::Action action;
  add_commands(app, action);
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
    throw amble::cli::usage_error(app, error, argc, argv);
  }
  amble::cli::refuse_empty_values(app);
  return action();
}

}  // namespace

int main(int argc, char** argv) {
  amble::cli::reserve_standard_streams();
  // A file that reaches the limit of its size (ulimit -f) is an error like a full disk, with its name.
  std::signal(SIGXFSZ, SIG_IGN);
  ExitCode code = ExitCode::internal;
  try {
    code = run(argc, argv);
    if (std::fflush(stdout) != 0) code = report(ExitCode::io, "cannot write to the standard output");
  } catch (const amble::UserError& error) {
    code = report(error.code(), error.what());
  } catch (const std::filesystem::filesystem_error& error) {
    code = report(ExitCode::io, fmt::format("{}: {}", amble::io::printable(error.path1().string()),
                                            error.code().message()));
  } catch (const std::system_error& error) {  // of files: permissions, a full device
    code = report(ExitCode::io, fmt::format("{}{}", error.what(), circumstances(argc, argv)));
  } catch (const std::bad_alloc&) {
    code = report(
        ExitCode::io,
        fmt::format(
            "not enough memory for `amble {}`: the system refused more; a higher limit (ulimit -v, the "
            "job's memory), fewer --jobs or smaller inputs may help{}",
            argc > 1 ? argv[1] : "", after_reading()));
  } catch (const std::exception& error) {
    code = report(ExitCode::internal, fmt::format("defect: {}{}", error.what(), circumstances(argc, argv)));
  }
  return static_cast<int>(code);
}
