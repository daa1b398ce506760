#include <gtest/gtest.h>

#include "amble/io/quoting.hpp"
#include "amble/io/toml_settings.hpp"
#include "tests/io/random_sample.hpp"

namespace amble::io {
namespace {

using test::Sample;

std::string toml_of(Sample sample) {
  return settings_to_toml([&](SettingsVisitor& visitor) { sample.describe(visitor); });
}

TEST(TomlWriter, WritesCommentsAndPutsTablesAfterPlainKeys) {
  EXPECT_EQ(toml_of(Sample{}), R"(# Name of the robot.
# (text in quotes)
name = "walker"
# Genomes per generation.
# (a whole number from 2 to 1000000; source: Somebody 2013, sec. 4)
population = 300
# Coulomb coefficient.
# (a number from 0 to inf)
friction = inf
# Whether the best survive.
# (true or false)
elitism = true
# Colour of the torso.
# (one of "red", "green", "blue")
colour = "green"
# Weights, without unit.
# (a list of numbers from -10 to 10)
weights = [1.0, -2.5]
# Names of the legs.
# (a list of texts in quotes)
legs = ["FL", "FR"]
# A list of tables.
# (a list of tables in braces)
knots = [
  { name = "first", at = [1.0, 2.0] },
  { name = "second", length = 0.25, tight = true },
]

# What lies within.
[inner]
# Share of offspring, 0 to 1.
# (a number from 0 to 1; source: Somebody 2013)
rate = 0.25
# Seed of all randomness.
# (a whole number)
seed = 1

# The innermost table.
[outer.deep]
# Share of offspring, 0 to 1.
# (a number from 0 to 1; source: Somebody 2013)
rate = 0.25
# Seed of all randomness.
# (a whole number)
seed = 1
)");
}

TEST(TomlWriter, WritesRandomSettingsThatReadBackToTheBit) {
  Stream stream(1, Purpose::test);
  for (int i = 0; i < 1000; ++i) {
    const Sample sample = test::random_sample(stream);
    const std::string text = toml_of(sample);
    const TomlDocument document = TomlDocument::parse(text, "x.toml");
    Sample read;
    const auto reader = document.reader();
    read.describe(*reader);
    reader->finish();
    ASSERT_EQ(test::fingerprint(read), test::fingerprint(sample)) << text;
    ASSERT_EQ(toml_of(read), text);
  }
}

TEST(TomlNumber, IsAlwaysAFloat) {
  EXPECT_EQ(toml_number(300.0), "300.0");
  EXPECT_EQ(toml_number(-0.0), "-0.0");
  EXPECT_EQ(toml_number(0.1), "0.1");
  EXPECT_EQ(toml_number(1e-7), "1e-07");
  EXPECT_EQ(toml_number(-1e300), "-1e+300");
  EXPECT_EQ(toml_number(-std::numeric_limits<double>::infinity()), "-inf");
}

TEST(TomlQuoted, EscapesWhatTomlForbids) {
  EXPECT_EQ(toml_quoted(std::string("a\"\\\n\t\0\x7fé", 9)), "\"a\\\"\\\\\\n\\t\\u0000\\u007Fé\"");
}

}  // namespace
}  // namespace amble::io
