#pragma once

#include <gtest/gtest.h>
#include <hwy/highway.h>

namespace amble::cppn {

/// Runs `body` once for each instruction set that is both compiled and supported by this CPU, with dispatch
/// forced to it.
template <typename Body>
void for_each_target(Body body) {
  for (const std::int64_t target : hwy::SupportedAndGeneratedTargets()) {
    SCOPED_TRACE(hwy::TargetName(target));
    hwy::SetSupportedTargetsForTest(target);
    body();
  }
  hwy::SetSupportedTargetsForTest(0);
}

}  // namespace amble::cppn
