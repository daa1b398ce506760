#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "amble/record/recording.hpp"

namespace amble::record {
namespace {

TEST(StandardColumns, AreInTheDocumentedOrder) {
  EXPECT_THAT(standard_columns({"FL.knee", "FL.hip"}, {"FL"}),
              testing::ElementsAre("root.x", "root.y", "root.z", "root.qw", "root.qx", "root.qy", "root.qz",
                                   "com.x", "com.y", "com.z", "angle.FL.knee", "angle.FL.hip",
                                   "target.FL.knee", "target.FL.hip", "touch.FL"));
}

TEST(TorqueColumns, AreOnePerJoint) {
  EXPECT_THAT(torque_columns({"FL.knee", "FL.hip"}), testing::ElementsAre("torque.FL.knee", "torque.FL.hip"));
}

}  // namespace
}  // namespace amble::record
