#include "amble/cli/completion_scripts.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <string_view>

#include "amble/io/shell.hpp"

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
  const std::string reply =
      takes_files(option) ? "_amble_files"
                          : fmt::format("_amble_words {}", io::shell_quoted(joined(option.choices, " ")));
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
  if (!option.choices.empty()) line += " -a " + io::shell_quoted(joined(option.choices, " "));
  return line + " -d " + io::shell_quoted(option.what) + "\n";
}

constexpr std::string_view bash_head = R"(# Completion of amble in bash: source <(amble completion bash)
_amble_words() {
  mapfile -t COMPREPLY < <(compgen -W "$1" -- "$word")
  # Behind a key comes its value.
  if [[ ${COMPREPLY[0]-} == *= ]]; then compopt -o nospace; fi
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

}  // namespace amble::cli
