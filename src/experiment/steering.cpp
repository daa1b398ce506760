#include "amble/experiment/steering.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <optional>
#include <set>
#include <string_view>
#include <utility>
#include <vector>

#include "amble/core/error.hpp"
#include "amble/io/text.hpp"
#include "amble/io/toml_settings.hpp"
#include "amble/trial/commands.hpp"

namespace amble::experiment {
namespace {

constexpr std::string_view example = "\"turn_gain = 1.5, full_speed_m_s = 0.4\"";

std::string trimmed(std::string_view text) {
  return std::string(io::trimmed(text, " \t\r\n"));
}

/// What is between commas, semicolons and ends of lines that are neither in brackets nor in quotes.
std::vector<std::string> parts_of(std::string_view text) {
  std::vector<std::string> parts;
  std::size_t begin = 0;
  int brackets = 0;
  char quote = '\0';
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    if (quote != '\0')
      quote = c == quote ? '\0' : quote;
    else if (c == '"' || c == '\'')
      quote = c;
    else if (c == '[' || c == '{')
      ++brackets;
    else if (c == ']' || c == '}')
      --brackets;
    else if (brackets == 0 && (c == ',' || c == ';' || c == '\n')) {
      parts.push_back(trimmed(text.substr(begin, i - begin)));
      begin = i + 1;
    }
  }
  parts.push_back(trimmed(text.substr(begin)));
  return parts;
}

/// KEY = VALUE as a document; nothing if it is none.
std::optional<io::TomlDocument> document_of(const std::string& part, const std::string& what) {
  if (part.find('=') == std::string::npos || part.front() == '#') return {};
  try {
    return io::TomlDocument::parse(part, what);
  } catch (const UserError&) {
    return {};
  }
}

std::string expected_keys() {
  const io::SettingsColumn gains{
      .title = {}, .describe = [settings = HandSteering()](io::SettingsVisitor& visitor) mutable {
        settings.describe(visitor);
      }};
  return fmt::format("{}", fmt::join(io::setting_keys(gains), ", "));
}

/// Without the line of a text of one line, and with the keys that there are.
std::string without_line(std::string message, const std::string& what) {
  if (const std::string line = what + ":1: "; message.starts_with(line))
    message.replace(0, line.size(), what + ": ");
  if (message.find("unknown key") != std::string::npos) message += "; expected " + expected_keys();
  return message;
}

}  // namespace

void tell(Problem& problem, const std::string& line, const std::string& what) {
  try {
    problem.set_commands({.kind = trial::CommandKind::fixed, .stretches = trial::parse_commands(line)});
  } catch (const SettingError& error) {
    std::string message = error.what();
    if (constexpr std::string_view key = "command.stretches: "; message.starts_with(key))
      message.erase(0, key.size());
    fail(ExitCode::bad_input, "{} \"{}\": {}; expected fewer, or a longer trial", what, io::printable(line),
         message);
  } catch (const UserError& error) {
    std::string message = error.what();
    if (constexpr std::string_view one = "command "; message.starts_with(one))
      message.replace(0, one.size(), what + " ");
    throw UserError(message);
  }
}

void HandSteering::describe(io::SettingsVisitor& visitor) {
  gains.describe(visitor);
  heading.describe(visitor, "heading_lead_rad");
}

HandSteering parse_steering(const std::string& text, const std::string& what) {
  HandSteering settings;
  std::set<std::string> given;
  for (const std::string& part : parts_of(text)) {
    const auto document = document_of(part, what);
    if (!document)
      fail(ExitCode::bad_input,
           "{}: \"{}\": expected gains, KEY = VALUE with a comma between two (docs/STEERING.md), e.g. {}",
           what, io::printable(part.empty() ? text : part), example);
    if (const auto key = trimmed(part.substr(0, part.find('='))); !given.insert(key).second)
      fail(ExitCode::bad_input, "{}: {} is given twice; expected it once", what, io::printable(key));
    try {
      const auto reader = document->reader();
      settings.describe(*reader);
      reader->finish();
    } catch (const UserError& error) {
      throw UserError(without_line(error.what(), what));
    }
  }
  if (!settings.gains.any())
    fail(ExitCode::bad_input,
         "{}: \"{}\" steers nothing: expected turn_gain, full_speed_m_s or both, e.g. {}", what,
         io::printable(text), example);
  return settings;
}

void steer_by_hand(Problem& problem, const HandSteering& steering) {
  Problem changed = problem;
  if (steering.heading.lead_rad > 0.0) changed.controller.sensing.heading = steering.heading;
  changed.set_differential(steering.gains);
  if (steering.heading.lead_rad > 0.0 &&
      !changed.architecture->reads({.kind = substrate::Sensor::Kind::heading_error}))
    fail_setting({"controller.differential.heading_lead_rad", "controller.differential.heading_gain"},
                 "controller.differential.heading_lead_rad = {}: nothing reads a heading error; expected a "
                 "heading_gain as well",
                 steering.heading.lead_rad);
  problem = std::move(changed);
}

void steer_by_hand(Problem& problem, const std::string& text, const std::string& what) {
  try {
    steer_by_hand(problem, parse_steering(text, what));
  } catch (const SettingError& error) {
    std::string message = error.what();
    constexpr std::string_view table = "controller.differential.";  // which nobody has typed here
    for (auto at = message.find(table); at != std::string::npos; at = message.find(table))
      message.erase(at, table.size());
    fail(ExitCode::bad_input, "{}: {}", what, message);
  }
}

}  // namespace amble::experiment
