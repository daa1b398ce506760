#include "amble/cli/completion.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <algorithm>
#include <array>
#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "amble/cli/help.hpp"
#include "amble/experiment/config.hpp"
#include "amble/io/quoting.hpp"
#include "amble/io/toml_settings.hpp"

namespace amble::cli {
namespace {

std::string joined(const std::vector<std::string>& words, std::string_view between) {
  return fmt::format("{}", fmt::join(words, between));
}

/// The text with a backslash before each of these characters.
std::string escaped(std::string_view text, std::string_view special) {
  std::string out;
  for (const char c : text) {
    if (special.find(c) != std::string_view::npos) out += '\\';
    out += c;
  }
  return out;
}

std::vector<std::string> option_names(const std::vector<OptionSummary>& options) {
  std::vector<std::string> all;
  for (const OptionSummary& option : options) all.insert(all.end(), option.names.begin(), option.names.end());
  return all;
}

bool takes_files(const OptionSummary& option) {
  return option.value == Value::file && option.choices.empty();
}

/// A branch of bash's `case` for an option with a value: what completes the value.
std::string bash_value(const std::string& command, const OptionSummary& option) {
  std::vector<std::string> patterns;
  for (const std::string& name : option.names) patterns.push_back(fmt::format("{}:{}", command, name));
  const std::string reply = takes_files(option)
                                ? "_amble_files"
                                : fmt::format("{} {}", option.is_list ? "_amble_items" : "_amble_words",
                                              io::shell_quoted(joined(option.choices, " ")));
  return fmt::format("    {}) {}; return ;;\n", joined(patterns, " | "), reply);
}

/// An entry of zsh's _arguments; `what` must not have a line break.
std::string zsh_option(const OptionSummary& option) {
  const std::string what = escaped(option.what, "[]:\\");
  const std::string value =
      option.value == Value::none ? ""
      : takes_files(option)       ? ":file:_files"
      : option.choices.empty()    ? ":value: "
      : option.choices.front().ends_with('=')
          ? fmt::format(":setting:{{compadd -S \"\" -- {}}}", joined(option.choices, " "))
      : option.is_list ? fmt::format(":value:_values -s , value {}", joined(option.choices, " "))
                       : fmt::format(":value:({})", joined(option.choices, " "));
  std::string entries;
  for (const std::string& name : option.names)
    entries += " \\\n        " + io::shell_quoted(fmt::format("*{}[{}]{}", name, what, value));
  return entries;
}

std::string fish_option(const std::string& condition, const OptionSummary& option) {
  std::string line = fmt::format("complete -c amble -n {}", io::shell_quoted(condition));
  for (const std::string& name : option.names)
    line += name.starts_with("--") ? " -l " + name.substr(2) : " -s " + name.substr(1);
  if (takes_files(option))
    line += " -r -F";
  else if (option.value != Value::none)
    line += " -x";
  if (const std::string all = joined(option.choices, " "); !all.empty())
    line += " -a " + io::shell_quoted(option.is_list ? fmt::format("(__fish_append , {})", all) : all);
  return line + " -d " + io::shell_quoted(option.what) + "\n";
}

constexpr std::string_view bash_head = R"(# Completion of amble in bash: source <(amble completion bash)
_amble_words() {
  mapfile -t COMPREPLY < <(compgen -W "$1" -- "$word")
  # Behind a key comes its value.
  if [[ ${COMPREPLY[0]-} == *= ]]; then compopt -o nospace; fi
}
_amble_items() {
  # Behind the last comma.
  local before=''
  if [[ $word == *,* ]]; then before=${word%,*},; fi
  mapfile -t COMPREPLY < <(compgen -P "$before" -W "$1" -- "${word##*,}")
}
_amble_files() {
  compopt -o filenames
  mapfile -t COMPREPLY < <(compgen -f -- "$word")
}
_amble() {
  local word=${COMP_WORDS[COMP_CWORD]} before=${COMP_WORDS[COMP_CWORD-1]} command='' i
  COMPREPLY=()
  for ((i = 1; i < COMP_CWORD; ++i)); do
    if [[ ${COMP_WORDS[i]} != -* ]]; then
      command=${COMP_WORDS[i]}
      break
    fi
  done
  # --option=value is three words.
  if [[ $word == '=' ]]; then
    word=''
  elif [[ $before == '=' ]]; then
    before=${COMP_WORDS[COMP_CWORD-2]}
  fi
)";

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
  // "COMMANDS|FILE": what is typed, or a file.
  const bool or_file = type.ends_with("|FILE");
  if (!or_file) summary.choices = type == key_value ? assignable_keys() : choices_of(type);
  summary.is_list = option.get_delimiter() == ',';
  if (option.get_items_expected_max() > 0)
    summary.value = or_file || type.starts_with("TEXT") ? Value::file : Value::other;
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
  // What it explains are these commands.
  const auto help = std::ranges::find(program.commands, std::string_view("help"), &CommandSummary::name);
  if (help != program.commands.end() && !help->arguments.empty())
    for (const CommandSummary& command : program.commands)
      help->arguments.front().choices.push_back(command.name);
  return program;
}

}  // namespace

