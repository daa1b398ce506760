#include "amble/watch/lock_holders.hpp"

#include <gtest/gtest.h>

#include <memory>

#include "amble/io/lock.hpp"
#include "tests/io/temporary_folder.hpp"

namespace amble::watch {
namespace {

TEST(LockHolders, KnowWhetherAFolderIsInUseWithoutTouchingItsLock) {
  const test::TemporaryFolder folder;
  EXPECT_FALSE(LockHolders::now().hold(folder.path()));
  auto lock = std::make_unique<io::FolderLock>(folder.path());
  EXPECT_TRUE(LockHolders::now().hold(folder.path()));
  lock.reset();
  EXPECT_FALSE(LockHolders::now().hold(folder.path()));
}

}  // namespace
}  // namespace amble::watch
