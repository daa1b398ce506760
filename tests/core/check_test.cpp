#include "amble/core/check.hpp"

#include <gtest/gtest.h>

#include "amble/core/error.hpp"

namespace amble {
namespace {

TEST(CheckDeathTest, AbortsWithFileLineConditionAndDetail) {
  EXPECT_DEATH(AMBLE_CHECK(1 + 1 == 3, "arithmetic still works"),
               "check_test.cpp:[0-9]+: check failed: 1 \\+ 1 == 3 \\(arithmetic still works\\)");
}

TEST(UserError, CarriesItsTextAndExitCode) {
  try {
    fail(ExitCode::io, "cannot read {}: {}", "a.toml", "no such file");
  } catch (const UserError& error) {
    EXPECT_STREQ(error.what(), "cannot read a.toml: no such file");
    EXPECT_EQ(error.code(), ExitCode::io);
  }
}

}  // namespace
}  // namespace amble
