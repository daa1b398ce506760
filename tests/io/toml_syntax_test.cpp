#include <gtest/gtest.h>

#include "amble/io/file.hpp"
#include "amble/io/toml_settings.hpp"
#include "tests/io/expect_error.hpp"
#include "tests/io/temporary_folder.hpp"

namespace amble::io {
namespace toml_syntax_test {

using test::error_of;

std::string refusal(const std::string& text) {
  return error_of(ExitCode::bad_input, [&] { TomlDocument::parse(text, "x.toml"); });
}

TEST(TomlSyntax, ErrorsNameFileLineAndColumn) {
  EXPECT_EQ(refusal("a = 1\nb = \n"),
            "x.toml:2:5: TOML syntax error: Error while parsing key-value pair: expected value, saw '\\n'");
  EXPECT_EQ(refusal("a = 1\na = 2\n"),
            "x.toml:2:5: TOML syntax error: Error while parsing key-value pair: cannot redefine existing "
            "integer 'a'");
  EXPECT_EQ(refusal("[a\n"),
            "x.toml:1:3: TOML syntax error: Error while parsing table header: expected ']', saw '\\n'");
  EXPECT_EQ(refusal("\n <mujoco>\n"),
            "x.toml: XML, perhaps a robot's model; expected TOML: `amble robot --init MODEL` makes a config "
            "for a model");
  EXPECT_EQ(refusal("a = \"\xff\"\n"), "x.toml:1:5: TOML syntax error: Encountered invalid utf-8 sequence");
}

TEST(TomlSyntax, DeepNestingIsRefusedWithoutCrashing) {
  const auto repeated = [](const std::string& text, std::size_t count) {
    std::string result;
    for (std::size_t i = 0; i < count; ++i) result += text;
    return result;
  };
  for (const std::size_t depth : {std::size_t{17}, std::size_t{300000}}) {
    EXPECT_EQ(refusal("\na = " + repeated("[", depth)), "x.toml:2: nested more than 16 levels deep");
    EXPECT_EQ(refusal("a = " + repeated("{a=", depth)), "x.toml:1: nested more than 16 levels deep");
    EXPECT_EQ(refusal(repeated("a.", depth) + "b = 1"), "x.toml:1: nested more than 16 levels deep");
    EXPECT_EQ(refusal("[" + repeated("a . ", depth) + "b]"), "x.toml:1: nested more than 16 levels deep");
    EXPECT_EQ(refusal("x = [\"\"\"\n\"#\"\"\"\"\", {" + repeated("\"a#\".", depth) + "b = 1}]"),
              "x.toml:2: nested more than 16 levels deep");
  }
}

TEST(TomlSyntax, DotsAndBracketsInTextsCommentsAndListsAreNotNesting) {
  const std::string many(40, '.'), brackets(40, '[');
  const std::string text =
      "# " + many + brackets + "\na = \"" + many + brackets + "\\\"" + brackets + "\" # " + many + "\nb = '" +
      brackets + "\\'\nc = \"\"\"" + many + "\n\"\"" + brackets + "\"\"\"\nd = '''" + many + "'\n" +
      brackets +
      "'''\ne = [1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0, 8.0, 9.0, 1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0, 8.0]\n";
  EXPECT_NO_THROW(TomlDocument::parse(text, "x.toml"));
}

TEST(TomlSyntax, FilesThatCannotBeConfigsAreRefused) {
  const test::TemporaryFolder folder;
  const std::string missing = (folder / "no.toml").string();
  EXPECT_EQ(error_of(ExitCode::io, [&] { TomlDocument::read(missing); }),
            missing + ": No such file or directory");
  const std::string large = folder.put("large.toml", std::string((1 << 20) + 1, ' ')).string();
  EXPECT_EQ(error_of(ExitCode::io, [&] { TomlDocument::read(large); }),
            large + ": larger than 1048576 bytes");
}

TEST(TomlSyntax, SixteenLevelsAreAccepted) {
  const auto repeated = [](const std::string& text, std::size_t count) {
    std::string result;
    for (std::size_t i = 0; i < count; ++i) result += text;
    return result;
  };
  const auto accepted = [](const std::string& text) {
    EXPECT_NO_THROW(TomlDocument::parse(text, "x.toml")) << text;
  };
  accepted("a = " + repeated("[", 16) + repeated("]", 16));
  accepted("a = " + repeated("{a=", 16) + "1" + repeated("}", 16));
  accepted(repeated("a.", 16) + "b = 1");
  accepted("[" + repeated("a.", 16) + "b]\nc = 1");
  accepted(repeated("a.", 16) + "b = 1\nb." + repeated("a.", 15) + "b = 1");
}

}  // namespace toml_syntax_test
}  // namespace amble::io
