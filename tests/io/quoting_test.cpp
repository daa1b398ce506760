#include "amble/io/quoting.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cstdio>
#include <filesystem>
#include <string>

namespace amble::io {
namespace {

TEST(EscapeXml, LeavesNoMarkup) {
  EXPECT_EQ(escape_xml("a<b> & \"c\" 'd'"), "a&lt;b&gt; &amp; &quot;c&quot; &#39;d&#39;");
}

TEST(EscapeXml, ReplacesControlCharactersAndKeepsLines) {
  EXPECT_EQ(escape_xml("a\x01z\n\t"), "a\uFFFDz\n\t");
}

/// What a shell takes a word for; "" if it is more than one.
std::string read_by(const std::string& shell, const std::string& word) {
  const std::string script = "f() { [ $# = 1 ] && printf %s \"$1\"; }; f " + word;
  const std::string command = shell + " -c " + shell_quoted(script);
  FILE* const pipe = ::popen(command.c_str(), "r");
  std::string text;
  for (int c = 0; (c = std::fgetc(pipe)) != EOF;) text += static_cast<char>(c);
  ::pclose(pipe);
  return text;
}

TEST(ShellWord, IsReadAsItWasWrittenByEveryShellHere) {
  const std::array words{"runs/1",      "my run",    "run$1 & co", "it's", "a'b'c\"d", "$(rm -rf x)",
                         "`id`",        "a;b|c>d<e", "*?[a-z]",    "~/x",  "~",        "#1",
                         "a\\b",        "{a,b}",     "(x)",        "!!",   "x=1",      "  two  ",
                         "läufe/größe", "100%",      "a^b",        "=cat"};
  for (const std::string shell : {"/bin/sh", "/bin/bash", "/usr/bin/zsh"}) {
    if (!std::filesystem::exists(shell)) continue;
    for (const std::string word : words) EXPECT_EQ(read_by(shell, shell_word(word)), word) << shell;
    EXPECT_EQ(read_by(shell, "x" + shell_word("")), "x");
  }
}

TEST(ShellWord, IsPlainWherePlainWillDo) {
  for (const std::string word : {"runs/1", "../a_b-c.toml", "/tmp/x,y", "läufe", "a+b@c:d%e"})
    EXPECT_EQ(shell_word(word), word);
  EXPECT_EQ(shell_word(""), "''");
  EXPECT_EQ(shell_word("my run"), "'my run'");
}

TEST(ShellWord, IsNoOption) {
  EXPECT_EQ(shell_word("-o"), "./-o");
  EXPECT_EQ(shell_word("--my run"), "'./--my run'");
}

TEST(ShellWord, WithControlCharactersIsOneLineThatBashReadsBack) {
  std::string all;
  for (char c = 1; c < 0x20; ++c) all += c;
  for (const std::string& word :
       {std::string("tab\there"), std::string("new\nline"), std::string("runs/a\nb's \\ 1\x7f$x"),
        all + "\x7f", std::string("-\n"), std::string("läufe\n7\r1"),
        std::string("\x01"
                    "23")}) {
    const std::string quoted = shell_word(word);
    EXPECT_EQ(quoted.find_first_of(all + "\x7f"), std::string::npos) << quoted;
    const std::string expected = (word[0] == '-' ? "./" : "") + word;
    for (const std::string shell : {"/bin/bash", "/usr/bin/zsh"}) {
      if (!std::filesystem::exists(shell)) continue;
      EXPECT_EQ(read_by(shell, quoted), expected) << shell << quoted;
    }
  }
  EXPECT_EQ(shell_word("a\nb"), "$'a\\nb'");
}

}  // namespace

}  // namespace amble::io