std::string bash_completion(const ProgramSummary& program) {
  std::string values, words;
  for (const CommandSummary& command : program.commands) {
    for (const OptionSummary& option : command.options)
      if (option.value != Value::none) values += bash_value(command.name, option);
    const auto choices = std::ranges::find_if(
        command.arguments, [](const OptionSummary& argument) { return !argument.choices.empty(); });
    const bool files = std::ranges::any_of(command.arguments, takes_files);
    words += fmt::format("    {}) [[ $word == -* ]] && _amble_words {} || {} ;;\n", command.name,
                         io::shell_quoted(joined(option_names(command.options), " ")),
                         choices != command.arguments.end()
                             ? fmt::format("_amble_words {}", io::shell_quoted(joined(choices->choices, " ")))
                             : std::string(files ? "_amble_files" : "true"));
  }
  std::vector<std::string> first = option_names(program.options);
  for (const CommandSummary& command : program.commands) first.push_back(command.name);
  return fmt::format(
      "{}  case $command:$before in\n{}  esac\n  case $command in\n    '') _amble_words {} ;;\n{}  esac\n}}\n"
      "complete -F _amble {}\n",
      bash_head, values, io::shell_quoted(joined(first, " ")), words, program.name);
}

std::string zsh_completion(const ProgramSummary& program) {
  std::string commands, cases;
  for (const CommandSummary& command : program.commands) {
    commands += "    " + io::shell_quoted(escaped(command.name, ":") + ":" + command.what) + "\n";
    std::string entries;
    for (const OptionSummary& option : command.options) entries += zsh_option(option);
    for (const OptionSummary& argument : command.arguments)
      entries +=
          " \\\n        " + io::shell_quoted(argument.choices.empty()
                                                 ? "*:" + escaped(argument.what, ":\\") + ":_files"
                                                 : fmt::format(":{}:({})", escaped(argument.what, ":\\"),
                                                               joined(argument.choices, " ")));
    cases += fmt::format("    {}) _arguments{} ;;\n", command.name, entries);
  }
  return fmt::format(
      "#compdef {0}\n# Completion of {0} in zsh: source <({0} completion zsh), after compinit\n_amble() {{\n"
      "  local -a commands=(\n{1}  )\n  if (( CURRENT == 2 )); then\n    _describe command commands\n    "
      "return\n"
      "  fi\n  shift words\n  (( CURRENT-- ))\n  case $words[1] in\n{2}  esac\n}}\n"
      "if [[ $funcstack[1] == _amble ]]; then\n  _amble \"$@\"\nelse\n  compdef _amble {0}\nfi\n",
      program.name, commands, cases);
}

std::string fish_completion(const ProgramSummary& program) {
  std::string text = fmt::format("# Completion of {0} in fish: {0} completion fish | source\n", program.name);
  text += fmt::format("complete -c {} -e\n", program.name);
  for (const OptionSummary& option : program.options) text += fish_option("__fish_use_subcommand", option);
  for (const CommandSummary& command : program.commands)
    text += fmt::format("complete -c {} -n __fish_use_subcommand -f -a {} -d {}\n", program.name,
                        command.name, io::shell_quoted(command.what));
  for (const CommandSummary& command : program.commands) {
    const std::string condition = "__fish_seen_subcommand_from " + command.name;
    for (const OptionSummary& option : command.options) text += fish_option(condition, option);
    for (const OptionSummary& argument : command.arguments)
      if (!argument.choices.empty())
        text += fmt::format("complete -c {} -n {} -f -a {}\n", program.name, io::shell_quoted(condition),
                            io::shell_quoted(joined(argument.choices, " ")));
  }
  return text;
}

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
