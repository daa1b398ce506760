// Injured inputs, a few thousand per reader: nothing but a UserError may come out.
#include <gtest/gtest.h>

#include "amble/io/binary.hpp"
#include "amble/io/json_file.hpp"
#include "amble/io/toml_settings.hpp"
#include "tests/io/mutate.hpp"
#include "tests/io/sample_settings.hpp"

namespace amble::io {
namespace {

using test::Sample;

TEST(Mutation, TomlSettings) {
  Sample sample;
  const std::string text = settings_to_toml([&](SettingsVisitor& visitor) { sample.describe(visitor); });
  const int refused = test::refused_mutations(text, 4000, [](const std::string& bytes) {
    const TomlDocument document = TomlDocument::parse(bytes, "x.toml");
    Sample read;
    const auto reader = document.reader();
    read.describe(*reader);
    reader->finish();
  });
  EXPECT_GT(refused, 1000);
  EXPECT_LT(refused, 4000);
}

TEST(Mutation, SettingFromTheCommandLine) {
  const int refused = test::refused_mutations("weights=[1.5, -2]", 4000, [](const std::string& bytes) {
    TomlDocument document = TomlDocument::parse("", "x.toml");
    if (bytes.find('\n') == std::string::npos) document.set(bytes);
    Sample read;
    const auto reader = document.reader();
    read.describe(*reader);
    reader->finish();
  });
  EXPECT_GT(refused, 2000);
}

TEST(Mutation, SealedJson) {
  const std::string text = sealed_json("sample", 1, settings_to_json(Sample{}));
  test::refused_mutations(text, 4000, [](const std::string& bytes) {
    const SealedJson json = unseal_json("sample", 1, bytes, "x.json", Altered::accept);
    settings_from_json<Sample>(JsonView(json.document, "x.json"));
  });
  const std::string original = settings_to_json(Sample{}).dump();
  test::refused_mutations(text, 4000, [&](const std::string& bytes) {
    // What passes the checksum is what was written.
    EXPECT_EQ(unseal_json("sample", 1, bytes, "x.json").document.dump(), original);
  });
}

TEST(Mutation, SealedBinary) {
  BinaryWriter writer;
  writer.put_text("name");
  writer.put_span(std::span<const double>(std::vector<double>{1.0, 2.0}));
  writer.put(true);
  const auto read = [](std::string_view payload) {
    BinaryReader reader(payload, "x");
    reader.get_text();
    reader.get_vector<double>();
    reader.get<bool>();
    reader.finish();
  };
  EXPECT_GT(test::refused_mutations(writer.bytes(), 4000, read), 1000);
  const std::string sealed = seal("AMBLETST", 1, writer.bytes());
  test::refused_mutations(sealed, 4000, [&](const std::string& bytes) {
    EXPECT_EQ(unseal("AMBLETST", 1, bytes, "x"), writer.bytes());
  });
}

}  // namespace
}  // namespace amble::io
