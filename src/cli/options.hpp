#pragma once

#include <fmt/format.h>
#include <CLI/CLI.hpp>
#include <algorithm>
#include <concepts>
#include <optional>
#include <string>
#include <thread>

#include "amble/experiment/champion.hpp"
#include "amble/physics/engine.hpp"
#include "amble/presentation/shown_trial.hpp"

namespace amble::cli {

/// Rejects an option with "VALUE: expected a number from LOWER to UPPER", or "a whole number".
template <typename Number>
CLI::Validator between(Number lower, Number upper) {
  const auto error = [lower, upper](const std::string& text) {
    Number value{};
    // The library takes 010 for 8 and 0x10 for 16.
    const auto digits = text.find_first_not_of("+-");
    const bool is_decimal = digits == std::string::npos || text[digits] != '0' || digits + 1 == text.size() ||
                            std::string_view("0123456789xX").find(text[digits + 1]) == std::string_view::npos;
    if (std::integral<Number> && !is_decimal)
      return fmt::format("{}: expected a whole number without a leading 0", text);
    if (CLI::detail::lexical_cast(text, value) && value >= lower && value <= upper) return std::string();
    return fmt::format("{}: expected a {}number from {} to {}", text, std::integral<Number> ? "whole " : "",
                       lower, upper);
  };
  return CLI::Validator(error, "");
}

/// The engines' names as an option's help lists its values.
inline std::string engine_values() {
  return fmt::format("{}", fmt::join(physics::engine_names(), "|"));
}

/// Adds the option --engine.
inline void add_engine(CLI::App& command, std::optional<std::string>& engine, const std::string& what) {
  command.add_option("--engine", engine, what)->type_name(engine_values());
}

/// As many as the machine has, at least 1.
inline int processors() {
  return std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
}

/// Adds the option --jobs, of the same meaning everywhere: all processors by default.
inline void add_jobs(CLI::App& command, int& jobs,
                     const std::string& what = "Processors to use; the results do not depend on it") {
  jobs = processors();
  command.add_option("--jobs", jobs, what)->capture_default_str()->check(between(1, 1024));
}

/// Check of the length of a trial.
inline CLI::Validator seconds_check() {
  return between(1e-5, 1e6);
}

/// Throws UserError: --seconds is no whole number of the trial's timesteps.
void check_seconds(std::optional<double> seconds, trial::Settings trial);

/// Adds --level, --noise, --trials and --undisturbed. `trials`: how many there are by default, for the help.
void add_disturbance(CLI::App& command, presentation::TrialChoice& choice,
                     const std::string& trials = "64, or 16 in engines that run one at a time");

/// presentation::shown_trial() on all processors. Throws UserError(interrupted) on a stop signal.
presentation::ShownTrial shown_trial(const experiment::Champion& champion, std::optional<double> seconds,
                                     const std::optional<std::string>& engine,
                                     const presentation::TrialChoice& choice);

}  // namespace amble::cli
