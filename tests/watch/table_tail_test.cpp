#include "amble/watch/table_tail.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <string>

#include "tests/io/temporary_folder.hpp"

namespace amble::watch {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

class Tail : public testing::Test {
 protected:
  void append(const std::string& text) const { std::ofstream(path_, std::ios::app) << text; }
  void cut_to(std::uintmax_t bytes) const { std::filesystem::resize_file(path_, bytes); }

  test::TemporaryFolder scratch_;
  std::filesystem::path path_ = scratch_ / "generations.csv";
  TableTail tail_{path_};
};

TEST_F(Tail, GivesEachLineOnce) {
  EXPECT_THAT(tail_.poll().lines, IsEmpty());
  append("a,b\n0,1\n");
  auto growth = tail_.poll();
  EXPECT_TRUE(growth.anew);
  EXPECT_THAT(growth.lines, ElementsAre("a,b", "0,1"));
  EXPECT_THAT(tail_.poll().lines, IsEmpty());
  append("1,2\n2,3\n");
  growth = tail_.poll();
  EXPECT_FALSE(growth.anew);
  EXPECT_THAT(growth.lines, ElementsAre("1,2", "2,3"));
}

TEST_F(Tail, WaitsForTheEndOfALine) {
  append("a,b\n0,");
  EXPECT_THAT(tail_.poll().lines, ElementsAre("a,b"));
  append("1");
  EXPECT_THAT(tail_.poll().lines, IsEmpty());
  append("\n");
  EXPECT_THAT(tail_.poll().lines, ElementsAre("0,1"));
}

TEST_F(Tail, BeginsAnewWithATableThatWasCutBack) {
  append("a,b\n0,1\n1,2\n");
  tail_.poll();
  cut_to(8);
  const auto growth = tail_.poll();
  EXPECT_TRUE(growth.anew);
  EXPECT_THAT(growth.lines, ElementsAre("a,b", "0,1"));
}

TEST_F(Tail, BeginsAnewWithATableThatWasCutBackAndHasGrownSince) {
  append("a,b\n0,1\n1,2\n");
  tail_.poll();
  cut_to(8);
  append("1,9\n2,3\n");
  const auto growth = tail_.poll();
  EXPECT_TRUE(growth.anew);
  EXPECT_THAT(growth.lines, ElementsAre("a,b", "0,1", "1,9", "2,3"));
}

TEST_F(Tail, BeginsAnewWithAnotherTable) {
  append("a,b\n0,1\n");
  tail_.poll();
  std::filesystem::rename(path_, scratch_ / "old");
  EXPECT_THAT(tail_.poll().lines, IsEmpty());
  append("a,b\n0,1\n1,1\n");
  const auto growth = tail_.poll();
  EXPECT_TRUE(growth.anew);
  EXPECT_THAT(growth.lines, ElementsAre("a,b", "0,1", "1,1"));
}

}  // namespace
}  // namespace amble::watch
