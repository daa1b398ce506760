#pragma once

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <concepts>
#include <optional>
#include <string>

#include "amble/physics/engine.hpp"

namespace amble::cli {

/// Rejects an option with "VALUE: expected a number from LOWER to UPPER", or "a whole number".
template <typename Number>
CLI::Validator between(Number lower, Number upper) {
  const auto error = [lower, upper](const std::string& text) {
    Number value{};
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

/// Check of the length of a trial.
inline CLI::Validator seconds_check() {
  return between(1e-5, 1e6);
}

}  // namespace amble::cli
