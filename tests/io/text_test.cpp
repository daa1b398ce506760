#include "amble/io/text.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <span>
#include <string>
#include <vector>

namespace amble::io {
namespace {

using testing::ElementsAre;

TEST(Trimmed, LosesBlanksAtItsEndsAlone) {
  EXPECT_EQ(trimmed(" \ta b\t "), "a b");
  EXPECT_EQ(trimmed("a"), "a");
  EXPECT_EQ(trimmed(" \t"), "");
  EXPECT_EQ(trimmed(""), "");
  EXPECT_EQ(trimmed("a\n"), "a\n");
  EXPECT_EQ(trimmed("a\r\n", " \r\n"), "a");
}

TEST(Split, GivesOnePartMoreThanThereAreSeparators) {
  EXPECT_THAT(split("a,bc,d", ','), ElementsAre("a", "bc", "d"));
  EXPECT_THAT(split("a/b", ','), ElementsAre("a/b"));
  EXPECT_THAT(split(",a,,", ','), ElementsAre("", "a", "", ""));
  EXPECT_THAT(split("", ','), ElementsAre(""));
}

TEST(FirstFew, NamesAllOfAShortListAndCountsTheRestOfALongOne) {
  const std::vector<std::string> names{"a", "b", "c", "d", "e", "f", "g"};
  EXPECT_EQ(first_few({}), "");
  EXPECT_EQ(first_few(std::span(names).first(6)), "a, b, c, d, e, f");
  EXPECT_EQ(first_few(names), "a, b, c, d and 3 more");
}

const std::vector<std::string> commands{"evolve", "resume", "repertoire", "report", "info", "view"};

TEST(Spelling, CountsTheFewestEdits) {
  EXPECT_EQ(edit_distance("kitten", "sitting"), 3u);
  EXPECT_EQ(edit_distance("", "abc"), 3u);
  EXPECT_EQ(edit_distance("gait", "gait"), 0u);
}

TEST(Spelling, FindsTheWordThatWasMeant) {
  EXPECT_EQ(nearest_word("evole", commands), "evolve");
  EXPECT_EQ(nearest_word("repotr", commands), "report");
  EXPECT_EQ(nearest_word("sed", std::vector<std::string>{"set", "seed"}), "seed") << "as it ends";
  EXPECT_EQ(nearest_word("vew", commands), "view");
  EXPECT_EQ(nearest_word("reper", commands), "repertoire") << "a beginning";
  EXPECT_EQ(did_you_mean("rsume", commands), " (did you mean 'resume'?)");
}

TEST(Spelling, FindsNothingWhereNoWordIsNear) {
  EXPECT_EQ(nearest_word("dance", commands), "");
  EXPECT_EQ(nearest_word("", commands), "");
  EXPECT_EQ(nearest_word("x", std::vector<std::string>{"y"}), "") << "all of it would be replaced";
  EXPECT_EQ(did_you_mean("dance", commands), "");
}

}  // namespace

}  // namespace amble::io
