#pragma once

#include <string>

#include "amble/core/error.hpp"

namespace amble::tests {

/// The message of the UserError that `function` throws, or "no error".
template <typename Function>
std::string error_of(Function function) {
  try {
    function();
  } catch (const UserError& error) {
    return error.what();
  }
  return "no error";
}

}  // namespace amble::tests
