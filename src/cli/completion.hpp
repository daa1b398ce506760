#pragma once

#include <string>
#include <vector>

namespace amble::cli {

/// What may follow an option, or stand as an argument.
enum class Value {
  none,   ///< nothing: a flag
  file,   ///< a path
  other,  ///< a number or a word that the shell cannot know
};

struct OptionSummary {
  std::vector<std::string> names;  ///< with their dashes; empty for arguments without a name
  std::string what;                ///< one line
  Value value = Value::none;
  std::vector<std::string> choices;  ///< all values there are; empty: any
  bool is_list = false;              ///< takes several values with commas between them
};

struct CommandSummary {
  std::string name, what;
  std::vector<OptionSummary> options;    ///< without those that help does not show
  std::vector<OptionSummary> arguments;  ///< in order
};

/// The command line as the shells need it.
struct ProgramSummary {
  std::string name;
  std::vector<OptionSummary> options;  ///< before a command
  std::vector<CommandSummary> commands;
};

// Scripts that complete commands, options and values as one types; for `source`, or for the folder where the
// shell looks for them.
std::string bash_completion(const ProgramSummary& program);
std::string zsh_completion(const ProgramSummary& program);
std::string fish_completion(const ProgramSummary& program);

}  // namespace amble::cli
