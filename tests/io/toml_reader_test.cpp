#include <fmt/format.h>
#include <gtest/gtest.h>

#include <limits>

#include "amble/io/quoting.hpp"
#include "amble/io/toml_settings.hpp"
#include "tests/io/expect_error.hpp"
#include "tests/io/sample_settings.hpp"

namespace amble::io {
namespace {

using test::error_of;
using test::Sample;

Sample sample_from(const std::string& text) {
  const TomlDocument document = TomlDocument::parse(text, "configs/x.toml");
  Sample sample;
  const auto reader = document.reader();
  sample.describe(*reader);
  reader->finish();
  return sample;
}

std::string refusal(const std::string& text) {
  return error_of(ExitCode::bad_input, [&] { sample_from(text); });
}

TEST(TomlReader, ReadsEveryKindAndKeepsWhatIsMissing) {
  const Sample sample = sample_from(
      "name = 'x'\nfriction = 3 # whole numbers will do\nelitism = false\ncolour = \"red\"\nweights = [1, "
      "-0.5]\nlegs = []\n"
      "inner.seed = -9223372036854775808\n[outer]\ndeep = {rate = 1}\n");
  EXPECT_EQ(sample.name, "x");
  EXPECT_EQ(sample.friction, 3.0);
  EXPECT_FALSE(sample.elitism);
  EXPECT_EQ(sample.colour, test::Colour::red);
  EXPECT_EQ(sample.weights, (std::vector<double>{1.0, -0.5}));
  EXPECT_TRUE(sample.legs.empty());
  EXPECT_EQ(sample.inner.seed, std::numeric_limits<std::int64_t>::min());
  EXPECT_EQ(sample.deep.rate, 1.0);
  EXPECT_EQ(sample.population, 300);
  EXPECT_EQ(sample_from("friction = inf").friction, std::numeric_limits<double>::infinity());
}

struct Shape {
  std::string kind = "box";
  double size = 1.0;
  std::vector<std::string> corners = {};
  void describe(SettingsVisitor& visitor) {
    visitor.text("kind", kind, {""});
    visitor.number("size", size, {0.0, 9.0}, {""});
    visitor.texts("corners", corners, {""});
  }
};

/// Reads [shape], for which a text is short, after these assignments of the command line.
Shape shape_from(const std::string& text, const std::vector<std::string>& assignments = {}) {
  TomlDocument document = TomlDocument::parse(text, "x.toml");
  for (const std::string& assignment : assignments) document.set(assignment);
  Shape shape;
  const auto reader = document.reader();
  reader->table("shape", shape, {.what = "", .short_for = "kind"});
  reader->finish();
  return shape;
}

TEST(TomlReader, TakesATextForATableWithThatKeyAloneWhereItIsShortForOne) {
  EXPECT_EQ(shape_from("shape = 'ball'").kind, "ball");
  EXPECT_EQ(shape_from("shape = 'ball'").size, 1.0);
  EXPECT_EQ(shape_from("shape = {kind = 'ball', size = 2}").size, 2.0);
  EXPECT_EQ(shape_from("").kind, "box");
  EXPECT_EQ(error_of(ExitCode::bad_input, [&] { shape_from("shape = 3"); }),
            "x.toml:1: 'shape' = 3: expected a table [shape]");
  EXPECT_EQ(error_of(ExitCode::bad_input, [&] { shape_from("shape = 'ball'\ncolour = 'red'"); }),
            "x.toml:2: unknown key 'colour'");
  EXPECT_EQ(refusal("inner = 'x'"), "configs/x.toml:1: 'inner' = \"x\": expected a table [inner]");
}

TEST(TomlReader, KeepsAllButTheListsOfATableThatATextFromTheCommandLineReplaces) {
  const std::string file = "shape = {kind = 'box', size = 2, corners = ['a', 'b']}";
  const Shape shape = shape_from(file, {"shape=ball"});
  EXPECT_EQ(shape.kind, "ball");
  EXPECT_EQ(shape.size, 2.0);
  EXPECT_TRUE(shape.corners.empty());
  EXPECT_EQ(shape_from(file, {"shape=ball", "shape.size=3"}).size, 3.0);
  EXPECT_EQ(shape_from("shape = 'ball'", {"shape.size=3"}).size, 3.0) << "beside a text of the file, too";
  EXPECT_EQ(shape_from("shape = 'ball'", {"shape.size=3"}).kind, "ball");
  EXPECT_EQ(error_of(ExitCode::bad_input, [&] { shape_from("shape = 'ball'", {"shape.sise=3"}); }),
            "--set shape.sise=3: unknown key 'shape.sise' (did you mean 'shape.size'?)");
  EXPECT_EQ(error_of(ExitCode::bad_input, [&] { shape_from("colour = 'red'", {"colour.hue=3"}); }),
            "x.toml:1: unknown key 'colour'");
}

TEST(TomlReader, RefusesWrongTypes) {
  EXPECT_EQ(refusal("\n\npopulation = \"many\""),
            "configs/x.toml:3: 'population' = \"many\": expected a whole number from 2 to 1000000");
  EXPECT_EQ(refusal("population = 3.0"),
            "configs/x.toml:1: 'population' = 3.0: expected a whole number from 2 to 1000000");
  EXPECT_EQ(refusal("inner.seed = true"), "configs/x.toml:1: 'inner.seed' = true: expected a whole number");
  EXPECT_EQ(refusal("[inner]\nrate = '0.5'"),
            "configs/x.toml:2: 'inner.rate' = \"0.5\": expected a number from 0 to 1");
  EXPECT_EQ(refusal("elitism = 1"), "configs/x.toml:1: 'elitism' = 1: expected true or false");
  EXPECT_EQ(refusal("name = 2013-07-06"), "configs/x.toml:1: 'name' = 2013-07-06: expected text in quotes");
  EXPECT_EQ(refusal("name = 07:32:00"), "configs/x.toml:1: 'name' = 07:32:00: expected text in quotes");
  EXPECT_EQ(refusal("name = 2013-07-06T07:32:00Z"),
            "configs/x.toml:1: 'name' = 2013-07-06T07:32:00Z: expected text in quotes");
  EXPECT_EQ(refusal("colour = 'pink'"),
            "configs/x.toml:1: 'colour' = \"pink\": expected one of \"red\", \"green\", \"blue\"");
  EXPECT_EQ(refusal("colour = 1"),
            "configs/x.toml:1: 'colour' = 1: expected one of \"red\", \"green\", \"blue\"");
  EXPECT_EQ(refusal("weights = 1"),
            "configs/x.toml:1: 'weights' = 1: expected a list of numbers from -10 to 10");
  EXPECT_EQ(refusal("weights = [1, 'a', {b = 1}]"),
            "configs/x.toml:1: 'weights' = [1, \"a\", {...}]: expected a list of numbers from -10 to 10");
  EXPECT_EQ(refusal("legs = ['FL', 1]"),
            "configs/x.toml:1: 'legs' = [\"FL\", 1]: expected a list of texts in quotes");
  EXPECT_EQ(refusal("inner = 1"), "configs/x.toml:1: 'inner' = 1: expected a table [inner]");
  EXPECT_EQ(refusal("[[inner]]\nrate = 1"), "configs/x.toml:1: 'inner' = [{...}]: expected a table [inner]");
  EXPECT_EQ(refusal("[population]\nx = 1"),
            "configs/x.toml:1: 'population' = {...}: expected a whole number from 2 to 1000000");
}

TEST(TomlReader, RefusesNumbersOutOfRange) {
  EXPECT_EQ(refusal("population = 1"),
            "configs/x.toml:1: 'population' = 1: expected a whole number from 2 to 1000000");
  EXPECT_EQ(refusal("population = 4294967297"),
            "configs/x.toml:1: 'population' = 4294967297: expected a whole number from 2 to 1000000");
  EXPECT_EQ(refusal("inner.rate = 1.0000000000000002"),
            "configs/x.toml:1: 'inner.rate' = 1.0000000000000002: expected a number from 0 to 1");
  EXPECT_EQ(refusal("friction = -1"), "configs/x.toml:1: 'friction' = -1: expected a number from 0 to inf");
  EXPECT_EQ(refusal("friction = -inf"),
            "configs/x.toml:1: 'friction' = -inf: expected a number from 0 to inf");
  EXPECT_EQ(refusal("friction = nan"), "configs/x.toml:1: 'friction' = nan: expected a number from 0 to inf");
  EXPECT_EQ(refusal("inner.rate = inf"),
            "configs/x.toml:1: 'inner.rate' = inf: expected a number from 0 to 1");
  EXPECT_EQ(refusal("weights = [0, inf]"),
            "configs/x.toml:1: 'weights' = [0, inf]: expected a list of numbers from -10 to 10");
}

TEST(TomlReader, RefusesUnknownKeysAndSuggestsTheNearest) {
  EXPECT_EQ(refusal("\npopulatoin = 5"),
            "configs/x.toml:2: unknown key 'populatoin' (did you mean 'population'?)");
  EXPECT_EQ(refusal("[inner]\nraet = 5"),
            "configs/x.toml:2: unknown key 'inner.raet' (did you mean 'inner.rate'?)");
  EXPECT_EQ(refusal("[iner]\nrate = 5"), "configs/x.toml:1: unknown key 'iner' (did you mean 'inner'?)");
  EXPECT_EQ(refusal("rate = 5"), "configs/x.toml:1: unknown key 'rate' (did you mean 'inner.rate'?)");
  EXPECT_EQ(refusal("[inner]\npopulation = 5"),
            "configs/x.toml:2: unknown key 'inner.population' (did you mean 'population'?)");
  EXPECT_EQ(refusal("\"in.ner\" = 5"), "configs/x.toml:1: unknown key '\"in.ner\"'");
  EXPECT_EQ(refusal("\"a\\nb\" = 5"), "configs/x.toml:1: unknown key '\"a\\nb\"'");
  EXPECT_EQ(refusal("\"inner.rate\" = 0.5"),
            "configs/x.toml:1: unknown key '\"inner.rate\"' (did you mean 'inner.rate'?)");
  EXPECT_EQ(refusal("zebra = 5"), "configs/x.toml:1: unknown key 'zebra'");
  EXPECT_EQ(refusal("zebra = 5\naardvark = 5"), "configs/x.toml:1: unknown key 'zebra'")
      << "the first in the file";
  EXPECT_EQ(refusal("[outer]\ndeep.seed = 1\n[outer.deeper]\nx = 1"),
            "configs/x.toml:3: unknown key 'outer.deeper' (did you mean 'outer.deep'?)");
}

TEST(TomlReader, ShortensLongValues) {
  std::string expected = "configs/x.toml:1: 'population' = \"" + std::string(59, 'x');
  EXPECT_EQ(refusal("population = '" + std::string(500, 'x') + "'"),
            expected + "x\"...: expected a whole number from 2 to 1000000");
  EXPECT_EQ(refusal("population = '" + std::string(59, 'x') + "éé'"),
            expected + "\"...: expected a whole number from 2 to 1000000");
  EXPECT_EQ(refusal("population = \"a\\nb\""),
            "configs/x.toml:1: 'population' = \"a\\nb\": expected a whole number from 2 to 1000000");
  std::string list = "0";
  for (int i = 0; i < 1000; ++i) list += ", 0";
  EXPECT_EQ(refusal("population = [" + list + "]"), "configs/x.toml:1: 'population' = [" +
                                                        list.substr(0, 61) +
                                                        ", ...]: expected a whole number from 2 to 1000000");
}

TEST(TomlReader, AWholeNumberForAnIntStaysWithinAnInt) {
  struct Unbounded {
    int value = 0;
    void describe(SettingsVisitor& visitor) { visitor.integer("value", value, {0}, {"No upper bound."}); }
  } settings;
  const TomlDocument document = TomlDocument::parse("value = 2147483648", "x.toml");
  EXPECT_EQ(error_of(ExitCode::bad_input, [&] { settings.describe(*document.reader()); }),
            "x.toml:1: 'value' = 2147483648: expected a whole number from 0 to 2147483647");
}

TEST(TomlReader, ReadsAListOfTablesAndGivesMissingKeysTheirDefaults) {
  const Sample sample =
      sample_from("knots = [\n  { name = 'a', at = [1, 2.5] },\n  { tight = true, length = 1 },\n  {},\n]");
  ASSERT_EQ(sample.knots.size(), 3u);
  EXPECT_EQ(sample.knots[0].name, "a");
  EXPECT_EQ(sample.knots[0].at, (std::vector{1.0, 2.5}));
  EXPECT_EQ(sample.knots[0].length, 0.5);
  EXPECT_EQ(sample.knots[1].name, "");
  EXPECT_EQ(sample.knots[1].length, 1.0);
  EXPECT_TRUE(sample.knots[1].tight);
  EXPECT_FALSE(sample.knots[2].tight);
  EXPECT_TRUE(sample_from("knots = []").knots.empty());
  EXPECT_EQ(sample_from("[[knots]]\nname = 'b'\n[[knots]]\nname = 'c'").knots[1].name, "c");
  EXPECT_EQ(sample_from("").knots.size(), Sample().knots.size());
}

TEST(TomlReader, NamesLineAndPlaceOfABadItem) {
  EXPECT_EQ(refusal("knots = [\n  { name = 'a' },\n  { at = ['x'] },\n]"),
            "configs/x.toml:3: 'knots[1].at' = [\"x\"]: expected a list of numbers from -10 to 10");
  EXPECT_EQ(refusal("knots = [\n  { name = 'a' },\n  { length = 2 },\n]"),
            "configs/x.toml:3: 'knots[1].length' = 2: expected a number from 0 to 1");
  EXPECT_EQ(refusal("knots = [\n  { name = 'a' },\n  7,\n]"),
            "configs/x.toml:3: 'knots[1]' = 7: expected a table in braces");
  EXPECT_EQ(refusal("knots = 3"), "configs/x.toml:1: 'knots' = 3: expected a list of tables in braces");
}

TEST(TomlReader, RefusesUnknownKeysInsideItems) {
  EXPECT_EQ(refusal("knots = [\n  { name = 'a' },\n  { nam = 'b' },\n]"),
            "configs/x.toml:3: unknown key 'knots[1].nam' (did you mean 'knots[1].name'?)");
}

TEST(TomlReader, AWholeNumberForAnIntReachesBothEndsOfAnInt) {
  struct Unbounded {
    int value = 0;
    void describe(SettingsVisitor& visitor) { visitor.integer("value", value, {}, {"No bound."}); }
  };
  const auto read = [](const std::string& value) {
    Unbounded settings;
    const TomlDocument document = TomlDocument::parse("value = " + value, "x.toml");
    settings.describe(*document.reader());
    return settings.value;
  };
  EXPECT_EQ(read("2147483647"), std::numeric_limits<int>::max());
  EXPECT_EQ(read("-2147483648"), std::numeric_limits<int>::min());
  EXPECT_EQ(error_of(ExitCode::bad_input, [&] { read("-2147483649"); }),
            "x.toml:1: 'value' = -2147483649: expected a whole number from -2147483648 to 2147483647");
}

/// Settings whose keys are names that somebody chose.
struct Chosen {
  std::vector<std::string> names;
  std::vector<double> values;

