#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "amble/physics/engine.hpp"
#include "tests/core/error_of.hpp"

namespace amble::tests {
namespace {

// This program links the batch engine alone.
TEST(EnginesByLinking, AProgramHasNoOtherThanThoseThatItLinks) {
  EXPECT_THAT(physics::engine_names(), testing::ElementsAre("batch"));
  EXPECT_EQ(error_of([] { physics::check_engine_name("ode"); }),
            "the engine 'ode' is not in this program: link amble::physics_ode");
}

}  // namespace
}  // namespace amble::tests
