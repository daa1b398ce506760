#include <gtest/gtest.h>

#include "amble/io/toml_settings.hpp"
#include "tests/io/expect_error.hpp"
#include "tests/io/sample_settings.hpp"
#include "tests/io/temporary_folder.hpp"

namespace amble::io {
namespace {

using test::error_of;
using test::Sample;

Sample sample_from(const TomlDocument& document) {
  Sample sample;
  const auto reader = document.reader();
  sample.describe(*reader);
  reader->finish();
  return sample;
}

TEST(TomlInclude, LaterFilesAndTheDocumentItselfOverrideKeyByKey) {
  const test::TemporaryFolder folder;
  folder.put("parts/a.toml", "population = 10\nname = 'a'\n[inner]\nrate = 0.1\nseed = 10\n");
  folder.put("parts/b.toml", "name = 'b'\nelitism = false\n[inner]\nseed = 20\n[outer.deep]\nseed = 7\n");
  const auto top =
      folder.put("top/x.toml", "include = ['../parts/a.toml', '../parts/b.toml']\nelitism = true\n");
  const TomlDocument document = TomlDocument::read(top);
  const Sample sample = sample_from(document);
  EXPECT_EQ(sample.population, 10);
  EXPECT_EQ(sample.name, "b");
  EXPECT_TRUE(sample.elitism);
  EXPECT_EQ(sample.inner.rate, 0.1);
  EXPECT_EQ(sample.inner.seed, 20);
  EXPECT_EQ(sample.deep.seed, 7);
  EXPECT_EQ(sample.deep.rate, 0.25) << "a missing key keeps its value";

  const std::string parts = (folder / "parts").string();
  EXPECT_EQ(document.where("population"), parts + "/a.toml:1");
  EXPECT_EQ(document.where("inner.seed"), parts + "/b.toml:4");
  EXPECT_EQ(document.where("elitism"), top.string() + ":2");
  EXPECT_EQ(document.where("colour"), top.string());
  using Keys = std::vector<std::string>;
  EXPECT_EQ(document.where(Keys{"colour", "population", "elitism"}), top.string() + ":2") << "its own first";
  EXPECT_EQ(document.where(Keys{"colour", "population", "inner.seed"}), parts + "/a.toml:1");
  EXPECT_EQ(document.where(Keys{"colour", "hue"}), top.string());
  EXPECT_EQ(document.folder_of("inner.seed"), folder / "parts");
  EXPECT_EQ(document.folder_of("colour"), folder / "top");
}

TEST(TomlInclude, IsReadWithinIncludedFilesAndMayMeetTwice) {
  const test::TemporaryFolder folder;
  folder.put("base.toml", "population = 10\nname = 'base'\n");
  folder.put("a.toml", "include = ['base.toml']\nname = 'a'\n");
  folder.put("b.toml", "include = ['base.toml']\n");
  EXPECT_EQ(sample_from(TomlDocument::read(folder.put("x.toml", "include = ['b.toml', 'a.toml']"))).name,
            "a");
  EXPECT_EQ(sample_from(TomlDocument::read(folder.put("x.toml", "include = ['a.toml', 'b.toml']"))).name,
            "base");
}

TEST(TomlInclude, ErrorsNameTheFileThatContainsTheKey) {
  const test::TemporaryFolder folder;
  const std::string part = folder.put("part.toml", "\n\npopulation = 1\n").string();
  const TomlDocument document = TomlDocument::read(folder.put("x.toml", "include = ['part.toml']"));
  EXPECT_EQ(error_of(ExitCode::bad_input, [&] { sample_from(document); }),
            part + ":3: 'population' = 1: expected a whole number from 2 to 1000000");
}

TEST(TomlInclude, RefusesCircles) {
  const test::TemporaryFolder folder;
  const std::string a = folder.put("a.toml", "include = ['b.toml']").string();
  const std::string b = folder.put("b.toml", "\ninclude = ['a.toml']").string();
  EXPECT_EQ(error_of(ExitCode::bad_input, [&] { TomlDocument::read(a); }),
            b + ":2: 'include' = [\"a.toml\"]: the files include each other in a circle: " + a + " -> " + b +
                " -> " + a);
}

TEST(TomlInclude, RefusesWhatIsNoListOfFiles) {
  const test::TemporaryFolder folder;
  const std::string x = (folder / "x.toml").string();
  const auto refusal = [&](ExitCode code, const std::string& text) {
    folder.put("x.toml", text);
    return error_of(code, [&] { TomlDocument::read(x); });
  };
  EXPECT_EQ(refusal(ExitCode::bad_input, "include = 'a.toml'"),
            x + ":1: 'include' = \"a.toml\": expected a list of file names in quotes");
  EXPECT_EQ(refusal(ExitCode::bad_input, "include = [1]"),
            x + ":1: 'include' = [1]: expected a list of file names in quotes");
  EXPECT_EQ(
      refusal(ExitCode::io, "include = ['no.toml']"),
      x + ":1: 'include' = [\"no.toml\"]: " + (folder / "no.toml").string() + ": No such file or directory");
  EXPECT_EQ(refusal(ExitCode::bad_input, "include = ['/dev/zero']"),
            x + ":1: 'include' = [\"/dev/zero\"]: /dev/zero is not a regular file");
}

TEST(TomlInclude, RefusesFilesThatMultiply) {
  const test::TemporaryFolder folder;
  folder.put("0.toml", "");
  for (int i = 1; i <= 30; ++i) {
    const std::string part = std::to_string(i - 1) + ".toml";
    folder.put(std::to_string(i) + ".toml", "include = ['" + part + "', '" + part + "']");
  }
  const std::string message = error_of(ExitCode::bad_input, [&] { TomlDocument::read(folder / "30.toml"); });
  EXPECT_NE(message.find("more than 100 files are included"), std::string::npos) << message;
}

TEST(TomlInclude, TakesAHundredFilesAndNoMore) {
  const test::TemporaryFolder folder;
  folder.put("part.toml", "");
  const auto text = [](int files) {
    std::string list;
    for (int i = 0; i < files; ++i) list += "'part.toml', ";
    return "include = [" + list + "]\nname = 'x'\n";
  };
  EXPECT_EQ(sample_from(TomlDocument::read(folder.put("x.toml", text(100)))).name, "x");
  const auto path = folder.put("x.toml", text(101));
  const std::string message = error_of(ExitCode::bad_input, [&] { TomlDocument::read(path); });
  EXPECT_NE(message.find("more than 100 files are included"), std::string::npos) << message;
}

TEST(TomlSet, OverridesAndMakesTables) {
  TomlDocument document = TomlDocument::parse("population = 5\n[inner]\nrate = 0.5\n", "conf/x.toml");
  document.set("population=6");
  document.set("inner.seed=-4");
  document.set("outer.deep.rate=1");
  document.set("name=two words");
  document.set("colour=blue");
  document.set("weights=[1, 2]");
  document.set("legs=['a', \"b\"]");
  document.set("friction=inf");
  const Sample sample = sample_from(document);
  EXPECT_EQ(sample.population, 6);
  EXPECT_EQ(sample.inner.seed, -4);
  EXPECT_EQ(sample.inner.rate, 0.5);
  EXPECT_EQ(sample.deep.rate, 1.0);
  EXPECT_EQ(sample.name, "two words");
  EXPECT_EQ(sample.colour, test::Colour::blue);
  EXPECT_EQ(sample.weights, (std::vector<double>{1.0, 2.0}));
  EXPECT_EQ(sample.legs, (std::vector<std::string>{"a", "b"}));
  EXPECT_EQ(document.where("population"), "--set population=6");
  EXPECT_EQ(document.where(std::vector<std::string>{"inner.rate", "population"}), "--set population=6");
  EXPECT_EQ(document.where("inner.rate"), "conf/x.toml:3");
  EXPECT_EQ(document.folder_of("population"), "");
  EXPECT_EQ(document.folder_of("inner.rate"), "conf");
}

TEST(TomlDocument, SaysWhereAnItemOfAListIsWhenAKeyOfItIsMissing) {
  const auto document = TomlDocument::parse("[a]\nnodes = [\n  {x = 1},\n  {x = 2, y = [3]},\n]\n", "c.toml");
  EXPECT_EQ(document.where("a.nodes[1].x"), "c.toml:4");
  EXPECT_EQ(document.where("a.nodes[1].name"), "c.toml:4");
  EXPECT_EQ(document.where("a.nodes[1].y[7]"), "c.toml:4");
  EXPECT_EQ(document.where("a.nodes[9].name"), "c.toml:2");
  EXPECT_EQ(document.where("a.links[0].from"), "c.toml");
  EXPECT_EQ(document.where("[]"), "c.toml");
  EXPECT_EQ(document.where(""), "c.toml");
}

TEST(TomlSet, LastOneHolds) {
  TomlDocument document = TomlDocument::parse("", "x.toml");
  document.set("population=6");
  document.set("population=7");
  EXPECT_EQ(sample_from(document).population, 7);
}

TEST(TomlSet, QuotedWordIsTextEvenIfItLooksLikeANumber) {
  TomlDocument document = TomlDocument::parse("", "x.toml");
  document.set("name=\"5\"");
  EXPECT_EQ(sample_from(document).name, "5");
}

TEST(TomlSet, ErrorsQuoteTheCommandLine) {
  const auto refusal = [](const std::string& assignment) {
    return error_of(ExitCode::bad_input, [&] {
      TomlDocument document = TomlDocument::parse("", "x.toml");
      document.set(assignment);
      sample_from(document);
    });
  };
  EXPECT_EQ(refusal("population=abc"), "--set population=abc: expected a whole number from 2 to 1000000");
  EXPECT_EQ(refusal("population=1"), "--set population=1: expected a whole number from 2 to 1000000");
  EXPECT_EQ(refusal("inner.rate=inf"), "--set inner.rate=inf: expected a number from 0 to 1");
  EXPECT_EQ(refusal("inner=3"), "--set inner=3: expected a table [inner]");
  EXPECT_EQ(refusal("name=5"), "--set name=5: expected text in quotes");
  EXPECT_EQ(refusal("inner.rat=5"),
            "--set inner.rat=5: unknown key 'inner.rat' (did you mean 'inner.rate'?)");
  EXPECT_EQ(refusal("include=x.toml"), "--set include=x.toml: unknown key 'include'");
  for (const std::string bad : {"population", "population=", "=5", ".a=5", "a.=5", "a b=5", ""}) {
    EXPECT_EQ(refusal(bad), "--set " + bad + ": expected KEY.PATH=VALUE");
  }
  for (const std::string bad : {"weights=[1,", "name=[a", "name={", "name={a=1", "name='a", "name=\"a"})
    EXPECT_EQ(refusal(bad), "--set " + bad + ": the value is not valid TOML");
  EXPECT_EQ(refusal("name=a\xff"), "--set name=a\xff: the value is not valid UTF-8");
  EXPECT_EQ(refusal("population=5\nname=3"),
            "--set population=5\\x0aname=3: expected a whole number from 2 to 1000000");
}

}  // namespace
}  // namespace amble::io
