#pragma once

#include <string_view>

namespace amble {

/// Prints "file:line: check failed: condition (detail)" to stderr and aborts.
[[noreturn]] void check_failed(const char* file, int line, const char* condition, std::string_view detail);

}  // namespace amble

/// A condition that only a programming error can break. Always on; aborts with file and line.
/// For mistakes of the user see core/error.hpp; diverged physics is an outcome, not an error.
#define AMBLE_CHECK(condition, detail) \
  (static_cast<bool>(condition) ? void() : ::amble::check_failed(__FILE__, __LINE__, #condition, detail))
