#include "amble/cli/help.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <array>
#include <cstddef>
#include <filesystem>
#include <optional>
#include <system_error>
#include <utility>
#include <vector>

#include "amble/core/error.hpp"
#include "amble/io/text.hpp"

namespace amble::cli {
namespace {

constexpr std::size_t help_columns = 100, first_column = 30;

/// The text in lines of so many characters, each but the first behind `indent` spaces.
std::string wrapped(std::string_view text, std::size_t indent) {
  std::string out;
  std::size_t column = indent;
  while (!text.empty()) {
    const std::size_t end = std::min(text.find(' '), text.size());
    const std::string_view word = text.substr(0, end);
    text.remove_prefix(std::min(text.size(), end + 1));
    if (column > indent && column + 1 + word.size() > help_columns) {
      out += "\n" + std::string(indent, ' ');
      column = indent;
    } else if (column > indent) {
      out += ' ';
      ++column;
    }
    out += word;
    column += word.size();
  }
  return out;
}

/// The name of a type that a reader expects, from CLI11's.
std::string value_name(const std::string& type) {
  constexpr std::array<std::pair<std::string_view, std::string_view>, 4> names{
      {{"TEXT", "PATH"}, {"UINT", "N"}, {"INT", "N"}, {"FLOAT", "NUMBER"}}};
  const std::size_t open = type.find('{'), close = type.find('}');
  if (open != std::string::npos && close != std::string::npos) {
    std::string choices = type.substr(open + 1, close - open - 1);
    std::ranges::replace(choices, ',', '|');
    return choices;
  }
  for (const auto& [name, shown] : names)
    if (type == name) return std::string(shown);
  return type;
}

class HelpFormatter final : public CLI::Formatter {
 public:
  HelpFormatter() {
    column_width(first_column);
    label("Positionals", "Arguments");
    label("SUBCOMMAND", "COMMAND");
    label("Subcommands", "Commands");
  }

  std::string make_help(const CLI::App* app, std::string name, CLI::AppFormatMode mode) const override {
    // Groups that are not shown leave empty lines.
    return CLI::detail::find_and_replace(Formatter::make_help(app, std::move(name), mode), "\n\n\n", "\n\n");
  }

  std::string make_option_opts(const CLI::Option* option) const override {
    if (option->get_type_size() == 0 || option->get_positional()) return "";
    const bool several = option->get_expected_max() == CLI::detail::expected_max_vector_size;
    return " " + value_name(option->get_type_name()) + (several ? " ..." : "");
  }

  std::string make_option_desc(const CLI::Option* option) const override {
    std::string text = option->get_description();
    if (option == option_help(option)) text = "Print this and exit";
    const std::string value = option->get_default_str();
    if (!value.empty()) text += fmt::format(" (default: {})", value);
    if (option->get_required() && !option->get_positional()) text += " (required)";
    return wrapped(text, first_column);
  }

  std::string make_option(const CLI::Option* option, bool is_positional) const override {
    return entry(make_option_name(option, is_positional) + make_option_opts(option),
                 make_option_desc(option));
  }

  std::string make_subcommand(const CLI::App* command) const override {
    return entry(command->get_name(), wrapped(command->get_description(), first_column));
  }

  std::string make_description(const CLI::App* app) const override {
    return wrapped(app->get_description(), 0) + "\n\n";
  }

 private:
  static const CLI::Option* option_help(const CLI::Option* option) {
    return option->check_lname("help") ? option : nullptr;
  }
  static std::string entry(const std::string& name, const std::string& what) {
    const std::string start = "  " + name;
    const std::string gap = start.size() + 2 > first_column ? "\n" + std::string(first_column, ' ')
                                                            : std::string(first_column - start.size(), ' ');
    return start + gap + what + "\n";
  }
};

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
    // Any letter is like any other.
    const bool is_letter = name.size() <= 2;
    return fmt::format("unknown option '{}'{}", name,
                       is_letter ? "" : io::did_you_mean(name, option_names(command)));
  }
  for (const std::string& word : app.remaining(true))
    if (word != "--") return fmt::format("unexpected argument '{}'", word);
  return std::nullopt;
}

/// An argument or option that is given as "".
std::optional<std::string> empty_value(const CLI::App& command) {
  for (const CLI::Option* option : command.get_options())
    if (option->get_items_expected_max() > 0 &&
        std::ranges::find(option->results(), "") != option->results().end())
      return fmt::format("{} \"\": the value is empty; expected {}; what it is for: {}", option->get_name(),
                         value_name(option->get_type_name()), option->get_description());
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

std::shared_ptr<CLI::FormatterBase> help_formatter() {
  return std::make_shared<HelpFormatter>();
}

void add_examples(CLI::App& command, std::initializer_list<Example> examples) {
  std::size_t widest = 0;
  for (const Example& example : examples)
    if (!example.what.empty()) widest = std::max(widest, example.line.size());
  std::string text = examples.size() == 1 ? "Example:" : "Examples:";
  for (const auto& [line, what] : examples)
    text += what.empty() ? fmt::format("\n  {}", line) : fmt::format("\n  {:<{}}  # {}", line, widest, what);
  command.footer(text);
}

void add_help(CLI::App& app, Action& action) {
  auto* command = app.add_subcommand("help", "Explain a command, or list them all");
  auto name = std::make_shared<std::string>();
  command->add_option("COMMAND", *name, "A command of amble")->type_name("COMMAND");
  add_examples(*command, {{"amble help evolve", ""}});
  command->callback([name, &app, &action] {
    action = [name, &app] {
      if (name->empty()) {
        // app.help() would be that of this command.
        fmt::print("{}", app.get_formatter()->make_help(&app, app.get_name(), CLI::AppFormatMode::Normal));
        return ExitCode::ok;
      }
      for (const CLI::App* asked : app.get_subcommands({}))
        if (asked->get_name() == *name) {
          fmt::print("{}", asked->help(app.get_name()));
          return ExitCode::ok;
        }
      fail(ExitCode::bad_input, "{}", unknown_command(app, *name));
    };
  });
}

std::string unknown_command(const CLI::App& app, std::string_view name) {
  std::vector<std::string> known;
  for (const CLI::App* command : app.get_subcommands({})) known.push_back(command->get_name());
  return fmt::format("unknown command '{}'{}; amble help lists all", name, io::did_you_mean(name, known));
}

void refuse_empty_values(const CLI::App& app) {
  for (const CLI::App* command : app.get_subcommands())
    if (const auto empty = empty_value(*command)) fail(ExitCode::bad_input, "{}", *empty);
}

UserError usage_error(const CLI::App& app, const CLI::ParseError& error, int argc, const char* const* argv) {
  const auto commands = app.get_subcommands();
  if (commands.empty() && argc > 1 && argv[1][0] != '-') return UserError(unknown_command(app, argv[1]));
  const CLI::App& command = commands.empty() ? app : *commands.front();
  const std::string advice =
      commands.empty() ? "amble help" : fmt::format("amble {} --help", command.get_name());
  if (const auto word = unexpected(app, command)) return UserError(fmt::format("{} ({})", *word, advice));
  if (const auto empty = empty_value(command)) return UserError(*empty);
  if (dynamic_cast<const CLI::RequiredError*>(&error) != nullptr)
    if (const auto path = missing_input(command)) return UserError(*path, ExitCode::io);
  return UserError(fmt::format("{} ({})", error.what(), advice));
}

}  // namespace amble::cli
