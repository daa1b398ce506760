#include "amble/cli/usage_error.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <optional>
#include <system_error>
#include <vector>

#include "amble/io/spelling.hpp"

namespace amble::cli {
namespace {

/// All names of a command's options, with their hyphens.
std::vector<std::string> option_names(const CLI::App& command) {
  std::vector<std::string> names;
  for (const CLI::Option* option : command.get_options()) {
    if (option->get_group().empty()) continue;
    for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
    for (const std::string& name : option->get_snames()) names.push_back("-" + name);
  }
  return names;
}

/// What of the command line no option or argument has taken.
std::optional<std::string> unexpected(const CLI::App& app, const CLI::App& command) {
  for (const std::string& word : app.remaining(true)) {
    if (word.size() < 2 || word.front() != '-') continue;
    const std::string name = word.substr(0, word.find('='));
    return fmt::format("unknown option '{}'{}", name, io::did_you_mean(name, option_names(command)));
  }
  for (const std::string& word : app.remaining(true))
    if (word != "--") return fmt::format("unexpected argument '{}'", word);
  return std::nullopt;
}

/// An argument that names a file which does not exist.
std::optional<std::string> missing_input(const CLI::App& command) {
  for (const CLI::Option* option : command.get_options()) {
    if (!option->get_positional() || option->get_type_name() != "TEXT") continue;
    for (const std::string& path : option->results()) {
      std::error_code error;
      if (!std::filesystem::exists(path, error)) return fmt::format("{}: No such file or directory", path);
    }
  }
  return std::nullopt;
}

}  // namespace

std::string unknown_command(const CLI::App& app, std::string_view name) {
  std::vector<std::string> known;
  for (const CLI::App* command : app.get_subcommands({})) known.push_back(command->get_name());
  return fmt::format("unknown command '{}'{}; amble help lists all", name, io::did_you_mean(name, known));
}

UserError usage_error(const CLI::App& app, const CLI::ParseError& error, int argc, const char* const* argv) {
  const auto commands = app.get_subcommands();
  if (commands.empty() && argc > 1 && argv[1][0] != '-') return UserError(unknown_command(app, argv[1]));
  const CLI::App& command = commands.empty() ? app : *commands.front();
  const std::string advice =
      commands.empty() ? "amble help" : fmt::format("amble {} --help", command.get_name());
  if (const auto word = unexpected(app, command)) return UserError(fmt::format("{} ({})", *word, advice));
  if (dynamic_cast<const CLI::RequiredError*>(&error) != nullptr)
    if (const auto path = missing_input(command)) return UserError(*path, ExitCode::io);
  return UserError(fmt::format("{} ({})", error.what(), advice));
}

}  // namespace amble::cli
