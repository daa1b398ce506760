#include "amble/serving/access.hpp"

#include <gtest/gtest.h>

#include <set>
#include <string>

namespace amble::serving {
namespace {

TEST(Access, AHostIsThisComputerByThreeNamesAlone) {
  for (const char* host :
       {"localhost", "LOCALHOST:8080", "127.0.0.1", "127.0.0.1:8080", "[::1]", "[::1]:8080"})
    EXPECT_TRUE(names_loopback(host)) << host;
  for (const char* host :
       {"", "evil.example", "localhost.evil.example", "127.0.0.1.evil.example:80", "127.0.0.2",
        "evil.example:127.0.0.1", "localhost:", "localhost:8080:1", "::1", "[::1]x", "0.0.0.0"})
    EXPECT_EQ(names_loopback(host), std::string(host) == "localhost:") << host;
}

TEST(Access, TokensAreLongAndNeverTheSame) {
  std::set<std::string> seen;
  for (int i = 0; i < 100; ++i) {
    const std::string token = random_token();
    EXPECT_EQ(token.size(), 32U);
    EXPECT_EQ(token.find_first_not_of("0123456789abcdef"), std::string::npos);
    EXPECT_TRUE(seen.insert(token).second);
  }
}

TEST(Access, ATokenIsTheSameOnlyIfAllOfItIs) {
  EXPECT_TRUE(same_token("abcd", "abcd"));
  for (const char* other : {"", "abc", "abcde", "abcx", "xbcd", "abcdabcd", "ABCD"})
    EXPECT_FALSE(same_token("abcd", other)) << other;
}

TEST(Access, ACookieIsFoundByItsWholeName) {
  EXPECT_EQ(cookie("a=1; amble-80=xyz; b=2", "amble-80"), "xyz");
  EXPECT_EQ(cookie("amble-80=xyz", "amble-80"), "xyz");
  EXPECT_EQ(cookie("amble-8080=xyz", "amble-80"), "");
  EXPECT_EQ(cookie("x-amble-80=xyz", "amble-80"), "");
  EXPECT_EQ(cookie("", "amble-80"), "");
}

}  // namespace
}  // namespace amble::serving
