#include "amble/core/check.hpp"

#include <gtest/gtest.h>

#include <csignal>
#include <cstdio>

#include "amble/core/error.hpp"

namespace amble {
namespace {

TEST(CheckDeathTest, AbortsWithFileLineConditionAndDetail) {
  EXPECT_DEATH(AMBLE_CHECK(1 + 1 == 3, "arithmetic still works"),
               "check_test.cpp:[0-9]+: check failed: 1 \\+ 1 == 3 \\(arithmetic still works\\)");
}

struct Escape {
  int line;
};

TEST(CheckHandler, MayThrowAndTheProcessLives) {
  const CheckHandler before = set_check_handler([](const CheckFailure& failure) {
    EXPECT_STREQ(failure.condition, "1 > 2");
    EXPECT_EQ(failure.detail, "order");
    throw Escape{failure.line};
  });
  int line = 0;
  try {
    line = __LINE__ + 1;
    AMBLE_CHECK(1 > 2, "order");
    ADD_FAILURE() << "a failed check went on";
  } catch (const Escape& escape) {
    EXPECT_EQ(escape.line, line);
  }
  set_check_handler(before);
}

TEST(CheckHandler, IsGivenBackByTheNextAndNullRestoresTheDefault) {
  const CheckHandler own = [](const CheckFailure&) {};
  const CheckHandler before = set_check_handler(own);
  EXPECT_EQ(set_check_handler(nullptr), own);
  EXPECT_EQ(set_check_handler(before), before);
}

TEST(CheckHandlerDeathTest, ThatReturnsIsFollowedByTheEndOfTheProcess) {
  EXPECT_EXIT(
      {
        set_check_handler([](const CheckFailure&) { std::fputs("told to the host", stderr); });
        AMBLE_CHECK(false, "nothing can be relied on");
      },
      testing::KilledBySignal(SIGABRT), "told to the host");
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
