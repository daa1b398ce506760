#include "amble/io/base64.hpp"

#include <gtest/gtest.h>

#include <random>

namespace amble::io {
namespace {

TEST(Base64, EncodesTheExamplesOfRfc4648) {
  EXPECT_EQ(base64(""), "");
  EXPECT_EQ(base64("f"), "Zg==");
  EXPECT_EQ(base64("fo"), "Zm8=");
  EXPECT_EQ(base64("foo"), "Zm9v");
  EXPECT_EQ(base64("foob"), "Zm9vYg==");
  EXPECT_EQ(base64("fooba"), "Zm9vYmE=");
  EXPECT_EQ(base64("foobar"), "Zm9vYmFy");
}

/// Bit by bit.
std::string slow_decoded(const std::string& text) {
  const std::string digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string bytes;
  int bits = 0, value = 0;
  for (const char c : text) {
    if (c == '=') break;
    const auto digit = static_cast<int>(digits.find(c));
    for (int bit = 5; bit >= 0; --bit) {
      value = value << 1 | (digit >> bit & 1);
      if (++bits % 8 == 0) {
        bytes += static_cast<char>(value);
        value = 0;
      }
    }
  }
  return bytes;
}

TEST(Base64, GivesBackAnyBytes) {
  std::minstd_rand random(1);
  for (std::size_t length = 0; length < 500; ++length) {
    std::string bytes;
    for (std::size_t i = 0; i < length; ++i) bytes += static_cast<char>(random() % 256);
    const std::string text = base64(bytes);
    EXPECT_EQ(text.size() % 4, 0u);
    EXPECT_EQ(slow_decoded(text), bytes);
    EXPECT_EQ(from_base64(text), bytes);
  }
}

TEST(Base64, RefusesWhatItDoesNotWrite) {
  for (const char* text : {"Zg", "Zg=", "Z===", "====", "Zg==Zg==", "Zh==", "Zm9=", "Zm 9", "Zm9-", "=Zg="})
    EXPECT_EQ(from_base64(text), std::nullopt) << text;
}

}  // namespace
}  // namespace amble::io