  void describe(io::SettingsVisitor& visitor) {
    values.assign(names.size(), 0.0);
    for (std::size_t i = 0; i < names.size(); ++i) {
      visitor.begin(names[i], {""});
      visitor.number(names[i], values[i], {0.0, 9.0}, {""});
      visitor.end();
    }
  }
};

TEST(TomlReader, ReadsEveryKeyThatTomlCanWrite) {
  const std::vector<std::string> names{"左前",        "{leg}_",    "a.b", "it's",      "say \"x\"",
                                       "back\\slash", "two words", "",    "new\nline", "\x01",
                                       "\x7f",        "a[0]",      "#",   "x=1"};
  std::string text;
  for (const std::string& name : names) text += fmt::format("[{0}]\n{0} = 2\n", toml_key(name));
  const TomlDocument document = TomlDocument::parse(text, "x.toml");
  Chosen chosen{names, {}};
  const auto reader = document.reader();
  chosen.describe(*reader);
  reader->finish();
  EXPECT_EQ(chosen.values, std::vector<double>(names.size(), 2.0));
  for (std::size_t i = 0; i < names.size(); ++i) {
    const std::string key = toml_key(names[i]);
    EXPECT_EQ(document.where(key + "." + key), fmt::format("x.toml:{}", 2 * i + 2)) << key;
    EXPECT_EQ(document.keys_of(key), std::vector<std::string>{names[i]});
  }
  Chosen others{{"左前", "a"}, {}};
  const auto strict = document.reader();
  others.describe(*strict);
  EXPECT_EQ(error_of(ExitCode::bad_input, [&] { strict->finish(); }), "x.toml:3: unknown key '\"{leg}_\"'");
  EXPECT_EQ(error_of(ExitCode::bad_input,
                     [&] {
                       const TomlDocument bad = TomlDocument::parse("['a.b']\n'a.b' = 10", "x.toml");
                       Chosen one{{"a.b"}, {}};
                       one.describe(*bad.reader());
                     }),
            "x.toml:2: '\"a.b\".\"a.b\"' = 10: expected a number from 0 to 9");
}

}  // namespace
}  // namespace amble::io
