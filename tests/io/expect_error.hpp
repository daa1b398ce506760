#pragma once

#include <gtest/gtest.h>

#include <string>

#include "amble/core/error.hpp"

namespace amble::test {

/// The text of the UserError that `action` must throw, after checking its exit code.
template <typename Action>
std::string error_of(ExitCode code, Action&& action) {
  try {
    action();
  } catch (const UserError& error) {
    EXPECT_EQ(error.code(), code) << error.what();
    return error.what();
  }
  ADD_FAILURE() << "nothing was thrown";
  return {};
}

}  // namespace amble::test
