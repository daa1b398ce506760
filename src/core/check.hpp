#pragma once

/// @file
/// Conditions that only a programming error can break.

#include <string_view>

namespace amble {

/// A condition that did not hold: a programming error, in amble or in the program that uses it.
struct CheckFailure {
  const char* file;         ///< the source that checks, as __FILE__ has it
  int line;                 ///< in `file`, from 1
  const char* condition;    ///< its source text
  std::string_view detail;  ///< what was expected, in words; valid during the call of the handler
};

/// What happens first when a check fails, in the thread in which it failed. By default "file:line: check
/// failed: condition (detail)" goes to stderr. If a handler returns, the process aborts, as nothing can be
/// relied on; a handler that throws leaves the objects that were being used good for nothing but destruction.
/// What it throws in a worker's thread leaves Run::execute() in the caller's.
using CheckHandler = void (*)(const CheckFailure& failure);
/// Sets the handler of the whole process; null restores the default. Returns the one before. Thread safe.
CheckHandler set_check_handler(CheckHandler handler);

/// Calls the handler, and aborts if it returns. What AMBLE_CHECK calls.
[[noreturn]] void check_failed(const char* file, int line, const char* condition, std::string_view detail);

}  // namespace amble

/// A condition that only a programming error can break. Always on; see set_check_handler().
/// For mistakes of the user see core/error.hpp; diverged physics is an outcome, not an error.
#define AMBLE_CHECK(condition, detail) \
  (static_cast<bool>(condition) ? void() : ::amble::check_failed(__FILE__, __LINE__, #condition, detail))
