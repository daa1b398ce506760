#include "amble/experiment/memory_need.hpp"

#include <gtest/gtest.h>

#include <fstream>
#include <string>

namespace amble::experiment {
namespace {

namespace fs = std::filesystem;

/// Control groups as they look in the file system; the process is in slice/run.
class UsableMemory : public testing::Test {
 protected:
  UsableMemory()
      : folder_(fs::path(testing::TempDir()) /
                testing::UnitTest::GetInstance()->current_test_info()->name()) {
    fs::create_directories(folder_ / "slice/run");
    write("process", "4:memory:/elsewhere\n0::/slice/run\n");
  }
  ~UsableMemory() override { fs::remove_all(folder_); }

  void write(const std::string& name, const std::string& text) { std::ofstream(folder_ / name) << text; }
  double usable() const { return usable_memory_bytes(folder_ / "process", folder_); }

  fs::path folder_;
  double machine_ = usable_memory_bytes("absent", "absent");
};

TEST_F(UsableMemory, IsFourFifthsOfTheMachinesWithoutALimit) {
  EXPECT_GT(machine_, 1e8);
  EXPECT_EQ(usable(), machine_);
  write("slice/run/memory.max", "max\n");
  EXPECT_EQ(usable(), machine_);
}

TEST_F(UsableMemory, IsFourFifthsOfTheLeastLimitFromItsGroupUpwards) {
  write("slice/run/memory.max", "50000000\n");
  EXPECT_EQ(usable(), 4e7);
  write("slice/memory.max", "30000000\n");
  EXPECT_EQ(usable(), 2.4e7);
  write("memory.max", "20000000\n");
  EXPECT_EQ(usable(), 1.6e7);
  write("memory.max", "max\n");
  EXPECT_EQ(usable(), 2.4e7);
}

TEST_F(UsableMemory, IsOfTheTopmostGroupInAContainer) {
  write("process", "0::/\n");
  write("memory.max", "20000000\n");
  EXPECT_EQ(usable(), 1.6e7);
}

TEST_F(UsableMemory, IsNoMoreThanTheMachineHas) {
  write("slice/run/memory.max", "9000000000000000000\n");
  EXPECT_EQ(usable(), machine_);
}

}  // namespace
}  // namespace amble::experiment
