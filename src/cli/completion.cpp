#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "amble/cli/commands.hpp"
#include "amble/cli/completion_scripts.hpp"
#include "amble/cli/help.hpp"
#include "amble/experiment/config.hpp"
#include "amble/io/toml_settings.hpp"

namespace amble::cli {
namespace {

struct Shell {
  std::string_view name;
  std::string (*script)(const ProgramSummary& program);
};
/// The type of an option that lays a setting over a config.
constexpr std::string_view key_value = "KEY=VALUE";

constexpr std::array shells{Shell{"bash", bash_completion}, Shell{"zsh", zsh_completion},
                            Shell{"fish", fish_completion}};

std::vector<std::string> pieces(std::string_view text, char between) {
  std::vector<std::string> parts;
  for (std::size_t end = 0; !text.empty(); text.remove_prefix(std::min(text.size(), end + 1))) {
    end = std::min(text.find(between), text.size());
    parts.emplace_back(text.substr(0, end));
  }
  return parts;
}

/// The values that help lists: "ode|batch", or behind the type "TEXT:{text,markdown}".
std::vector<std::string> choices_of(std::string_view type) {
  if (type.find('|') != std::string_view::npos) return pieces(type, '|');
  const std::size_t open = type.find('{'), close = type.find('}');
  if (open == std::string_view::npos || close == std::string_view::npos) return {};
  return pieces(type.substr(open + 1, close - open - 1), ',');
}

/// "population.size=" of each setting.
std::vector<std::string> assignable_keys() {
  experiment::Config config;
  auto keys = io::setting_keys({"", [&](io::SettingsVisitor& visitor) { config.describe(visitor); }});
  for (std::string& key : keys) key += '=';
  return keys;
}

OptionSummary summary_of(const CLI::Option& option) {
  OptionSummary summary;
  summary.what = option.get_description();
  for (const std::string& name : option.get_snames()) summary.names.push_back("-" + name);
  for (const std::string& name : option.get_lnames()) summary.names.push_back("--" + name);
  const std::string type = option.get_type_name();
  summary.choices = type == key_value ? assignable_keys() : choices_of(type);
  if (option.get_items_expected_max() > 0)
    summary.value = type.starts_with("TEXT") ? Value::file : Value::other;
  return summary;
}

/// Arguments and options as help shows them.
void summarise(const CLI::App& app, std::vector<OptionSummary>& options,
               std::vector<OptionSummary>* arguments) {
  for (const CLI::Option* option : app.get_options()) {
    if (option->get_positional()) {
      if (arguments) arguments->push_back(summary_of(*option));
    } else if (!option->get_group().empty()) {
      options.push_back(summary_of(*option));
    }
  }
}

ProgramSummary summary_of(const CLI::App& app) {
  ProgramSummary program{.name = app.get_name(), .options = {}, .commands = {}};
  summarise(app, program.options, nullptr);
  for (const CLI::App* command : app.get_subcommands({})) {
    program.commands.push_back(
        {.name = command->get_name(), .what = command->get_description(), .options = {}, .arguments = {}});
    summarise(*command, program.commands.back().options, &program.commands.back().arguments);
  }
  return program;
}

}  // namespace

void add_completion(CLI::App& app, Action& action) {
  auto* command = app.add_subcommand(
      "completion", "Print a script by which a shell completes commands, options and their values");
  std::vector<std::string> names;
  names.reserve(shells.size());
  for (const Shell& shell : shells) names.emplace_back(shell.name);
  auto name = std::make_shared<std::string>();
  command->add_option("SHELL", *name, "For bash: source <(amble completion bash)")
      ->required()
      ->check(CLI::IsMember(names));
  add_examples(*command,
               {{"source <(amble completion bash)", "in ~/.bashrc"}, {"amble completion fish | source", ""}});
  command->callback([name, &app, &action] {
    action = [name, &app] {
      for (const Shell& shell : shells)
        if (shell.name == *name) fmt::print("{}", shell.script(summary_of(app)));
      return ExitCode::ok;
    };
  });
}

}  // namespace amble::cli
